#pragma once

#ifndef NOMINMAX
#define NOMINMAX
#endif
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

// These need the header above.
#include <psapi.h>
#include <shellapi.h>
#include <shlobj.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

// What the halves for Windows share.
namespace speculum::win32 {

struct Close {
  void operator()(void* handle) const { ::CloseHandle(handle); }
};
using Handle = std::unique_ptr<void, Close>;
// Windows names a missing handle in two ways; both become null.
inline Handle own(HANDLE handle) {
  return Handle(handle == INVALID_HANDLE_VALUE ? nullptr : handle);
}

inline std::wstring wide(std::string_view utf8) {
  return std::filesystem::path(utf8).wstring();
}
inline std::string utf8(std::wstring_view wide) {
  return std::filesystem::path(wide).string();
}

}  // namespace speculum::win32
