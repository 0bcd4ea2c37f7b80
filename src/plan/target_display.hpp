#pragma once

#include <optional>

#include "plan/view.hpp"

namespace speculum {

enum class TargetKind { color, depth };

// Says whether the pass with this path has this target in every frame: only the main view has, its colors.
inline bool isAlwaysThere(const MirrorPath& path, TargetKind kind) {
  return path.empty() && kind == TargetKind::color;
}

// A pass's target, shown over the picture in an area of the display image.
struct TargetDisplay {
  int pass = 0;    // index into FramePlan::passes
  PixelRect area;  // pixels
  TargetKind kind = TargetKind::color;
  double zoom = 0.0;                // display pixels for each texel; 0 fits the image into the area's middle
  glm::dvec2 origin{0.0};           // texel at the area's upper left corner; only if zoom > 0
  double halfDistance = 1.0;        // metres from the eye that depth shows half bright
  std::optional<glm::ivec2> probe;  // texel to read: see SceneRenderer::probed
};

// Value of a target at one texel.
struct TexelValue {
  glm::ivec2 texel{0};      // from the target's top left
  bool depth = false;       // the target is a depth image; `value` is 0 then
  glm::vec4 value{0.0f};    // linear radiance, disparity in 1/m; the mean of the texel's samples
  float storedDepth = 0.0;  // of the first sample; near plane / metres along the view, 0: infinitely far
};

}  // namespace speculum
