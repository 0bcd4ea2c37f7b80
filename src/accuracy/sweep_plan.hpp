#pragma once

#include <string>

#include "accuracy/sweep_planner.hpp"

namespace speculum {

// The built-in sweeps "quick" and "full", or a file for readSweepPlan().
SweepPlan sweepPlan(const std::string& wanted, const SweepContext& context);

// A dozen configurations for the front of one view, without series.
SweepPlan viewSweep(const SweepContext& context);

}  // namespace speculum
