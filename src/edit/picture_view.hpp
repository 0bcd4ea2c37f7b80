#pragma once

#include <optional>
#include <span>
#include <vector>

#include "frame/view.hpp"
#include "geometry/bvh.hpp"

namespace speculum {

// A straight line on the picture, in pixels from its top left corner.
struct PixelLine {
  glm::dvec2 a{0.0};
  glm::dvec2 b{0.0};
};

// The picture that a person sees and points into, or what it shows in a chain of mirrors. It projects exactly as passes
// do. Pixels run from the top left corner; the centre of the first one is at (0.5, 0.5).
class PictureView {
 public:
  PictureView(const CameraPose& camera, int width, int height);
  // The image of the world that is seen through these mirrors, indices into SceneState::mirrors from the eye. Nothing
  // if one of them is not there, or not seen from its reflecting side.
  std::optional<PictureView> through(const Scene& scene, const SceneState& state, std::span<const int> path) const;

  const View& view() const { return view_; }
  const glm::dvec3& eye() const { return view_.eye; }  // world; reflected about the mirrors
  const std::vector<int>& path() const { return view_.path; }
  glm::dvec3 forward() const;  // world, unit
  // From the eye through a point of the picture; the direction is one metre deep, not of unit length.
  Ray ray(const glm::dvec2& pixel) const;
  double depth(const glm::dvec3& world) const;  // metres in front of the eye's plane
  // Nothing for what is nearer than the near plane.
  std::optional<glm::dvec2> pixel(const glm::dvec3& world) const;
  double metresPerPixel(const glm::dvec3& world) const;  // at its depth
  // The part of it beyond the near plane and within what is seen: the picture, or the last mirror of the path.
  std::optional<PixelLine> line(const glm::dvec3& a, const glm::dvec3& b) const;
  std::optional<PixelLine> clipped(const PixelLine& line) const;
  bool sees(const glm::dvec3& center, double radius) const { return sphereVisible(view_, center, radius); }

 private:
  PictureView(View view, const Projection& projection);
  glm::dvec2 toPixel(const glm::dvec4& clip) const;

  View view_;
  Projection projection_;
  std::vector<glm::dvec2> shown_;  // convex, pixels: where on the picture it is seen
};

}  // namespace speculum
