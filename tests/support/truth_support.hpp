#pragma once

#include <array>
#include <filesystem>
#include <random>
#include <string>

#include "picture_support.hpp"
#include "reference/ray_tracer.hpp"

// The rasteriser against the ray tracer, one sample each.
namespace speculum::testing_support {

struct Truth {
  Image8 picture;
  TraceResult traced;
};

Truth trace(const std::filesystem::path& file, PictureSize size, int maxDepth, double time = 0.0);

// Options under which the renderer draws what trace() traces: one sample, no bound on passes.
Options truthOptions(const std::filesystem::path& file, PictureSize size, int maxDepth);

// Every pixel that is not background within 2/255, but for one in a thousand and no 3x3 block wholly over.
void expectTruth(const std::filesystem::path& file, PictureSize size, int maxDepth, const Truth& truth,
                 double time = 0.0);

// Whether each pixel is something else than background.
std::vector<bool> notBackground(const TraceResult& traced);

// Share of the values that are at least that.
double share(const std::vector<uint8_t>& values, int atLeast);

// What random scenes are made of, as text.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  template <size_t n>
  std::string pick(const std::array<const char*, n>& names) {
    return names[static_cast<size_t>(uniform(0.0, n - 1e-9))];
  }
  std::string vec(double low, double high);

 private:
  std::mt19937 engine_;
};

// A lumpy sphere about the origin, at most 0.85 m in radius, written beside the scenes of writeScene; without normals
// for odd seeds, so that flat shading is met as well. Returns the file.
std::string writeRandomMesh(unsigned seed);

}  // namespace speculum::testing_support
