#include "profile.hpp"

#include <cmath>

namespace speculum::generator {
namespace {

const double kCreaseCosine = std::cos(35.0 * kPi / 180.0);

glm::dvec2 rightOf(const glm::dvec2& direction) {
  return glm::normalize(glm::dvec2(direction.y, -direction.x));
}

// Offset directions of a path's vertices: unit for smooth, lengthened so that offset edges stay parallel.
std::vector<glm::dvec2> mitres(const std::vector<glm::dvec2>& path, bool closed) {
  const int n = static_cast<int>(path.size());
  std::vector<glm::dvec2> result(n);
  for (int i = 0; i < n; ++i) {
    const bool hasBefore = closed || i > 0, hasAfter = closed || i + 1 < n;
    const glm::dvec2 before = hasBefore ? rightOf(path[i] - path[(i + n - 1) % n]) : rightOf(path[i + 1] - path[i]);
    const glm::dvec2 after = hasAfter ? rightOf(path[(i + 1) % n] - path[i]) : before;
    const glm::dvec2 half = glm::normalize(before + after);
    result[i] = half / glm::dot(half, after);
  }
  return result;
}

}  // namespace

Profile& Profile::line(glm::dvec2 to) {
  points_.push_back(to);
  return *this;
}

Profile& Profile::arc(glm::dvec2 to, double bulge, int steps) {
  const glm::dvec2 from = points_.back(), chord = to - from;
  const double half = 2.0 * std::atan(bulge);  // half the arc's angle
  const glm::dvec2 centre = 0.5 * (from + to) - rightOf(chord) * (0.5 * glm::length(chord) / std::tan(half));
  for (int i = 1; i <= steps; ++i) {
    const double angle = 2.0 * half * i / steps;
    const glm::dvec2 arm = from - centre;
    points_.push_back(i == steps ? to
                                 : centre + glm::dvec2(arm.x * std::cos(angle) - arm.y * std::sin(angle),
                                                       arm.x * std::sin(angle) + arm.y * std::cos(angle)));
  }
  return *this;
}

Profile& Profile::curve(glm::dvec2 control1, glm::dvec2 control2, glm::dvec2 to, int steps) {
  const glm::dvec2 from = points_.back();
  for (int i = 1; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps, s = 1.0 - t;
    points_.push_back(s * s * s * from + 3.0 * s * s * t * control1 + 3.0 * s * t * t * control2 + t * t * t * to);
  }
  return *this;
}

std::vector<Profile::Segment> Profile::segments() const {
  std::vector<Segment> result;
  double length = 0.0;
  for (size_t i = 0; i + 1 < points_.size(); ++i) {
    const glm::dvec2 normal = rightOf(points_[i + 1] - points_[i]);
    const double end = length + glm::distance(points_[i], points_[i + 1]);
    result.push_back({points_[i], points_[i + 1], normal, normal, length, end});
    length = end;
  }
  for (size_t i = 0; i + 1 < result.size(); ++i) {
    const glm::dvec2 a = rightOf(result[i].to - result[i].from), b = rightOf(result[i + 1].to - result[i + 1].from);
    if (glm::dot(a, b) < kCreaseCosine) continue;
    result[i].toNormal = result[i + 1].fromNormal = glm::normalize(a + b);
  }
  return result;
}

void lathe(Model& model, const Profile& profile, int segments, double uvScale) {
  for (const Profile::Segment& s : profile.segments()) {
    model.surface(segments, 1, [&](double u, double v) {
      const double angle = 2.0 * kPi * u;
      const glm::dvec3 radial(std::sin(angle), 0.0, std::cos(angle));
      const glm::dvec2 p = v > 0.5 ? s.to : s.from, n = v > 0.5 ? s.toNormal : s.fromNormal;
      return Corner{radial * p.x + glm::dvec3(0.0, p.y, 0.0),
                    radial * n.x + glm::dvec3(0.0, n.y, 0.0),
                    {u * uvScale, (v > 0.5 ? s.toLength : s.fromLength) * uvScale}};
    });
  }
}

void sweep(Model& model, const Profile& profile, const std::vector<glm::dvec2>& path, bool closed, bool smooth,
           const Affine& place, double uvScale) {
  const std::vector<glm::dvec2> offset = mitres(path, closed);
  const size_t n = path.size();
  double length = 0.0;
  for (size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const size_t k = (i + 1) % n;
    const double end = length + glm::distance(path[i], path[k]);
    const glm::dvec2 flat = rightOf(path[k] - path[i]);
    const glm::dvec2 normals[2] = {smooth ? glm::normalize(offset[i]) : flat,
                                   smooth ? glm::normalize(offset[k]) : flat};
    for (const Profile::Segment& s : profile.segments()) {
      model.surface(1, 1, [&](double u, double v) {
        const size_t j = u > 0.5 ? k : i;
        const glm::dvec2 p = v > 0.5 ? s.to : s.from, m = v > 0.5 ? s.toNormal : s.fromNormal;
        const glm::dvec2 xy = path[j] + offset[j] * p.x;
        const glm::dvec3 normal(normals[u > 0.5 ? 1 : 0] * m.x, m.y);
        return Corner{place.point({xy, p.y}), glm::normalize(place.linear * normal),
                      glm::dvec2(u > 0.5 ? end : length, v > 0.5 ? s.toLength : s.fromLength) * uvScale};
      });
    }
    length = end;
  }
}

void box(Model& model, const glm::dvec3& low, const glm::dvec3& high, double bevel, double uvScale, BoxFaces faces) {
  const glm::dvec3 centre = 0.5 * (low + high), half = 0.5 * (high - low);
  const auto at = [&](const glm::dvec3& sign, int flush, const glm::dvec3& normal) {
    glm::dvec3 p = sign * (half - bevel);
    if (flush >= 0) p[flush] = sign[flush] * half[flush];
    p += centre;
    const glm::dvec2 uv = flush == 1   ? glm::dvec2(p.x, -p.z)
                          : flush == 0 ? glm::dvec2(-p.z, p.y)
                                       : glm::dvec2(p.x, p.y);
    return Corner{p, normal, uv * uvScale};
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    for (double side : {-1.0, 1.0}) {
      glm::dvec3 sign(0.0), normal(0.0);
      sign[axis] = normal[axis] = side;
      const auto face = [&](double sb, double sc) {
        sign[b] = sb, sign[c] = sc;
        return at(sign, axis, normal);
      };
      const bool isTop = axis == 1 && side > 0.0, isBottom = axis == 1 && side < 0.0;
      if (isTop || faces == BoxFaces::all || (faces == BoxFaces::allButBottom && !isBottom))
        model.quad(face(-1, -1), face(1, -1), face(1, 1), face(-1, 1));
      if (bevel <= 0.0) continue;
      for (double other : {-1.0, 1.0}) {  // the bevel between this face and the next axis' face
        if (faces == BoxFaces::top && !isTop && (b != 1 || other < 0.0)) continue;
        glm::dvec3 tilt(0.0);
        tilt[axis] = side, tilt[b] = other;
        tilt = glm::normalize(tilt);
        const auto corner = [&](int flush, double sc) {
          glm::dvec3 s(0.0);
          s[axis] = side, s[b] = other, s[c] = sc;
          return at(s, flush, tilt);
        };
        model.quad(corner(axis, -1), corner(axis, 1), corner(b, 1), corner(b, -1));
      }
    }
  }
  if (bevel <= 0.0) return;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 sign(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    if (faces == BoxFaces::top && sign.y < 0.0) continue;
    const glm::dvec3 normal = glm::normalize(sign);
    model.triangle(at(sign, 0, normal), at(sign, 1, normal), at(sign, 2, normal));
  }
}

std::vector<glm::dvec2> rectanglePath(double width, double height) {
  const double w = width / 2.0, h = height / 2.0;
  return {{-w, -h}, {w, -h}, {w, h}, {-w, h}};
}

std::vector<glm::dvec2> ellipsePath(double width, double height, int segments) {
  std::vector<glm::dvec2> path;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2.0 * kPi * i / segments;
    path.push_back({0.5 * width * std::cos(angle), 0.5 * height * std::sin(angle)});
  }
  return path;
}

std::vector<glm::dvec2> archPath(double width, double height, int segments) {
  const double radius = width / 2.0, spring = height / 2.0 - radius;
  std::vector<glm::dvec2> path{{-radius, -height / 2.0}, {radius, -height / 2.0}};
  for (int i = 0; i <= segments; ++i) {
    const double angle = kPi * i / segments;
    path.push_back({radius * std::cos(angle), spring + radius * std::sin(angle)});
  }
  return path;
}

}  // namespace speculum::generator
