#include "platform/files.hpp"
#include "platform/folders.hpp"
#include "platform/system_files.hpp"
#include "platform/win32.hpp"

#include <array>

namespace speculum {

namespace fs = std::filesystem;

namespace {

fs::path knownFolder(const KNOWNFOLDERID& id) {
  PWSTR name = nullptr;
  const bool found = SUCCEEDED(::SHGetKnownFolderPath(id, KF_FLAG_DONT_VERIFY, nullptr, &name));
  // No file of Windows has such a name, so nothing is kept.
  const fs::path folder = found ? fs::path(name) : fs::path(L"\\\\?\\no-home");
  ::CoTaskMemFree(name);
  return folder;
}

}  // namespace

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
