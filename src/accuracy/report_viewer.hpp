#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "accuracy/sweep_results.hpp"

namespace speculum {

// Points whose pictures go into the report, most important first, at most `most`: the base, the ends of the front, the
// worst, the rest of the front, evenly, then the best, the cheapest and the dearest. Only points with pictures.
std::vector<int> shownPoints(const SweepResults& results, int most);

// The reference, the points' pictures with a divider between them, and their error maps, as HTML with everything in it.
std::string viewerHtml(const SweepResults& results, const std::filesystem::path& folder);

}  // namespace speculum
