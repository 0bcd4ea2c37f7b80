#pragma once

#include <filesystem>

#include "accuracy/sweep_planner.hpp"

namespace speculum {

// Reads a sweep from a TOML file such as examples/sweep.toml. Configurations with equal settings are one. Throws
// InputError with FILE:LINE.
SweepPlan readSweepPlan(const std::filesystem::path& file, const SweepContext& context);

}  // namespace speculum
