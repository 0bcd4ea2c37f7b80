#pragma once

#include "edit/picture_view.hpp"

namespace speculum {

enum class GizmoMode { move, turn, scale };

// Handle that the pointer grabs. Plane handles are named by the axes along which they move.
enum class Grip {
  none,
  moveX,
  moveY,
  moveZ,
  moveYZ,
  moveZX,
  moveXY,
  moveView,
  turnX,
  turnY,
  turnZ,
  scaleX,
  scaleY,
  scaleZ,
  scaleAll
};

// Returns the axis 0, 1 or 2 of a handle, for a plane handle that of its normal; -1 for handles of the view's plane, of
// all axes and for none.
int axisOf(Grip handle);
GizmoMode modeOf(Grip handle);
constexpr bool isPlane(Grip handle) {
  return handle >= Grip::moveYZ && handle <= Grip::moveXY;
}

// Axes along which a node is scaled.
struct ScaleAxes {
  glm::dmat3 directions{1.0};  // columns, world, unit
  int count = 3;               // number of axes with handles; they come first
};

// One part of the gizmo as it is drawn over the picture.
struct GizmoShape {
  Grip handle = Grip::none;
  std::vector<glm::dvec2> points;  // pixels; a polygon if filled, else pairs of line ends
  bool filled = false;
  bool behind = false;  // the far half of a ring
};

// Handles around a point, of the same size on the picture at every distance: along the world's axes, or those of the
// node for scaling. In a PictureView through mirrors they surround the point's mirror image, whole even beyond the
// mirror's edge: they belong to no surface, and a part that is cut could not be grabbed.
class Gizmo {
 public:
  // `pivot` in the world; `arm`: length of an axis and radius of a ring, pixels.
  Gizmo(GizmoMode mode, const glm::dvec3& pivot, double arm, const ScaleAxes& scaleAxes = {})
      : mode_(mode), pivot_(pivot), arm_(arm), scaleAxes_(scaleAxes) {}

  // Returns the shapes to draw; those on top come last. None if the picture cannot show the pivot.
  std::vector<GizmoShape> shapes(const PictureView& picture) const;
  // Returns the handle nearest to a pixel of the picture, within `reach` pixels; Grip::none if there is none.
  Grip at(const PictureView& picture, const glm::dvec2& pixel, double reach) const;

  double arm() const { return arm_; }
  const glm::dvec3& pivot() const { return pivot_; }
  glm::dvec3 axis(int axis) const;  // of the handles, world, unit

 private:
  GizmoMode mode_;
  glm::dvec3 pivot_;
  double arm_;
  ScaleAxes scaleAxes_;
};

// A drag of one handle from press to release, in the picture as it was at the press.
class GizmoDrag {
 public:
  struct Change {
    glm::dvec3 translation{0.0};  // metres, world
    glm::dmat3 rotation{1.0};     // about the pivot
    double degrees = 0.0;         // of the rotation, about the positive axis
    glm::dvec3 factors{1.0};      // of the size, along ScaleAxes
  };
  static constexpr double moveSnap = 0.1;   // metres
  static constexpr double turnSnap = 15.0;  // degrees
  static constexpr double scaleSnap = 0.1;

  GizmoDrag(const PictureView& picture, const Gizmo& gizmo, Grip handle, const glm::dvec2& pixel);

  Grip handle() const { return handle_; }
  // Returns the total change since the press for a pointer at `pixel`. Where the pointer's ray misses the handle's
  // plane, as above the plane's horizon, the last change stays. With `snap` the change goes in steps of moveSnap,
  // turnSnap or scaleSnap; without, it is rounded to less than a tenth of a pixel, for short numbers.
  Change to(const glm::dvec2& pixel, bool snap);

 private:
  std::optional<glm::dvec3> moveAt(const glm::dvec2& pixel) const;
  std::optional<double> factorAt(const glm::dvec2& pixel) const;
  std::optional<double> angleAt(const glm::dvec2& pixel) const;
  std::optional<glm::dvec3> meet(const glm::dvec2& pixel) const;

  PictureView picture_;
  Grip handle_;
  glm::dvec3 pivot_;
  double arm_;
  glm::dvec3 axis_{0.0};    // of the handle
  glm::dvec3 normal_{0.0};  // of the plane that the pointer's ray meets
  bool onScreen_ = false;   // the plane is seen edge-on: pixels are counted instead
  glm::dvec2 screen_{0.0};  // unit direction on the picture along which pixels count
  glm::dvec2 pressed_;      // pixels
  glm::dvec3 start_{0.0};   // where the ray met the plane at the press
  double lastAngle_ = 0.0;  // degrees
  double turned_ = 0.0;     // degrees since the press, not rounded
  Change change_;
};

}  // namespace speculum
