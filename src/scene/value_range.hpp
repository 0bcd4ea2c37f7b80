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

inline constexpr Range kAny{};
inline constexpr Range kPositive{.low = 0.0, .aboveLow = true};
// Metres, degrees, and lengths in metres. Squares of sums and products of several of them are still doubles.
inline constexpr Range kCoordinate{.low = -1e15, .high = 1e15};
inline constexpr Range kLength{.low = 0.0, .high = 1e15, .aboveLow = true};
// Degrees per second. Their product with any number of seconds is still a double.
inline constexpr Range kTurn{.low = -1e9, .high = 1e9};
// Radiance and irradiance: floats, whose products with surfaces' colors are floats as well or saturate. Colors of
// surfaces: what a float loses of a light times one is less than a screen shows.
inline constexpr Range kRadiance{.low = 0.0, .high = 1e38};
inline constexpr Range kSurfaceColor{.low = 0.0, .high = 1e30};
// Metres: slopes of ripples that are squared stay floats.
inline constexpr Range kAmplitude{.low = 0.0, .high = 1e15};
inline constexpr Range kWavelength{.low = 1e-9, .high = 1e15};
inline constexpr Range kWaveSpeed{.low = -1e100, .high = 1e100};  // times any number of seconds is still a double
inline constexpr Range kTime{.low = -1e15, .high = 1e15};         // seconds
inline constexpr Range kUnit{.low = 0.0, .high = 1.0};
// A larger exponent makes a highlight narrower than a float resolves in a cosine.
inline constexpr double kLeastShininess = 1.0;
inline constexpr double kMostShininess = 1e6;
inline constexpr Range kFieldOfView{.low = 1.0, .high = 170.0};  // degrees
inline constexpr Range kCopies{.low = 1.0, .high = 1'000'000.0};
inline constexpr Range kImageScale{.low = 0.125, .high = 4.0};
inline constexpr Range kSamples{.low = 1.0, .high = 8.0, .powersOfTwo = true};
inline constexpr Range kInterval{.low = 1.0, .high = 1'000'000.0};  // frames

}  // namespace speculum
