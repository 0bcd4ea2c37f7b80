#include <algorithm>
#include <cmath>

#include "image/picture_files.hpp"
#include "models.hpp"

namespace speculum::generator {
namespace {

uint32_t hash(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t h = x * 0x8da6b343u ^ y * 0xd8163841u ^ seed * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return h ^ (h >> 15);
}

double fade(double t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

// Gradient noise (Perlin 2002) on a lattice that repeats every `period` cells; about -1..1.
double noise(double x, double y, int period, uint32_t seed) {
  const double fx = std::floor(x), fy = std::floor(y), tx = x - fx, ty = y - fy;
  const auto corner = [&](int dx, int dy) {
    const auto wrap = [&](double c) {
      return static_cast<uint32_t>(((static_cast<int>(c) % period) + period) % period);
    };
    const double angle = hash(wrap(fx + dx), wrap(fy + dy), seed) * (2.0 * kPi / 4294967296.0);
    return std::cos(angle) * (tx - dx) + std::sin(angle) * (ty - dy);
  };
  const double u = fade(tx), v = fade(ty);
  const double low = corner(0, 0) + u * (corner(1, 0) - corner(0, 0));
  const double high = corner(0, 1) + u * (corner(1, 1) - corner(0, 1));
  return 1.4 * (low + v * (high - low));
}

double turbulence(double u, double v, int period, int octaves, uint32_t seed) {
  double sum = 0.0, weight = 0.5;
  for (int k = 0; k < octaves; ++k, period *= 2, weight *= 0.5)
    sum += weight * noise(u * period, v * period, period, seed + k);
  return sum;
}

using Color = glm::dvec3;

// Veins along the zero lines of a warped noise.
double vein(double u, double v, int period, double sharpness, uint32_t seed) {
  const double wu = u + 0.13 * turbulence(u, v, 3, 4, seed + 40), wv = v + 0.13 * turbulence(u, v, 3, 4, seed + 60);
  return std::exp(-sharpness * std::abs(turbulence(wu, wv, period, 3, seed)));
}

Color whiteMarble(double u, double v) {
  const double cloud = turbulence(u, v, 3, 5, 3), grey = 0.75 * vein(u, v, 2, 22.0, 9) + 0.3 * vein(u, v, 4, 34.0, 21);
  const Color base = Color(0.94, 0.93, 0.91) + 0.05 * cloud;
  return glm::mix(base, Color(0.60, 0.60, 0.62), std::min(0.8, 0.75 * grey));
}

Color greenMarble(double u, double v) {
  const double cloud = 0.5 + 0.5 * turbulence(u, v, 4, 5, 103);
  const double white = 0.7 * vein(u, v, 3, 26.0, 109) + 0.35 * vein(u, v, 6, 40.0, 121);
  const Color base = glm::mix(Color(0.12, 0.22, 0.19), Color(0.22, 0.36, 0.31), cloud);
  return glm::mix(base, Color(0.62, 0.70, 0.64), std::min(0.75, white));
}

// v runs once over the height of a wall: the lowest and highest parts are darker, as light reaches corners less.
Color plaster(double u, double v) {
  const double grain = 0.022 * turbulence(u, v, 24, 3, 203) + 0.035 * turbulence(u, v, 4, 4, 233);
  const double corner = 0.20 * std::exp(-9.0 * v) + 0.26 * std::exp(-7.0 * (1.0 - v));
  return Color(0.93, 0.90, 0.86) * (1.0 - corner) + grain;
}

Color wood(double u, double v) {
  const double warp = turbulence(u, v, 2, 3, 303);
  const double rings = 0.5 + 0.5 * std::sin(2.0 * kPi * (7.0 * v + 1.6 * warp));
  const double fibre = noise(u * 8.0, v * 128.0, 128, 313);
  const Color dark(0.30, 0.17, 0.10), light(0.52, 0.33, 0.20);
  return glm::mix(dark, light, std::clamp(0.2 + 0.6 * rings * rings + 0.25 * fibre, 0.0, 1.0));
}

// Colors are display-referred sRGB. Rounded to multiples of 3/255: a third of the bits would only store grain.
void write(const std::filesystem::path& file, int size, Color (*color)(double, double)) {
  Image8 image(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Color c = glm::clamp(color((x + 0.5) / size, 1.0 - (y + 0.5) / size), 0.0, 1.0);
      for (int k = 0; k < 3; ++k) image.at(x, y)[k] = static_cast<uint8_t>(3.0 * std::round(c[k] * 85.0));
    }
  }
  writePng(file, image);
}

}  // namespace

void writeTextures(const std::filesystem::path& directory) {
  write(directory / "marble_white.png", 256, whiteMarble);
  write(directory / "marble_green.png", 256, greenMarble);
  write(directory / "plaster.png", 256, plaster);
  write(directory / "wood.png", 256, wood);
}

}  // namespace speculum::generator
