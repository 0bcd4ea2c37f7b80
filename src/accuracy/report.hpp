#pragma once

#include <filesystem>
#include <string>

#include "accuracy/sweep_results.hpp"

namespace speculum {

// The report as one HTML file that needs nothing beside it and no network. Pictures are read from `folder`, scaled to
// nothing smaller, and embedded as JPEG; the files they came from are named beside them. Pictures that are missing are
// left out with a note in their place.
std::string reportHtml(const SweepResults& results, const std::filesystem::path& folder);

}  // namespace speculum
