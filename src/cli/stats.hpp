#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>

#include "session/session.hpp"

namespace speculum {

// Returns the figures of the last frame, which must have finished, as `render --stats` writes them.
nlohmann::ordered_json frameStats(Session& session);

// Merges the stats of measured frames: each *_ms becomes an object of median, min, p95 and max. `frames` are stats of
// one scene at one time; their plans may differ in which mirror images are reused. A pass is merged over the frames in
// which it ran; its key `frames` is the number of these frames if it did not run in all. `passes` are passIds() of the
// same frames.
nlohmann::ordered_json mergeStats(const std::vector<nlohmann::ordered_json>& frames,
                                  const std::vector<std::vector<PassId>>& passes);
std::vector<PassId> passIds(Session& session);  // of the last frame

// Returns { "median", "min", "p95", "max" } of at least one value.
nlohmann::ordered_json summary(std::vector<double> values);

// Returns where a command that writes `file` prints all else: a file called "-" is standard output.
std::FILE* besideOutput(const std::filesystem::path& file);
// Write a file and create its folder, or write to standard output. Throw FileError if that fails.
void writeText(const std::filesystem::path& file, const std::string& text);
void writeJson(const std::filesystem::path& file, const nlohmann::ordered_json& json);

}  // namespace speculum
