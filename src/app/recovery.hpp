#pragma once

#include <filesystem>
#include <optional>

namespace speculum {

// The record, in the user's settings, of the copy in which a session that failed kept its unsaved changes.
void recordRecovery(const std::filesystem::path& copy);
// Returns the copy that an earlier session recorded, if it is still there.
std::optional<std::filesystem::path> recoveryCopy();
// Call when the changes are saved or discarded.
void forgetRecovery();

}  // namespace speculum
