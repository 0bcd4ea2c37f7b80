#include <algorithm>
#include <array>
#include <atomic>
#include <span>

#include "platform/bytes.hpp"
#include "platform/files.hpp"
#include "platform/process.hpp"
#include "platform/system_files.hpp"
#include "platform/win32.hpp"

namespace speculum {

namespace {

namespace fs = std::filesystem;
using win32::Handle;

void write(HANDLE handle, const fs::path& file, std::span<const uint8_t> content, bool lasting) {
  while (!content.empty()) {
    constexpr size_t most = 1u << 30;  // bytes that one call can write
    DWORD count = 0;
    if (!::WriteFile(handle, content.data(), static_cast<DWORD>(std::min(content.size(), most)), &count, nullptr)) {
      failToWrite(file, ::GetLastError());
    }
    content = content.subspan(count);
  }
  if (lasting && !::FlushFileBuffers(handle)) {
    failToWrite(file, ::GetLastError());
  }
}

// Returns the file that the links of a path lead to. A link that leads nowhere is replaced itself.
fs::path behindLinks(const fs::path& file) {
  const DWORD attributes = ::GetFileAttributesW(file.c_str());
  if (attributes == INVALID_FILE_ATTRIBUTES || (attributes & FILE_ATTRIBUTE_REPARSE_POINT) == 0) {
    return file;
  }
  constexpr DWORD all = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  const Handle target =
      win32::own(::CreateFileW(file.c_str(), 0, all, nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr));
  std::wstring name(1u << 15, L'\0');  // the longest that Windows has
  const DWORD length =
      target ? ::GetFinalPathNameByHandleW(target.get(), name.data(), static_cast<DWORD>(name.size()), 0) : 0;
  if (length == 0 || length >= name.size()) {
    return file;
  }
  name.resize(length);
  // The C library takes the question mark of these names for a wildcard.
  if (name.starts_with(LR"(\\?\UNC\)")) {
    return L"\\" + name.substr(7);
  }
  return name.starts_with(LR"(\\?\)") ? name.substr(4) : name;
}

// Gives a new file the access list of the old one, as a mode is kept elsewhere. A file system without lists has none to
// give.
void copyAccess(const fs::path& from, const fs::path& to) {
  DWORD size = 0;
  ::GetFileSecurityW(from.c_str(), DACL_SECURITY_INFORMATION, nullptr, 0, &size);
  std::vector<std::byte> access(size);
  if (::GetFileSecurityW(from.c_str(), DACL_SECURITY_INFORMATION, access.data(), size, &size)) {
    ::SetFileSecurityW(to.c_str(), DACL_SECURITY_INFORMATION, access.data());
  }
}

// Renames over the old file. Programs that watch folders, such as virus scanners, may hold a file for a moment.
void renameOver(const fs::path& partial, const fs::path& target, const fs::path& file, bool lasting) {
  const DWORD flags = MOVEFILE_REPLACE_EXISTING | (lasting ? MOVEFILE_WRITE_THROUGH : 0);
  for (int tries = 40; !::MoveFileExW(partial.c_str(), target.c_str(), flags); --tries) {
    const DWORD error = ::GetLastError();
    const bool passes = error == ERROR_SHARING_VIOLATION || error == ERROR_ACCESS_DENIED;
    if (!passes || tries == 0 || !isWritable(target)) {
      failToWrite(file, error);
    }
    ::Sleep(25);
  }
}

fs::path knownFolder(const KNOWNFOLDERID& id) {
  PWSTR name = nullptr;
  const bool found = SUCCEEDED(::SHGetKnownFolderPath(id, KF_FLAG_DONT_VERIFY, nullptr, &name));
  // No file of Windows has such a name, so nothing is kept.
  const fs::path folder = found ? fs::path(name) : fs::path(L"\\\\?\\no-home");
  ::CoTaskMemFree(name);
  return folder;
}

}  // namespace

void replace(const fs::path& file, std::span<const uint8_t> content, bool lasting, Links links) {
  std::error_code error;
  const fs::path target = links == Links::follow ? behindLinks(file) : file;
  // Writes to a device or pipe, such as NUL or \\.\pipe\NAME, directly.
  if (Handle device = win32::own(::CreateFileW(target.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE,
                                               nullptr, OPEN_EXISTING, 0, nullptr));
      device && ::GetFileType(device.get()) != FILE_TYPE_DISK) {
    return write(device.get(), file, content, false);
  }
  requirePlaceFor(file, target);
  fs::path partial;
  Handle handle;
  for (int number = 0; !handle; ++number) {
    partial = partialName(target, number);
    handle = win32::own(
        ::CreateFileW(partial.c_str(), GENERIC_WRITE, 0, nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr));
    if (const DWORD reason = ::GetLastError(); !handle && reason != ERROR_FILE_EXISTS) {
      failToWrite(file, reason);
    }
  }
  try {
    copyAccess(target, partial);  // before there is anything to read
    write(handle.get(), file, content, lasting);
    handle.reset();
    renameOver(partial, target, file, lasting);
  } catch (...) {
    handle.reset();
    fs::remove(partial, error);
    throw;
  }
}

bool isWritable(const fs::path& file) {
  const DWORD attributes = ::GetFileAttributesW(file.c_str());
  if (attributes == INVALID_FILE_ATTRIBUTES) {
    return ::GetFileAttributesW(folderOf(file).c_str()) != INVALID_FILE_ATTRIBUTES;
  }
  // Rights are in access lists, which nothing but opening the file evaluates; of a folder the bit says nothing.
  if ((attributes & FILE_ATTRIBUTE_DIRECTORY) != 0) {
    return true;
  }
  // A file that another program reads at present is writable later.
  return win32::own(::CreateFileW(file.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                  nullptr, OPEN_EXISTING, 0, nullptr)) != nullptr ||
         ::GetLastError() == ERROR_SHARING_VIOLATION;
}

// Windows cannot lock a folder and still list it. The lock is a mutex whose name stands for the folder.
std::shared_ptr<const void> lockFolder(const fs::path& folder) {
  std::error_code error;
  const std::wstring path = fs::canonical(folder, error).make_preferred().wstring();
  if (error || !isFolder(folder) || fs::is_symlink(folder, error)) {
    return nullptr;
  }
  const std::string name = "Global\\speculum-" + std::to_string(fnv1a(std::as_bytes(std::span(path))));
  Handle mutex = win32::own(::CreateMutexW(nullptr, FALSE, win32::wide(name).c_str()));
  if (::GetLastError() == ERROR_ALREADY_EXISTS) {
    mutex.reset();
  }
  return std::shared_ptr<const void>(std::move(mutex));
}

fs::path newTemporaryFolder() {
  static std::atomic<uint64_t> number{::GetTickCount64()};
  const fs::path parent = temporaryFolder();
  for (;;) {
    const fs::path folder =
        parent / ("speculum-" + std::to_string(::GetCurrentProcessId()) + "-" + std::to_string(number++));
    if (::CreateDirectoryW(folder.c_str(), nullptr)) {
      return folder;
    }
    if (::GetLastError() != ERROR_ALREADY_EXISTS) {
      throw std::runtime_error("no temporary directory could be made at " + folder.string() +
                               " (name a writable folder in TMP)");
    }
  }
}

const char* const homeVariable = "USERPROFILE";

fs::path systemFolder(UserFolder folder) {
  switch (folder) {
    case UserFolder::cache:
      return knownFolder(FOLDERID_LocalAppData);
    case UserFolder::config:
      return knownFolder(FOLDERID_RoamingAppData);
    case UserFolder::pictures:
      return knownFolder(FOLDERID_Pictures);
    case UserFolder::documents:
      break;
  }
  return knownFolder(FOLDERID_Documents);
}

fs::path temporaryFolder() {
  std::array<wchar_t, MAX_PATH + 2> name{};
  const DWORD length = ::GetTempPathW(static_cast<DWORD>(name.size()), name.data());
  return fs::path(std::wstring_view(name.data(), length));
}

fs::path executablePath() {
  std::wstring name(MAX_PATH, L'\0');
  for (;;) {
    const DWORD length = ::GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size()));
    if (length < name.size()) {
      name.resize(length);
      return name;
    }
    name.resize(2 * name.size());
  }
}

fs::path systemFont() {
  const fs::path fonts = knownFolder(FOLDERID_Fonts);
  for (const char* name : {"segoeui.ttf", "tahoma.ttf", "arial.ttf"}) {
    if (isFile(fonts / name)) {
      return fonts / name;
    }
  }
  return {};
}

std::vector<FontFace> fontsFor(std::u32string) {
  const fs::path folder = knownFolder(FOLDERID_Fonts);
  std::vector<FontFace> fonts;
  // Chinese, Japanese, Korean; scripts of India, of Southeast Asia and of Africa; symbols.
  for (const char* name : {"msyh.ttc", "YuGothM.ttc", "malgun.ttf", "msjh.ttc", "Nirmala.ttf", "Nirmala.ttc",
                           "LeelawUI.ttf", "ebrima.ttf", "segoeui.ttf", "seguisym.ttf"}) {
    if (isFile(folder / name)) {
      fonts.push_back({folder / name});
    }
  }
  return fonts;
}

}  // namespace speculum
