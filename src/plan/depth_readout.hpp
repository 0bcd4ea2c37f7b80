#pragma once

#include <optional>

#include "plan/frame_plan.hpp"

namespace speculum {

// Smallest gap between two parallel surfaces that the depth test keeps in order on every pixel, at the farthest point
// that a pass sees, for each clip method. geometry/depth_resolution.hpp derives it.
struct DepthReadout {
  double distance = 0.0;  // metres from the pass's eye, along the reflected path
  // Metres along the line of sight. Empty if no gap is kept in order, or if the view has no such projection.
  std::optional<double> oblique;
  std::optional<double> plain;  // with the other clip methods, which leave depth as it is
};

// Degrees from facing at which the surfaces of a readout are seen.
inline constexpr double readoutAngle = 45.0;

// Farthest point that a pass draws, in view space. It lies on the bounding sphere of an object or glyph, as far as that
// reaches into the view's cone, or on a mirror's visible region. Nothing that is seen is farther.
struct FarthestPoint {
  glm::dvec3 point{0.0};
  double extent = 0.0;  // metres; radius of the bounding sphere it lies on, 0 for a mirror
};
std::optional<FarthestPoint> farthestVisible(const Pass& pass, const Projection& projection, const Scene& scene,
                                             const SceneState& state);

// Returns nothing if the pass sees only the background.
std::optional<DepthReadout> depthReadout(const Pass& pass, const Projection& projection, const Scene& scene,
                                         const SceneState& state);

// The readout's gap for one clip method.
std::optional<double> gapWith(const DepthReadout& readout, ClipMethod clip);

}  // namespace speculum
