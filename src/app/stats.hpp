#pragma once

#include <nlohmann/json.hpp>

#include "app/session.hpp"

namespace speculum {

// Returns the figures of the last frame, which must have finished, as `render --stats` writes them.
nlohmann::ordered_json frameStats(Session& session);

// Merges the stats of measured frames: each *_ms becomes an object of median, min, p95 and max. `frames` are stats of
// one scene and one time, whose plans differ at most in which mirrors show images of earlier frames: a pass is merged
// over those frames in which it ran, and has their number as `frames` if they are not all. `passes` are passIds() of
// the same frames.
nlohmann::ordered_json mergeStats(const std::vector<nlohmann::ordered_json>& frames,
                                  const std::vector<std::vector<PassId>>& passes);
std::vector<PassId> passIds(Session& session);  // of the last frame

// Returns { "median", "min", "p95", "max" } of at least one value.
nlohmann::ordered_json summary(std::vector<double> values);

// Write a file and create its folder. Throw std::runtime_error if that fails.
void writeText(const std::filesystem::path& file, const std::string& text);
void writeJson(const std::filesystem::path& file, const nlohmann::ordered_json& json);

}  // namespace speculum
