#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace speculum {

// The whole file. Throws std::runtime_error naming the file when it is missing, unreadable, a directory, a device or
// pipe (which might never end), or larger than `most` bytes.
std::vector<uint8_t> readFileBytes(const std::filesystem::path& file, uintmax_t most = 1u << 30);

// Calls `write` with the path to fill and puts the result in the place of `file`, so that a failure half-way never
// leaves a broken file there. Throws std::runtime_error naming the file when its folder is missing or not writable.
void replaceFile(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

}  // namespace speculum
