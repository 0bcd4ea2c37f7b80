#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "model.hpp"

namespace speculum::generator {

// A planar outline that is turned or swept into a surface. Its outside lies to the right of the direction of travel:
// upwards on the right-hand side of a turned body, from the outer edge over the top to the inner edge of a moulding.
class Profile {
 public:
  explicit Profile(glm::dvec2 start) : points_{start} {}

  Profile& line(glm::dvec2 to);
  // Circular arc; bulge = tan(angle / 4), 1 for a half circle, positive to the outside.
  Profile& arc(glm::dvec2 to, double bulge, int steps = 4);
  // Cubic Bezier curve.
  Profile& curve(glm::dvec2 control1, glm::dvec2 control2, glm::dvec2 to, int steps = 8);

  struct Segment {
    glm::dvec2 from, to;
    glm::dvec2 fromNormal, toNormal;  // averaged with the neighbour's below a bend of 35 degrees
    double fromLength, toLength;      // along the outline from its start
  };
  std::vector<Segment> segments() const;

 private:
  std::vector<glm::dvec2> points_;
};

// Turns (radius, height) about +Y. One turn of u is `uvScale` repeats; v is metres along the outline times uvScale.
void lathe(Model& model, const Profile& profile, int segments, double uvScale = 1.0);

// Sweeps (offset to the right of the path, height along +Z) along a path in the XY plane and places the result.
// Corners are mitred; `smooth` shades across them. A counter-clockwise closed path has its outside to the right.
void sweep(Model& model, const Profile& profile, const std::vector<glm::dvec2>& path, bool closed, bool smooth,
           const Affine& place, double uvScale = 1.0);

enum class BoxFaces { all, allButBottom, top };

// Axis-aligned box with its edges cut at 45 degrees by `bevel`. BoxFaces::allButBottom leaves the lowest face out;
// BoxFaces::top keeps the highest face and the cuts around it.
void box(Model& model, const glm::dvec3& low, const glm::dvec3& high, double bevel, double uvScale = 1.0,
         BoxFaces faces = BoxFaces::all);

// Paths for sweep(), counter-clockwise, centred at the origin.
std::vector<glm::dvec2> rectanglePath(double width, double height);
std::vector<glm::dvec2> ellipsePath(double width, double height, int segments);
// A rectangle with a half-circle on top; the origin is the middle of the whole.
std::vector<glm::dvec2> archPath(double width, double height, int segments);

}  // namespace speculum::generator
