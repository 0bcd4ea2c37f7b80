#pragma once

#include <string>

#include "accuracy/sweep_planner.hpp"

namespace speculum {

// Returns the built-in sweep "quick" or "full", or reads `wanted` as a file with readSweepPlan().
SweepPlan sweepPlan(const std::string& wanted, const SweepContext& context);

// Plans a dozen configurations for the front of one view, without series.
SweepPlan viewSweep(const SweepContext& context);

}  // namespace speculum
