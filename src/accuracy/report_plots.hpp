#pragma once

#include <string>

#include "accuracy/sweep_results.hpp"

namespace speculum {

// Figures of error against milliseconds a frame: mean FLIP, RMSE, RMSE over mirrors if there are any.
std::string frontFigures(const SweepResults& results);

// A figure per series, of its error against its setting; empty without series.
std::string seriesFigures(const SweepResults& results);

bool timedOnGpu(const SweepResults& results);

}  // namespace speculum
