#pragma once

#include <filesystem>

#include "accuracy/sweep_planner.hpp"

namespace speculum {

// A sweep from a TOML file:
//
//     repeats = 15                                # 15 or more
//     [[configuration]]
//     name     = "cheap"
//     settings = { "reflection.scale" = 0.5, "reflection.samples" = 1 }
//     [[grid]]                                    # every combination
//     settings = { "reflection.scale" = [0.5, 1], "reflection.max_depth" = [1, 2, 4] }
//     [[series]]                                  # a convergence plot
//     key      = "reflection.scale"
//     values   = [0.25, 0.5, 1]
//     axis     = "logarithmic"                    # or "linear"; of the setting
//     theory   = -0.5                             # optional: slope of log(RMSE) along the axis
//     note     = "why"                            # optional
//     settings = { "view.samples" = 4 }           # optional: the same for all
//
// Configurations with equal settings are one. Throws InputError with FILE:LINE.
SweepPlan readSweepPlan(const std::filesystem::path& file, const SweepContext& context);

}  // namespace speculum
