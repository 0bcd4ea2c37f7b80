#include "platform/file_dialog.hpp"
#include "platform/win32.hpp"

#include <algorithm>
#include <array>
#include <future>
#include <thread>

namespace speculum {

struct FileDialog::Shown {
  std::future<Answer> answer;
};

namespace {

struct Release {
  void operator()(IUnknown* object) const { object->Release(); }
};
template <typename Interface>
using Com = std::unique_ptr<Interface, Release>;

Com<IShellItem> itemOf(const std::filesystem::path& path) {
  IShellItem* item = nullptr;
  ::SHCreateItemFromParsingName(path.c_str(), nullptr, IID_PPV_ARGS(&item));
  return Com<IShellItem>(item);
}

// The older dialog changes the working folder, from which the program reads.
FileDialog::Answer askUser(HWND owner, const std::wstring& name, const std::wstring& patterns,
                           const std::filesystem::path& start) {
  IFileOpenDialog* made = nullptr;
  ::CoCreateInstance(CLSID_FileOpenDialog, nullptr, CLSCTX_INPROC_SERVER, IID_PPV_ARGS(&made));
  const Com<IFileOpenDialog> dialog(made);
  if (!dialog) {
    return {.file = std::nullopt, .failed = true};
  }
  dialog->SetOptions(FOS_NOCHANGEDIR | FOS_FORCEFILESYSTEM | FOS_FILEMUSTEXIST);
  const std::array filters{COMDLG_FILTERSPEC{name.c_str(), patterns.c_str()}, COMDLG_FILTERSPEC{L"All files", L"*"}};
  dialog->SetFileTypes(static_cast<UINT>(filters.size()), filters.data());
  if (const Com<IShellItem> folder = itemOf(start)) {
    dialog->SetFolder(folder.get());
  }
  const HRESULT closed = dialog->Show(owner);
  IShellItem* item = nullptr;
  PWSTR file = nullptr;
  if (FAILED(closed) || FAILED(dialog->GetResult(&item)) ||
      FAILED(Com<IShellItem>(item)->GetDisplayName(SIGDN_FILESYSPATH, &file))) {
    return {.file = std::nullopt, .failed = closed != HRESULT_FROM_WIN32(ERROR_CANCELLED)};
  }
  const FileDialog::Answer answer{.file = std::filesystem::path(file)};
  ::CoTaskMemFree(file);
  return answer;
}

}  // namespace

FileDialog::FileDialog() = default;
FileDialog::~FileDialog() = default;

bool FileDialog::open(const std::filesystem::path& folder, const Filter& filter) {
  if (shown_) {
    return true;
  }
  std::string patterns = filter.patterns;
  std::ranges::replace(patterns, ' ', ';');
  // The window that has the keyboard waits behind the dialog.
  std::packaged_task<Answer()> ask([owner = ::GetActiveWindow(), name = win32::wide(filter.name),
                                    patterns = win32::wide(patterns),
                                    start = std::filesystem::path(folder).make_preferred()] {
    const bool ready = SUCCEEDED(::CoInitializeEx(nullptr, COINIT_APARTMENTTHREADED | COINIT_DISABLE_OLE1DDE));
    const Answer answer = askUser(owner, name, patterns, start);
    if (ready) {
      ::CoUninitialize();
    }
    return answer;
  });
  shown_ = std::make_unique<Shown>(ask.get_future());
  std::thread(std::move(ask)).detach();  // ends with the process, if the dialog stands open that long
  return true;
}

std::optional<FileDialog::Answer> FileDialog::poll() {
  if (!shown_ || shown_->answer.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return std::nullopt;
  }
  const Answer answer = shown_->answer.get();
  shown_.reset();
  return answer;
}

}  // namespace speculum
