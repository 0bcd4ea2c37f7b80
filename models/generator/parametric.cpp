#include <cmath>

#include "models.hpp"
#include "profile.hpp"

namespace speculum::generator {
namespace {

using Map = std::function<glm::dvec3(double, double)>;

// Surface normal dP/du x dP/dv by central differences; `sign` turns it outwards.
glm::dvec3 normalOf(const Map& map, double u, double v, double sign) {
  const double step = 1e-5;
  return glm::normalize(sign * glm::cross(map(u + step, v) - map(u - step, v), map(u, v + step) - map(u, v - step)));
}

void addMap(Model& model, int nu, int nv, const Map& map, double sign, const glm::dvec2& uvScale) {
  model.surface(nu, nv, [&](double u, double v) {
    return Corner{map(u, v), normalOf(map, u, v, sign), glm::dvec2(u, v) * uvScale};
  });
}

}  // namespace

Model torusKnot(int along, int around, const Paint& paint) {
  const auto spine = [](double t) {
    const double a = 2.0 * kPi * t, r = 2.0 + std::cos(3.0 * a);
    return glm::dvec3(r * std::cos(2.0 * a), -std::sin(3.0 * a) * 1.25, r * std::sin(2.0 * a));
  };
  const double scale = 0.145;
  const Map map = [&](double u, double v) {
    const double h = 1e-4;
    const glm::dvec3 tangent = glm::normalize(spine(u + h) - spine(u - h));
    const glm::dvec3 outwards = glm::normalize(spine(u) * glm::dvec3(1.0, 0.0, 1.0));
    const glm::dvec3 side = glm::normalize(glm::cross(tangent, outwards)), up = glm::cross(side, tangent);
    const double angle = 2.0 * kPi * v;
    return scale * (spine(u) + 0.48 * (std::cos(angle) * up + std::sin(angle) * side)) + glm::dvec3(0.0, 0.251, 0.0);
  };
  Model model;
  model.paint(paint);
  addMap(model, along, around, map, -1.0, {12.0, 1.0});
  return model;
}

Model sphere(int around, int up, const Paint& paint) {
  Model model;
  model.paint(paint);
  model.surface(around, up, [](double u, double v) {
    const double longitude = 2.0 * kPi * u, latitude = kPi * (v - 0.5);
    const glm::dvec3 n(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                       std::cos(longitude) * std::cos(latitude));
    return Corner{0.5 * n, n, {2.0 * u, v}};
  });
  return model;
}

Model gem(const Paint& paint) {
  Model model;
  model.paint(paint);
  // Rings from the point up: number of corners, radius, height, turn in half steps of 1/16.
  struct Ring {
    double radius, height;
    bool turned;
  };
  const Ring rings[] = {{0.0, 0.0, false},  {0.26, 0.24, true}, {0.4, 0.42, false}, {0.4, 0.45, false},
                        {0.32, 0.55, true}, {0.22, 0.6, false}, {0.0, 0.6, false}};
  const int n = 8;
  const auto at = [&](int ring, int k) {
    const double angle = 2.0 * kPi * (k + (rings[ring].turned ? 0.5 : 0.0)) / n;
    return glm::dvec3(rings[ring].radius * std::sin(angle), rings[ring].height, rings[ring].radius * std::cos(angle));
  };
  const auto facet = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    glm::dvec3 normal = glm::cross(b - a, c - a);
    if (glm::length(normal) < 1e-9) return;
    const glm::dvec3 outwards = (a + b + c) / 3.0 - glm::dvec3(0.0, 0.4, 0.0);
    normal = glm::normalize(glm::dot(normal, outwards) < 0.0 ? -normal : normal);
    model.triangle({a, normal, {a.x, a.z}}, {b, normal, {b.x, b.z}}, {c, normal, {c.x, c.z}});
  };
  for (int ring = 0; ring + 1 < static_cast<int>(std::size(rings)); ++ring) {
    const int lowerShift = rings[ring].turned && !rings[ring + 1].turned ? 1 : 0;
    for (int k = 0; k < n; ++k) {
      const int above = k + lowerShift;
      facet(at(ring, k), at(ring, k + 1), at(ring + 1, above));
      facet(at(ring, k + 1), at(ring + 1, above + 1), at(ring + 1, above));
    }
  }
  return model;
}

Model ammonite(int along, int around, const Paint& paint) {
  const double turns = 3.4, growth = 0.155;
  const Map map = [=](double u, double v) {
    const double t = 2.0 * kPi * turns * (u - 1.0), w = 2.0 * kPi * v;
    const double radius = 0.33 * std::exp(growth * t), rib = 1.0 + 0.045 * std::sin(15.0 * t);
    const double r = radius * (1.0 + 0.5 * rib * std::cos(w));
    return glm::dvec3(r * std::cos(t + 0.9), 0.462 + r * std::sin(t + 0.9), 0.37 * radius * rib * std::sin(w));
  };
  Model model;
  model.paint(paint);
  addMap(model, along, around, map, 1.0, {14.0, 2.0});
  return model;
}

Model vase(const Paint& paint) {
  const double height = 0.9;
  const auto radius = [](double y) {
    return 0.13 + 0.15 * std::sin(kPi * (0.12 + 0.98 * y)) * std::exp(-0.55 * y) + 0.10 * std::pow(y, 7.0);
  };
  const Map outside = [=](double u, double v) {
    const double angle = 2.0 * kPi * u, flute = 1.0 + 0.055 * std::cos(12.0 * (angle + 1.3 * v));
    const double r = radius(v) * (1.0 + (flute - 1.0) * std::sin(kPi * std::min(1.0, 0.06 + v * 0.94)));
    return glm::dvec3(r * std::sin(angle), height * v, r * std::cos(angle));
  };
  const Map inside = [=](double u, double v) {
    const glm::dvec3 p = outside(u, 1.0 - 0.55 * v);
    const double r = std::hypot(p.x, p.z), inner = (r - 0.012) / r;
    return glm::dvec3(p.x * inner, p.y, p.z * inner);
  };
  Model model;
  model.paint(paint);
  addMap(model, 72, 16, outside, 1.0, {4.0, 2.0});
  addMap(model, 72, 5, inside, 1.0, {4.0, 1.0});
  model.surface(72, 1, [&](double u, double v) {
    const glm::dvec3 p = v > 0.5 ? inside(u, 0.0) : outside(u, 1.0);
    return Corner{p, {0.0, 1.0, 0.0}, {u, v}};
  });
  return model;
}

Model moebius(int along, int across, const Paint& paint) {
  // A superellipse of 0.26 x 0.045 carried round a circle with one and a half twists; two rounds close the surface.
  const Map map = [](double u, double v) {
    const double a = 2.0 * kPi * u, w = 2.0 * kPi * v, twist = 1.5 * a + 0.4;
    const auto power = [](double x) { return std::copysign(std::pow(std::abs(x), 0.6), x); };
    const double flat = 0.15 * power(std::cos(w)), thick = 0.035 * power(std::sin(w));
    const double out = flat * std::cos(twist) - thick * std::sin(twist);
    const double up = flat * std::sin(twist) + thick * std::cos(twist);
    const double r = 0.36 + out;
    return glm::dvec3(r * std::cos(a), r * std::sin(a) + 0.512, up);
  };
  Model model;
  model.paint(paint);
  const double offGrid = 0.25 / across;  // the superellipse has no derivative where cos or sin is 0
  const Map shifted = [&](double u, double v) { return map(u, v + offGrid); };
  addMap(model, along, across, shifted, 1.0, {8.0, 1.0});
  return model;
}

}  // namespace speculum::generator
