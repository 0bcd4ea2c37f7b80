#pragma once

#include <filesystem>
#include <optional>

namespace speculum {

// The copy with the unsaved changes of a session that failed: of an earlier one, which this session offers, or of this
// one. Records in the user's configuration name the copies of all sessions.
class Recovery {
 public:
  // Finds the copy of the newest record. Returns nothing if there is none, or it is gone.
  const std::optional<std::filesystem::path>& findNewest();
  static bool isRecorded(const std::filesystem::path& copy);

  // Records a copy that this session made. `keepsEarlier`: the record of the copy before stays, since its changes are
  // not in this one.
  void record(const std::filesystem::path& copy, bool keepsEarlier = false);
  // Call when the changes of the copy are saved or discarded. Other windows have records of their own.
  void forget();
  // Call when the user has opened `file` instead of answering: the next start asks again unless that is the copy.
  void postpone(const std::filesystem::path& file);

 private:
  std::optional<std::filesystem::path> copy_;
};

}  // namespace speculum
