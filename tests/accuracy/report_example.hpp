#pragma once

#include <filesystem>

#include "accuracy/sweep_results.hpp"

namespace speculum::testing_support {

// 12 points of 64x36 pixels, 7 of them on the front, and 3 series, one of them empty; no pictures.
SweepResults exampleResults();

// exampleResults() with values at the ends of what a double holds, missing values, and series that point at nothing.
SweepResults oddResults();

// exampleResults() of a movement of three frames.
SweepResults movingResults();

// One point without error, mirrors or a series.
SweepResults singleResult();

// Writes pictures for all points and the reference into `folder`, and names them in `results`.
void writePictures(SweepResults& results, const std::filesystem::path& folder);

inline constexpr const char* awkwardName = "a </script><!-- <&\"> 'name'";

}  // namespace speculum::testing_support
