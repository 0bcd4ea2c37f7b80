#include "systems/mirror_polygons.hpp"

#include <algorithm>

#include "geometry/projection.hpp"

namespace speculum {

namespace {

// In pixels: the error of vertices snapped to 1/256 of a pixel. A wider fringe shows at recursion depth 32.
constexpr double fringeWidth = 1.0 / 256.0;
// Depth behind everything but the background.
constexpr double fringeDepth = 1e-25;

// Moves a mirror's polygon behind the mirrors that cover it in its plane: for each layer by a thousandth of the
// distance, and by more than rounding moves any depth in the plane.
ClipPolygon movedBack(ClipPolygon clip, int layer, double largestDepth) {
  for (glm::dvec4& v : clip) {
    const double step = std::max(0x1p-10 * v.z, 0x1p-16 * largestDepth * v.w);
    v.z = std::max(fringeDepth * v.w, v.z - layer * step);
  }
  return clip;
}

}  // namespace

std::vector<std::vector<ClipPolygon>> mirrorPolygons(const Pass& pass, const glm::dmat4& projection) {
  std::vector<std::vector<ClipPolygon>> polygons;
  for (const MirrorDraw& draw : pass.mirrors) {
    std::vector<ClipPolygon>& own = polygons.emplace_back();
    const std::span<const Polygon> pieces = draw.pieces.empty() ? std::span(&draw.polygon, 1) : std::span(draw.pieces);
    for (const Polygon& piece : pieces) {
      if (piece.empty()) {
        continue;  // outside the view
      }
      ClipPolygon& clip = own.emplace_back();
      for (const glm::dvec3& p : piece) {
        clip.push_back(projection * glm::dvec4(pass.view.worldToView * (p - pass.view.eye), 1.0));
      }
    }
  }
  return polygons;
}

std::vector<ClipPolygon> partsToDraw(const Pass& pass, const SceneState& state,
                                     std::span<const std::vector<ClipPolygon>> polygons, size_t index, size_t& cuts) {
  constexpr size_t mostParts = 1024;
  constexpr size_t mostCuts = 100'000;  // about 10 ms
  const MirrorDraw& draw = pass.mirrors[index];
  std::vector<ClipPolygon> parts = polygons[index];
  if (draw.layer == 0) {
    return parts;
  }
  double largestDepth = 0.0;
  for (size_t i = 0; i < polygons.size(); ++i) {
    const MirrorDraw& other = pass.mirrors[i];
    if (state.mirrors[other.mirror].plane != state.mirrors[draw.mirror].plane) {
      continue;
    }
    for (const ClipPolygon& polygon : polygons[i]) {
      for (const glm::dvec4& v : polygon) {
        largestDepth = std::max(largestDepth, v.z / v.w);
      }
      if (other.layer < draw.layer && parts.size() <= mostParts && cuts <= mostCuts) {
        cuts += parts.size();
        cutAway(parts, polygon);
      }
    }
  }
  if (parts.size() > mostParts || cuts > mostCuts) {
    parts.clear();
  } else if (parts.empty()) {
    return parts;
  }
  for (const ClipPolygon& polygon : polygons[index]) {
    parts.push_back(movedBack(polygon, draw.layer, largestDepth));
  }
  return parts;
}

void addFan(std::vector<glm::vec4>& vertices, std::span<const glm::dvec4> polygon) {
  for (size_t i = 1; i + 1 < polygon.size(); ++i) {
    vertices.insert(vertices.end(), {polygon[0], polygon[i], polygon[i + 1]});
  }
}

void addFringe(std::vector<glm::vec4>& vertices, std::span<const glm::dvec4> clip, const glm::dvec2& size) {
  const std::vector<glm::dvec4> outer = grown(clip, size.x, size.y, fringeWidth);
  const auto far = [](const glm::dvec4& v) { return glm::vec4(v.x, v.y, fringeDepth * v.w, v.w); };
  for (size_t i = 0; i < clip.size(); ++i) {
    const size_t next = (i + 1) % clip.size();
    vertices.insert(vertices.end(), {far(clip[i]), far(outer[i]), far(outer[next])});
    vertices.insert(vertices.end(), {far(clip[i]), far(outer[next]), far(clip[next])});
  }
}

}  // namespace speculum
