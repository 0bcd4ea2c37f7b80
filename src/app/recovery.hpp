#pragma once

#include <filesystem>
#include <optional>

namespace speculum {

// Records in the user's configuration: copies in which failed sessions kept their unsaved changes.
void recordRecovery(const std::filesystem::path& copy);
bool hasRecovery(const std::filesystem::path& copy);
// Returns the copy of the newest record, if it is still there.
std::optional<std::filesystem::path> newestRecovery();
// Call when the changes of that copy are saved or discarded.
void forgetRecovery(const std::filesystem::path& copy);

}  // namespace speculum
