#include <cmath>

#include "models.hpp"
#include "profile.hpp"

namespace speculum::generator {
namespace {

constexpr int kSegments = 28;

// The turned foot that all pieces share, up to the waist: a base of `radius`, its moulding scaled with it.
Profile foot(double radius) {
  const double r = radius;
  Profile p({0.0, 0.004});
  p.line({0.93 * r, 0.004}).line({0.95 * r, 0.0}).line({r, 0.012});
  p.line({r, 0.16 * r}).arc({0.93 * r, 0.30 * r}, 0.35).line({0.84 * r, 0.33 * r});
  p.arc({0.78 * r, 0.50 * r}, 0.8, 6).line({0.72 * r, 0.52 * r});
  return p;
}

// A collar: a thin disc between two hollows, at height y.
void collar(Profile& p, double waist, double radius, double y) {
  p.line({waist * 1.12, y - 0.012}).arc({radius, y}, -0.3, 3).arc({radius, y + 0.018}, 0.9, 4);
  p.arc({waist * 1.15, y + 0.030}, -0.3, 3);
}

// A ring segment from angle a to b (radians) between two radii and heights, with all six faces.
void merlon(Model& model, double inner, double outer, double low, double high, double a, double b) {
  const auto radial = [](double angle) { return glm::dvec3(std::sin(angle), 0.0, std::cos(angle)); };
  const auto at = [&](double angle, double r, double y) { return radial(angle) * r + glm::dvec3(0.0, y, 0.0); };
  model.surface(4, 1, [&](double u, double v) {
    const double angle = a + (b - a) * u;
    return Corner{at(angle, outer, low + (high - low) * v), radial(angle), {u, v}};
  });
  model.surface(4, 1, [&](double u, double v) {
    const double angle = a + (b - a) * u;
    return Corner{at(angle, inner, low + (high - low) * v), -radial(angle), {u, v}};
  });
  model.surface(4, 1, [&](double u, double v) {
    return Corner{at(a + (b - a) * u, inner + (outer - inner) * v, high), {0.0, 1.0, 0.0}, {u, v}};
  });
  for (const double angle : {a, b}) {
    const glm::dvec3 normal = glm::dvec3(std::cos(angle), 0.0, -std::sin(angle)) * (angle == a ? -1.0 : 1.0);
    model.quad({at(angle, inner, low), at(angle, outer, low), at(angle, outer, high), at(angle, inner, high)}, normal,
               {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
  }
}

}  // namespace

Model pawn(const Paint& paint) {
  Model model;
  model.paint(paint);
  Profile p = foot(0.17);
  p.curve({0.10, 0.14}, {0.065, 0.20}, {0.06, 0.315});
  collar(p, 0.06, 0.115, 0.325);
  p.line({0.062, 0.358}).arc({0.0, 0.50}, 0.76, 10);
  lathe(model, p, kSegments);
  return model;
}

Model rook(const Paint& paint) {
  Model model;
  model.paint(paint);
  Profile p = foot(0.19);
  p.curve({0.125, 0.16}, {0.10, 0.24}, {0.10, 0.38}).line({0.115, 0.385}).line({0.118, 0.40});
  p.curve({0.12, 0.42}, {0.15, 0.41}, {0.152, 0.44}, 5).line({0.152, 0.505});
  p.line({0.105, 0.505}).line({0.105, 0.47}).line({0.0, 0.47});
  lathe(model, p, kSegments);
  for (int k = 0; k < 6; ++k) {
    const double middle = 2.0 * kPi * k / 6.0;
    merlon(model, 0.105, 0.152, 0.505, 0.56, middle - 0.33, middle + 0.33);
  }
  return model;
}

Model bishop(const Paint& paint) {
  Model model;
  model.paint(paint);
  Profile p = foot(0.19);
  p.curve({0.11, 0.17}, {0.075, 0.26}, {0.066, 0.46});
  collar(p, 0.066, 0.13, 0.475);
  p.line({0.075, 0.512}).line({0.07, 0.53});
  p.curve({0.125, 0.575}, {0.125, 0.635}, {0.028, 0.715}, 10).arc({0.0, 0.78}, 1.3, 8);
  lathe(model, p, kSegments);
  return model;
}

Model queen(const Paint& paint) {
  Model model;
  model.paint(paint);
  Profile p = foot(0.205);
  p.curve({0.12, 0.18}, {0.078, 0.30}, {0.070, 0.57});
  collar(p, 0.070, 0.145, 0.585);
  p.line({0.085, 0.622});
  collar(p, 0.080, 0.115, 0.645);
  p.line({0.088, 0.68}).curve({0.092, 0.74}, {0.135, 0.78}, {0.148, 0.815}, 6).line({0.128, 0.818});
  p.curve({0.11, 0.79}, {0.09, 0.80}, {0.055, 0.845}, 5).line({0.03, 0.852}).arc({0.0, 0.90}, 1.15, 7);
  lathe(model, p, kSegments);
  const Model pearl = sphere(10, 6, paint);
  for (int k = 0; k < 9; ++k) {
    const double angle = 2.0 * kPi * k / 9.0;
    model.append(pearl, place({0.138 * std::sin(angle), 0.822, 0.138 * std::cos(angle)}, glm::dvec3(0.0), 0.046));
  }
  return model;
}

Model king(const Paint& paint) {
  Model model;
  model.paint(paint);
  Profile p = foot(0.215);
  p.curve({0.125, 0.19}, {0.082, 0.32}, {0.076, 0.60});
  collar(p, 0.076, 0.15, 0.615);
  p.line({0.092, 0.652});
  collar(p, 0.086, 0.122, 0.675);
  p.line({0.092, 0.71}).curve({0.10, 0.78}, {0.135, 0.80}, {0.138, 0.83}, 6).arc({0.132, 0.842}, 0.5, 2);
  p.curve({0.09, 0.87}, {0.045, 0.865}, {0.034, 0.885}, 6).line({0.0, 0.889});
  lathe(model, p, kSegments);
  // A cross of three bevelled bars: the arms end inside the upright.
  generator::box(model, {-0.017, 0.875, -0.017}, {0.017, 1.0, 0.017}, 0.005);
  for (const double side : {-1.0, 1.0}) {
    const double near = 0.012 * side, far = 0.052 * side;
    generator::box(model, {std::min(near, far), 0.931, -0.0165}, {std::max(near, far), 0.963, 0.0165}, 0.005);
  }
  return model;
}

}  // namespace speculum::generator
