#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "platform/process.hpp"

namespace speculum {

// The desktop's dialog for a file to open (zenity or kdialog), in a child process.
class FileDialog {
 public:
  struct Answer {
    std::optional<std::filesystem::path> file;  // none if the user cancelled, or the dialog failed
    bool failed = false;
  };

  // Opens it in that folder unless it is open. Returns false if the desktop has none.
  bool open(const std::filesystem::path& folder);
  bool isOpen() const { return process_ != nullptr; }
  std::optional<Answer> poll();  // once it has closed

 private:
  std::unique_ptr<ChildProcess> process_;  // while it is open
};

}  // namespace speculum
