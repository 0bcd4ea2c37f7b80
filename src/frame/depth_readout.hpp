#pragma once

#include <optional>

#include "frame/frame_plan.hpp"

namespace speculum {

// The smallest gap between two parallel surfaces that depth keeps in order on every pixel, where a pass sees farthest,
// for each way to cut geometry at the mirror. See optics/depth_resolution.hpp.
struct DepthReadout {
  double distance = 0.0;  // metres from the pass's eye, along the reflected path
  // Metres along the line of sight. Nothing: no gap is, or there is no such projection for this view.
  std::optional<double> clipDistance;
  std::optional<double> oblique;
  std::optional<double> none;
};

// The angle from facing at which the surfaces of a readout are seen, degrees.
inline constexpr double readoutAngle = 45.0;

// Of a view, the farthest point of what is drawn in it: of the bounding spheres of objects and light glyphs, as far as
// they reach into the view's cone, and of the mirrors' visible parts. Not nearer than what is seen. View space.
struct FarthestPoint {
  glm::dvec3 point{0.0};
  double extent = 0.0;  // metres; radius of the body that it belongs to, 0 for a mirror
};
std::optional<FarthestPoint> farthestVisible(const PlannedPass& pass, const Projection& projection, const Scene& scene,
                                             const SceneState& state);

// Nothing if the pass sees only the background.
std::optional<DepthReadout> depthReadout(const PlannedPass& pass, const Projection& projection, const Scene& scene,
                                         const SceneState& state);

// That of the readout for one method.
std::optional<double> gapWith(const DepthReadout& readout, ClipMethod clip);

}  // namespace speculum
