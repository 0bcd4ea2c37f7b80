#pragma once

#include <limits>
#include <string>

namespace speculum {

// The numbers that a key takes; never infinite or NaN.
struct Range {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();
  bool aboveLow = false;     // low itself is out
  bool powersOfTwo = false;  // no other numbers

  bool contains(double value) const;
  std::string text() const;       // for errors: "a number in 0 .. 1 is needed"
  std::string shortText() const;  // for tables: "0 .. 1", "> 0 .. 1e15"; empty for any number
};

inline constexpr Range anyRange{};
inline constexpr Range positiveRange{.low = 0.0, .aboveLow = true};
// Coordinates in metres or degrees, and lengths in metres. Squares of sums and products of several such numbers are
// still doubles.
inline constexpr Range coordinateRange{.low = -1e15, .high = 1e15};
inline constexpr Range lengthRange{.low = 0.0, .high = 1e15, .aboveLow = true};
// Speeds in degrees per second. Their product with any number of seconds is still a double.
inline constexpr Range turnRange{.low = -1e9, .high = 1e9};
// Radiance and irradiance: floats, whose products with colors of surfaces are floats as well or saturate. Colors of
// surfaces: what a float loses of the product of a light and such a color is less than a screen shows.
inline constexpr Range radianceRange{.low = 0.0, .high = 1e38};
inline constexpr Range surfaceColorRange{.low = 0.0, .high = 1e30};
// Metres: slopes of ripples that are squared stay floats.
inline constexpr Range amplitudeRange{.low = 0.0, .high = 1e15};
inline constexpr Range wavelengthRange{.low = 1e-9, .high = 1e15};
inline constexpr Range waveSpeedRange{.low = -1e100, .high = 1e100};  // times any number of seconds is still a double
inline constexpr Range timeRange{.low = -1e15, .high = 1e15};         // seconds
inline constexpr Range unitRange{.low = 0.0, .high = 1.0};
// A larger exponent makes a highlight narrower than a float resolves in a cosine.
inline constexpr double leastShininess = 1.0;
inline constexpr double mostShininess = 1e6;
inline constexpr Range fieldOfViewRange{.low = 1.0, .high = 170.0};  // degrees
inline constexpr Range copiesRange{.low = 1.0, .high = 1'000'000.0};
inline constexpr Range imageScaleRange{.low = 0.125, .high = 4.0};
inline constexpr Range samplesRange{.low = 1.0, .high = 8.0, .powersOfTwo = true};
inline constexpr Range intervalRange{.low = 1.0, .high = 1'000'000.0};  // frames

}  // namespace speculum
