#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "image/image.hpp"
#include "scene/trace_world.hpp"

namespace speculum {

struct TraceOptions {
  int width = 1280;  // pixels
  int height = 720;
  int samples = 64;      // per pixel, a square: on a regular grid of sqrt(samples) x sqrt(samples)
  bool lattice = false;  // instead of the grid, a lattice that has no point in common with a smaller or equal grid
  int maxDepth = 4;      // mirrors seen directly have depth 0; mirrors of depth maxDepth and beyond show the background
  double minThroughput = 0.0005;         // mirrors with less throughput show the background
  std::optional<glm::dvec3> clearColor;  // linear; replaces background and sky of the scene everywhere
  int roughSamples = 64;  // reflected rays of the first rough mirror on a path; rough mirrors seen in it take fewer
};

struct TraceResult {
  LinearImage image;
  // Per pixel, row 0 at the top, for the ray through its centre:
  std::vector<uint8_t> backgroundMask;  // 1: the ray meets nothing
  std::vector<uint8_t> mirrorDepth;     // reflecting sides in a row, at most maxDepth + 1; roughness is ignored
};

// Ray tracer in double precision, whose pictures are the reference: each sample is the radiance that docs/picture.md
// defines. Reflections are traced from the reflected eye, starting at the mirror, so no origin has to be moved off a
// surface. Rough mirrors are sampled with a fixed low-discrepancy sequence per pixel, so every run gives the same bits
// whatever the number of threads (those of the calling oneTBB arena).
//
// Choices that the definition leaves open: a rippled mirror is one height field seen from either side; a rough mirror
// that is cut off shows the background of the smooth reflection; the second leg of bounced light ignores only the
// mirror that it comes from.
class RayTracer {
 public:
  // Keeps a reference to `scene`, which must outlive the tracer and not change.
  RayTracer(const Scene& scene, const SceneState& state);

  // Receives the finished fraction, 0 .. 1, from one thread of the arena at a time; returning false cancels.
  using Progress = std::function<bool(double)>;

  // Returns nothing if cancelled. Throws std::invalid_argument for an empty size, samples that are no square, or less
  // than one rough sample.
  std::optional<TraceResult> render(const TraceOptions& options, const Progress& progress = {}) const;

  // Returns the radiance along a ray given in world space; `direction` may have any length > 0.
  glm::dvec3 radiance(const TraceOptions& options, const glm::dvec3& origin, const glm::dvec3& direction) const;

 private:
  // Returns the ray through a point of the picture, pixels from the top left corner; the eye is the origin.
  Ray cameraRay(const TraceOptions& options, double x, double y) const;
  void tile(const Environment& environment, const TraceOptions& options, int x0, int y0, TraceResult& result) const;

  TraceWorld world_;
  CameraPose camera_;
  double time_;  // seconds
};

}  // namespace speculum
