#pragma once

#include <optional>

#include "plan/frame_plan.hpp"

namespace speculum {

// Smallest gap between two parallel surfaces that the depth test keeps in order on every pixel, at the farthest point
// that a pass sees, for each clip method. geometry/projection.hpp derives the gap.
struct DepthReadout {
  double distance = 0.0;  // metres from the pass's eye, along the reflected path
  // Gaps in metres along the line of sight; empty if no gap is kept in order. `oblique` is empty also without a clip
  // plane.
  std::optional<double> oblique;
  std::optional<double> plain;  // with the other clip methods, which leave depth as it is
};

// Angle in degrees by which the surfaces of a readout are tilted away from the eye.
inline constexpr double readoutAngle = 45.0;

// Farthest point that a pass draws, in view space. It lies on the bounding sphere of an object or glyph, as far as the
// sphere reaches into the view's cone, or on a mirror's visible region. The pass sees nothing farther away.
struct FarthestPoint {
  glm::dvec3 point{0.0};
  double extent = 0.0;  // metres; radius of the bounding sphere that the point lies on, 0 for a mirror
};
std::optional<FarthestPoint> farthestVisible(const Pass& pass, const Projection& projection, const Scene& scene,
                                             const SceneState& state);

// Returns the readout of a pass; nothing if the pass sees only the background.
std::optional<DepthReadout> depthReadout(const Pass& pass, const Projection& projection, const Scene& scene,
                                         const SceneState& state);

// Returns the readout's gap with this clip method, metres.
std::optional<double> gapWith(const DepthReadout& readout, ClipMethod clip);

}  // namespace speculum
