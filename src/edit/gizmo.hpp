#pragma once

#include "edit/picture_view.hpp"

namespace speculum {

enum class GizmoMode { move, turn };

// What the pointer takes hold of. Planes are named by the axes along which they move.
enum class Grip { none, moveX, moveY, moveZ, moveYZ, moveZX, moveXY, moveView, turnX, turnY, turnZ };

// The axis of the world that a handle stands for: 0, 1, 2; of a plane its normal. -1 for the view's plane and none.
int axisOf(Grip handle);

// A part of the gizmo over the picture.
struct GizmoShape {
  Grip handle = Grip::none;
  std::vector<glm::dvec2> points;  // pixels; a polygon if it is filled, otherwise pairs of ends of lines
  bool filled = false;
  bool behind = false;  // the far half of a ring
};

// Handles about a point along the world's axes, as large on the picture wherever the point is. In a mirror they are
// those of the mirror's image.
class Gizmo {
 public:
  // `pivot` in the world; `arm`: length of an axis and radius of a ring, pixels.
  Gizmo(GizmoMode mode, const glm::dvec3& pivot, double arm) : mode_(mode), pivot_(pivot), arm_(arm) {}

  // Nothing for a point that the picture cannot show.
  std::vector<GizmoShape> shapes(const PictureView& picture) const;
  // The handle within `reach` pixels of a point of the picture.
  Grip at(const PictureView& picture, const glm::dvec2& pixel, double reach) const;

  double arm() const { return arm_; }
  const glm::dvec3& pivot() const { return pivot_; }

 private:
  GizmoMode mode_;
  glm::dvec3 pivot_;
  double arm_;
};

// Moves or turns by one handle, from press to release, in the picture as it was at the press.
class GizmoDrag {
 public:
  struct Change {
    glm::dvec3 translation{0.0};  // metres, world
    glm::dmat3 rotation{1.0};     // about the pivot
    double degrees = 0.0;         // of the rotation, about the positive axis
  };
  static constexpr double moveSnap = 0.1;   // metres
  static constexpr double turnSnap = 15.0;  // degrees

  GizmoDrag(const PictureView& picture, const Gizmo& gizmo, Grip handle, const glm::dvec2& pixel);

  Grip handle() const { return handle_; }
  // What the pointer asks for in all since the press. Where its ray meets nothing, say above the horizon of a plane,
  // the last change stays. Without `snap` it is rounded to less than a tenth of a pixel, for short numbers.
  Change to(const glm::dvec2& pixel, bool snap);

 private:
  std::optional<glm::dvec3> moveAt(const glm::dvec2& pixel) const;
  std::optional<double> angleAt(const glm::dvec2& pixel) const;
  std::optional<glm::dvec3> meet(const glm::dvec2& pixel) const;

  PictureView picture_;
  Grip handle_;
  glm::dvec3 pivot_;
  double arm_;
  glm::dvec3 axis_{0.0};    // of the handle
  glm::dvec3 normal_{0.0};  // of the plane that the pointer's ray meets
  bool onScreen_ = false;   // the plane shows its edge: pixels are counted instead
  glm::dvec2 screen_{0.0};  // then: the direction on the picture that counts, unit
  glm::dvec2 pressed_;      // pixels
  glm::dvec3 start_{0.0};   // where the ray met the plane at the press
  double lastAngle_ = 0.0;  // degrees
  double turned_ = 0.0;     // degrees since the press, not rounded
  Change change_;
};

}  // namespace speculum
