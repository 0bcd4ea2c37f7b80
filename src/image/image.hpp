#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

// Linear RGB radiance, row 0 at the top.
struct LinearImage {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> pixels;

  LinearImage() = default;
  LinearImage(int w, int h) : width(w), height(h), pixels(static_cast<size_t>(w) * h) {}
  glm::vec3& at(int x, int y) { return pixels[static_cast<size_t>(y) * width + x]; }
  const glm::vec3& at(int x, int y) const { return pixels[static_cast<size_t>(y) * width + x]; }
};

// Display-referred sRGB, 8 bits a channel, RGBA interleaved, row 0 at the top.
struct Image8 {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgba;
  bool hasAlpha = false;  // the file that it was read from has an alpha channel

  Image8() = default;
  Image8(int w, int h) : width(w), height(h), rgba(static_cast<size_t>(w) * h * 4, 255) {}
  uint8_t* at(int x, int y) { return &rgba[(static_cast<size_t>(y) * width + x) * 4]; }
  const uint8_t* at(int x, int y) const { return &rgba[(static_cast<size_t>(y) * width + x) * 4]; }
};

// Stretches the image to `width` x `height` pixels, no fewer than it has, as the shader display_enlarge.frag does:
// bilinearly, because that never rings nor falls below zero, and a spline through sixteen texels took half of a moving
// frame's time on a CPU. Equal sizes change nothing.
LinearImage enlarged(const LinearImage& image, int width, int height);

struct PictureSize {
  int width = 0;  // pixels
  int height = 0;

  bool operator==(const PictureSize&) const = default;
};

// Text for messages: what pictureSize() takes.
constexpr std::string_view pictureSizes = "WIDTHxHEIGHT in pixels, 1x1 to 16384x16384";

// Parses "640x360". Returns nothing for any other text.
std::optional<PictureSize> pictureSize(std::string_view text);

enum class ToneMap { clamp, aces };

// The curve of sRGB (IEC 61966-2-1) and its inverse. Both take and return [0, 1].
double srgbEncode(double linear);
double srgbDecode(double encoded);
const std::array<float, 256>& srgbDecoded();  // srgbDecode() by 8-bit code
// Returns the 8-bit code for which srgbDecoded() has exactly this value; nothing if there is none.
std::optional<uint8_t> srgbCode(float linear);

// Settings that turn radiance into a picture, besides the sRGB curve.
struct DisplayCurve {
  double exposure = 1.0;
  ToneMap toneMap = ToneMap::clamp;

  bool operator==(const DisplayCurve&) const = default;
};

// Applies exposure, tone curve and sRGB curve to one channel. Returns [0, 1]; 0 for what is no number.
double displayValue(double linear, const DisplayCurve& curve);
// Does so for a picture and rounds to the nearest 8 bits, as shaders/display.glsl does.
Image8 toDisplay(const LinearImage& image, const DisplayCurve& curve = {});

}  // namespace speculum
