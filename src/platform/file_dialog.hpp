#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace speculum {

// The desktop's dialog for a file to open: that of Windows, else zenity or kdialog.
class FileDialog {
 public:
  struct Answer {
    std::optional<std::filesystem::path> file;  // none if the user cancelled, or the dialog failed
    bool failed = false;
  };
  struct Filter {
    std::string name;
    std::string patterns;  // separated by blanks
  };

  FileDialog();
  ~FileDialog();

  // Opens the dialog in that folder, unless it is open already. The user may also choose among all files. Returns false
  // if the desktop has no such dialog.
  bool open(const std::filesystem::path& folder, const Filter& filter);
  bool isOpen() const { return shown_ != nullptr; }
  std::optional<Answer> poll();  // the answer, once the dialog has closed

 private:
  struct Shown;
  std::unique_ptr<Shown> shown_;  // null: the dialog is not open
};

}  // namespace speculum
