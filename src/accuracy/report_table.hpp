#pragma once

#include <string>

#include "accuracy/sweep_results.hpp"

namespace speculum {

// A row per point, cheapest first, and one for the ground truth's noise floor below them.
std::string pointTable(const SweepResults& results);

}  // namespace speculum
