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
// Unlike path, does not throw if a name is no UTF-16: Windows allows such names. Half a pair becomes U+FFFD.
inline std::string utf8(std::wstring_view wide) {
  const int units = static_cast<int>(wide.size());
  const auto convert = [&](char* text, int bytes) {
    return ::WideCharToMultiByte(CP_UTF8, 0, wide.data(), units, text, bytes, nullptr, nullptr);
  };
  std::string text(static_cast<size_t>(convert(nullptr, 0)), '\0');
  convert(text.data(), static_cast<int>(text.size()));
  return text;
}

}  // namespace speculum::win32
