// Joins the same part of several pictures side by side, for scripts/hard-case-pictures and scripts/thumbnails:
//   picture_strip [--quality N] OUT.jpg X,Y,WIDTH,HEIGHT ZOOM PICTURE...
// The part is in pixels, 0,0 at the top left; ZOOM, a whole number, repeats each pixel.
#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"

namespace speculum {
namespace {

constexpr int gap = 4;  // pixels of white between two pictures
constexpr int usualQuality = 82;

struct Part {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

Part parsePart(const std::string& text) {
  Part part;
  if (std::sscanf(text.c_str(), "%d,%d,%d,%d", &part.x, &part.y, &part.width, &part.height) != 4) {
    throw std::runtime_error(text + ": not a part X,Y,WIDTH,HEIGHT");
  }
  return part;
}

void paste(Image8& strip, int left, const Image8& picture, const Part& part, int zoom) {
  if (part.x < 0 || part.y < 0 || part.x + part.width > picture.width || part.y + part.height > picture.height) {
    throw std::runtime_error("the part reaches beyond the picture");
  }
  for (int y = 0; y < part.height * zoom; ++y) {
    for (int x = 0; x < part.width * zoom; ++x) {
      const uint8_t* from = picture.at(part.x + x / zoom, part.y + y / zoom);
      std::copy(from, from + 4, strip.at(left + x, y));
    }
  }
}

void run(std::vector<std::string> arguments) {
  int quality = usualQuality;
  if (arguments.size() > 2 && arguments[0] == "--quality") {
    quality = std::atoi(arguments[1].c_str());
    arguments.erase(arguments.begin(), arguments.begin() + 2);
  }
  if (arguments.size() < 4) {
    throw std::runtime_error("usage: picture_strip [--quality N] OUT.jpg X,Y,WIDTH,HEIGHT ZOOM PICTURE...");
  }
  const Part part = parsePart(arguments[1]);
  const int zoom = std::atoi(arguments[2].c_str());
  const int count = static_cast<int>(arguments.size()) - 3;
  if (zoom < 1 || part.width < 1 || part.height < 1) {
    throw std::runtime_error("zoom, width and height must be at least 1");
  }
  Image8 strip(count * (part.width * zoom + gap) - gap, part.height * zoom);
  for (int i = 0; i < count; ++i) {
    paste(strip, i * (part.width * zoom + gap), readImage8(arguments[3 + i]), part, zoom);
  }
  replaceFile(arguments[0], encodeJpeg(strip, quality));
}

}  // namespace
}  // namespace speculum

int main(int argc, char** argv) {
  try {
    speculum::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "picture_strip: %s\n", error.what());
    return 2;
  }
}
