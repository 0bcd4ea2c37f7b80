#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "accuracy/sweep_results.hpp"

namespace speculum {

// Returns the report as one HTML file that needs no other file and no network: the page of src/accuracy/page with
// reportJson() embedded.
std::string reportHtml(const SweepResults& results, const std::filesystem::path& folder);

// Data of the page:
//   results   as in results.json
//   fronts    { flip, rmse, mirrors, flicker }: indices of points on the front of each error, cheapest first
//   changed   base settings that are not the program's defaults
//   pictures  { reference, legend, shown: [{ point, picture, map, frames: [picture] }], frames: [picture] }, each
//             picture { width, height, uri } or null; frames are those of a movement, outside of `shown` the
//             reference's
// Pictures are read from `folder` and embedded in full size as JPEG; a missing or damaged file gives null.
nlohmann::ordered_json reportJson(const SweepResults& results, const std::filesystem::path& folder);

// Returns the points whose pictures go into the report, most important first, at most `most`: the base, the ends of the
// front, the worst, the one that flickers most, the rest of the front, evenly, then the best, the cheapest and the
// dearest. Only points with pictures are listed.
std::vector<int> shownPoints(const SweepResults& results, int most);

// Returns the page with its style sheet and scripts, and "@DATA@" where its JSON belongs. Written at build time.
std::string_view reportPage();

// Returns the bytes as base64 text: RFC 4648, with padding, without line breaks.
std::string base64(std::span<const uint8_t> bytes);

// Returns an HTML page with the data in the place of its "@DATA@", which stands in a script element.
std::string pageWithData(std::string_view page, const nlohmann::ordered_json& data);

}  // namespace speculum
