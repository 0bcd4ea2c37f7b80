#pragma once

#include <span>
#include <vector>

#include "frame/frame_plan.hpp"

namespace speculum {

// A mirror before the eye of some view.
struct Sight {
  MirrorDraw draw;                  // without what the settings make of it
  double height = 0.0;              // metres, of the eye above the mirror's front; exactly 0: in its plane
  std::vector<glm::dvec3> visible;  // world; what the view shows of it
};
Sight sightOf(const Scene& scene, const SceneState& state, const View& view, int mirror);

// Upper bound of the reflectance of what is visible. Schlick's F grows towards grazing; the flattest view of a polygon
// is that of its farthest vertex.
glm::dvec3 reflectanceBound(const Mirror& mirror, const EffectSettings& effects, const Plane& plane,
                            const glm::dvec3& eye, std::span<const glm::dvec3> visible);

bool isRough(const Mirror& mirror, const EffectSettings& effects);

// Whether rays show what the image of the mirror's plane cannot. Without reflection, at a limit of depth or throughput,
// only ripples show.
bool scatters(const Mirror& mirror, const EffectSettings& effects, bool reflects);

}  // namespace speculum
