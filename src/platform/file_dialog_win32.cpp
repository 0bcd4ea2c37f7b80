#include "platform/file_dialog.hpp"
#include "platform/win32.hpp"

#include <algorithm>
#include <future>
#include <thread>

namespace speculum {

struct FileDialog::Shown {
  std::future<Answer> answer;
};

FileDialog::FileDialog() = default;
FileDialog::~FileDialog() = default;

bool FileDialog::open(const std::filesystem::path& folder, const Filter& filter) {
  if (shown_) {
    return true;
  }
  std::string patterns = filter.patterns;
  std::ranges::replace(patterns, ' ', ';');
  std::wstring filters = win32::wide(filter.name + '\n' + patterns + "\nAll files\n*\n");
  std::ranges::replace(filters, L'\n', L'\0');  // how the dialog takes pairs
  std::packaged_task<Answer()> ask([filters, start = std::filesystem::path(folder).make_preferred()] {
    std::wstring name(1u << 15, L'\0');
    OPENFILENAMEW dialog{.lStructSize = sizeof dialog,
                         .lpstrFilter = filters.c_str(),
                         .lpstrFile = name.data(),
                         .nMaxFile = static_cast<DWORD>(name.size()),
                         .lpstrInitialDir = start.c_str(),
                         .lpstrTitle = L"Open",
                         .Flags = OFN_FILEMUSTEXIST | OFN_NOCHANGEDIR | OFN_HIDEREADONLY};
    if (::GetOpenFileNameW(&dialog)) {
      return Answer{.file = std::filesystem::path(name.c_str())};
    }
    return Answer{.file = std::nullopt, .failed = ::CommDlgExtendedError() != 0};
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
