#include "image/picture_size.hpp"

#include <charconv>

namespace speculum {

std::optional<PictureSize> pictureSize(std::string_view text) {
  constexpr int largestSide = 16384;
  PictureSize size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool cross = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = cross ? std::from_chars(width.ptr + 1, end, size.height) : width;
  if (!cross || height.ec != std::errc() || height.ptr != end || size.width < 1 || size.height < 1 ||
      size.width > largestSide || size.height > largestSide) {
    return std::nullopt;
  }
  return size;
}

}  // namespace speculum
