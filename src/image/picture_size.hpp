#pragma once

#include <optional>
#include <string_view>

namespace speculum {

struct PictureSize {
  int width = 0;  // pixels
  int height = 0;

  bool operator==(const PictureSize&) const = default;
};

// What pictureSize() takes, for messages.
constexpr std::string_view pictureSizes = "WIDTHxHEIGHT in pixels, 1x1 to 16384x16384";

// Parses "640x360". Returns nothing for any other text.
std::optional<PictureSize> pictureSize(std::string_view text);

}  // namespace speculum
