#include "app/pass_outlines.hpp"

#include <algorithm>

namespace speculum {

namespace {

// The view in which the last mirror of the path is drawn; null if it has no pass.
const PlannedPass* seenIn(const FramePlan& plan, const std::vector<int>& path) {
  const std::vector<int> parent(path.begin(), path.end() - 1);
  if (parent.empty()) {
    return &plan.main;
  }
  const auto pass =
      std::find_if(plan.passes.begin(), plan.passes.end(), [&](const PlannedPass& p) { return p.view.path == parent; });
  return pass == plan.passes.end() ? nullptr : &*pass;
}

}  // namespace

std::vector<glm::vec2> outlineOf(const FramePlan& plan, const std::vector<int>& path, int width, int height) {
  std::vector<glm::vec2> outline;
  const PlannedPass* parent = path.empty() ? nullptr : seenIn(plan, path);
  Projection projection = plan.projection;
  projection.offset = glm::dvec2(0.0);  // outlines stay while pictures are accumulated
  if (!parent) {
    return outline;
  }
  for (const MirrorDraw& draw : parent->mirrors) {
    if (draw.mirror != path.back()) {
      continue;
    }
    for (const glm::dvec4& clip : toClip(parent->view, projection, visiblePart(parent->view, draw.polygon))) {
      // A vertex in the eye's plane has no place on the screen.
      if (clip.w <= 1e-12) {
        return {};
      }
      outline.emplace_back((0.5 * clip.x / clip.w + 0.5) * width, (0.5 * clip.y / clip.w + 0.5) * height);
    }
  }
  return outline;
}

}  // namespace speculum
