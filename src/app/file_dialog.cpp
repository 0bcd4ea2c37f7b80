#include "app/file_dialog.hpp"

#include "scene/model_formats.hpp"

namespace speculum {

namespace fs = std::filesystem;

bool FileDialog::open(const fs::path& folder) {
  if (process_) {
    return true;
  }
  if (const fs::path zenity = findProgram("zenity"); !zenity.empty()) {
    process_ = std::make_unique<ChildProcess>(std::vector<std::string>{
        zenity, "--file-selection", "--title=Open", "--filename=" + folder.string(),
        "--file-filter=Scenes and models | *.toml " + modelPatterns(), "--file-filter=All files | *"});
  } else if (const fs::path kdialog = findProgram("kdialog"); !kdialog.empty()) {
    process_ = std::make_unique<ChildProcess>(std::vector<std::string>{
        kdialog, "--title", "Open", "--getopenfilename", folder, "Scenes and models (*.toml " + modelPatterns() + ")"});
  }
  return process_ != nullptr;
}

// The dialog may write warnings too; the file is the last line.
std::optional<FileDialog::Answer> FileDialog::poll() {
  const std::optional<ProcessResult> result = process_ ? process_->poll() : std::nullopt;
  if (!result) {
    return std::nullopt;
  }
  process_.reset();
  const std::string text = result->output.substr(0, result->output.find_last_not_of("\n") + 1);
  if (result->exitCode == 0 && !text.empty()) {
    return Answer{.file = text.substr(text.rfind('\n') + 1)};
  }
  return Answer{.file = std::nullopt, .failed = result->exitCode > 1};  // 1: the user cancelled
}

}  // namespace speculum
