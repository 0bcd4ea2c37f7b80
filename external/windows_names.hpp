#pragma once

// Comes before all else on Windows, where libraries include its header: takes back the macros that are words of this
// project.
#ifndef NOMINMAX
#define NOMINMAX
#endif
#ifndef WIN32_LEAN_AND_MEAN
#define WIN32_LEAN_AND_MEAN
#endif
#include <windows.h>
#undef near
#undef far
// Headers of Windows that come later write them as these.
#undef NEAR
#undef FAR
#define NEAR
#define FAR

#ifdef __MINGW32__
#include <filesystem>
// A path made of char is UTF-8, as path::string() is. The library of GCC 12 takes each byte for a character.
template <>
inline auto std::filesystem::path::_S_convert<char>(const char* first, const char* last) {
  const int bytes = static_cast<int>(last - first);
  std::wstring wide(static_cast<size_t>(bytes), L'\0');
  wide.resize(static_cast<size_t>(::MultiByteToWideChar(CP_UTF8, 0, first, bytes, wide.data(), bytes)));
  return wide;
}
#endif
