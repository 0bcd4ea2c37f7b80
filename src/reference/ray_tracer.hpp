#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "image/image.hpp"
#include "scene/scene_state.hpp"

namespace speculum {

struct TraceOptions {
  int width = 1280;  // pixels
  int height = 720;
  int samples = 64;  // per pixel, a square: on a regular grid of sqrt(samples) x sqrt(samples)
  int maxDepth = 4;  // mirrors seen directly have depth 0; those of this depth and beyond show the background
  double minThroughput = 0.0005;         // mirrors whose throughput falls below it show the background
  std::optional<glm::dvec3> clearColor;  // linear; replaces the environment's background and sky everywhere
  int roughSamples = 64;  // reflected rays of a rough mirror seen directly; mirrors seen in it take fewer
};

struct TraceResult {
  LinearImage image;
  // Per pixel, row 0 at the top, for the ray through its centre:
  std::vector<uint8_t> mirrorMask;       // 1: it meets the reflecting side of a mirror first
  std::vector<uint8_t> backgroundMask;   // 1: it meets nothing
  std::vector<uint8_t> mirrorDepth;      // reflecting sides in a row, at most maxDepth + 1; roughness is ignored
  std::vector<double> mirrorThroughput;  // product of their reflectances, mean of the channels; 1 without any
};

// The first surface on a ray.
struct PickResult {
  enum class Kind { nothing, object, mirror, light };
  Kind kind = Kind::nothing;
  int index = -1;           // into SceneState::instances, mirrors or lights
  int64_t triangle = -1;    // of objects: three indices from Mesh::indices[3 * triangle] on
  double distance = 0.0;    // metres (lengths of the given direction)
  bool mirrorFront = true;  // of mirrors
};

// Ray tracer in double precision, whose pictures are the reference: each sample is the radiance that docs/picture.md
// defines. Reflections are traced from the reflected eye, starting at the mirror, so nothing is moved off a surface.
// Rough mirrors are sampled with a fixed low-discrepancy sequence per pixel, so every run gives the same bits whatever
// the number of threads (those of the calling oneTBB arena).
//
// Choices that the picture's definition leaves: a rippled mirror is one height field seen from either side; a rough
// mirror that is cut off shows the background of the smooth reflection; the second leg of mirrored light ignores only
// the mirror that it comes from.
class RayTracer {
 public:
  // Keeps a reference to `scene`, which must outlive the tracer and not change.
  RayTracer(const Scene& scene, const SceneState& state);
  ~RayTracer();
  RayTracer(RayTracer&&) noexcept;
  RayTracer& operator=(RayTracer&&) noexcept;

  // Moves to another time or camera of the same scene and keeps the hierarchies of its meshes.
  void setState(const SceneState& state);

  // Receives the finished fraction, 0 .. 1, from one thread of the arena at a time; returning false cancels.
  using Progress = std::function<bool(double)>;

  // Nothing if cancelled. Throws std::invalid_argument for an empty size, samples that are no square, or less than one
  // rough sample.
  std::optional<TraceResult> render(const TraceOptions& options, const Progress& progress = {}) const;

  // Mean radiance of one pixel, as render() computes it.
  glm::dvec3 pixel(const TraceOptions& options, int x, int y) const;

  // Radiance along a ray given in world space; `direction` of any length > 0.
  glm::dvec3 radiance(const TraceOptions& options, const glm::dvec3& origin, const glm::dvec3& direction) const;

  PickResult pick(const glm::dvec3& origin, const glm::dvec3& direction) const;
  // `x`, `y` in pixels from the top left corner of a picture of the given size; pixel centres are at + 0.5.
  PickResult pickPixel(int width, int height, double x, double y) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace speculum
