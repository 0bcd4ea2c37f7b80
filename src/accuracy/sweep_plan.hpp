#pragma once

#include <filesystem>
#include <string>

#include "accuracy/sweep_planner.hpp"

namespace speculum {

// Returns the built-in sweep "quick" or "full", or reads `wanted` as a file with readSweepPlan().
SweepPlan sweepPlan(const std::string& wanted, const SweepContext& context);

// Reads a sweep from a TOML file such as examples/sweep.toml. Configurations with equal settings are one. Throws
// InputError with FILE:LINE.
SweepPlan readSweepPlan(const std::filesystem::path& file, const SweepContext& context);

// Plans a dozen configurations for the front of one view, without series.
SweepPlan viewSweep(const SweepContext& context);

}  // namespace speculum
