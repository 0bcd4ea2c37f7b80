#include "platform/file_dialog.hpp"
#include "platform/process.hpp"

namespace speculum {

struct FileDialog::Shown {
  explicit Shown(const std::vector<std::string>& command) : process(command) {}
  ChildProcess process;
};

FileDialog::FileDialog() = default;
FileDialog::~FileDialog() = default;

bool FileDialog::open(const std::filesystem::path& folder, const Filter& filter) {
  if (shown_) {
    return true;
  }
  const std::vector<std::string> zenity{"zenity",
                                        "--file-selection",
                                        "--title=Open",
                                        "--filename=" + folder.string(),
                                        "--file-filter=" + filter.name + " | " + filter.patterns,
                                        "--file-filter=All files | *"};
  const std::vector<std::string> kdialog{
      "kdialog", "--title", "Open", "--getopenfilename", folder.string(), filter.name + " (" + filter.patterns + ")"};
  for (const auto& command : {zenity, kdialog}) {
    auto started = std::make_unique<Shown>(command);
    if (started->process.running()) {
      shown_ = std::move(started);
      return true;
    }
  }
  return false;
}

// The dialog may write warnings too; the file is the last line.
std::optional<FileDialog::Answer> FileDialog::poll() {
  const std::optional<ProcessResult> result = shown_ ? shown_->process.poll() : std::nullopt;
  if (!result) {
    return std::nullopt;
  }
  shown_.reset();
  const std::string text = result->output.substr(0, result->output.find_last_not_of("\n") + 1);
  if (result->exitCode == 0 && !text.empty()) {
    return Answer{.file = text.substr(text.rfind('\n') + 1)};
  }
  return Answer{.file = std::nullopt, .failed = result->exitCode > 1};  // 1: the user cancelled
}

}  // namespace speculum
