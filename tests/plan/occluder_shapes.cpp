#include "plan/occluder_shapes.hpp"

#include <array>
#include <cmath>
#include <sstream>

namespace speculum::testing_support {

namespace {

const double pi = std::acos(-1.0);

double uniform(std::mt19937& engine, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(engine);
}

int uniformInt(std::mt19937& engine, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(engine);
}

// A length between two others whose logarithm is uniform.
double anyScale(std::mt19937& engine, double low, double high) {
  return std::exp(uniform(engine, std::log(low), std::log(high)));
}

struct ShapeBuilder : OccluderShape {
  explicit ShapeBuilder(std::string of) { name = std::move(of); }

  // Between two polylines, pairwise.
  void strip(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b, bool closed) {
    for (size_t i = 0; i + (closed ? 0 : 1) < a.size(); ++i) {
      const size_t next = (i + 1) % a.size();
      quad(a[i], a[next], b[next], b[i]);
    }
  }
  void fan(const glm::dvec3& tip, const std::vector<glm::dvec3>& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      triangle(ring[i], ring[(i + 1) % ring.size()], tip);
    }
  }
};

// A closed outline around the origin, radius about 1.
std::vector<glm::dvec3> outline(std::mt19937& engine, double z) {
  const int kind = uniformInt(engine, 0, 3);
  const int points = uniformInt(engine, 3, 7);
  const int count = kind == 0 ? 2 * points : uniformInt(engine, 8, 300);
  const double depth = uniform(engine, 0.1, 0.9);
  const double width = uniform(engine, 0.1, 1.5);
  std::vector<glm::dvec3> ring;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * pi * i / count;
    double r = 1.0;
    if (kind == 0) {
      r = i % 2 == 0 ? 1.0 : 1.0 - depth;  // a star
    } else if (kind == 1 && std::abs(angle - pi) < width) {
      r = 1.0 - depth * 0.5 * (1.0 + std::cos(pi * (angle - pi) / width));  // a smooth notch
    } else if (kind == 2) {
      r = 1.0 - 0.5 * depth * (0.5 + 0.5 * std::cos(points * angle));  // waves
    }
    ring.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return ring;
}

// One opening, cut coarsely or finely.
OccluderShape wallWithArch(std::mt19937& engine) {
  ShapeBuilder wall("arch");
  const int cuts = uniformInt(engine, 2, 900);
  const double halfWidth = anyScale(engine, 0.02, 0.9);
  const double height = anyScale(engine, 0.001, 1.9);
  const double thickness = uniformInt(engine, 0, 1) == 0 ? 0.0 : anyScale(engine, 1e-4, 0.3);
  for (const double z : {0.0, thickness}) {
    std::vector<glm::dvec3> arch;
    std::vector<glm::dvec3> top;
    for (int i = 0; i <= cuts; ++i) {
      const double angle = pi * (1.0 - static_cast<double>(i) / cuts);
      arch.emplace_back(halfWidth * std::cos(angle), -1.0 + height * std::sin(angle), z);
      top.emplace_back(arch.back().x, 1.0, z);
    }
    const double shoulder = halfWidth;
    wall.strip(arch, top, false);
    wall.quad({-1, -1, z}, {-shoulder, -1, z}, {-shoulder, 1, z}, {-1, 1, z});
    wall.quad({shoulder, -1, z}, {1, -1, z}, {1, 1, z}, {shoulder, 1, z});
    if (thickness == 0.0) {
      break;
    }
  }
  return wall;
}

OccluderShape stairs(std::mt19937& engine) {
  ShapeBuilder stairs("stairs");
  const int steps = uniformInt(engine, 1, 200);
  const double z = anyScale(engine, 1e-4, 1.0);
  for (int i = 0; i < steps; ++i) {
    const double x0 = -1.0 + 2.0 * i / steps;
    const double x1 = -1.0 + 2.0 * (i + 1) / steps;
    for (const double side : {-z, z}) {
      stairs.quad({x0, -1, side}, {x1, -1, side}, {x1, x1, side}, {x0, x1, side});
    }
    stairs.quad({x0, x1, -z}, {x1, x1, -z}, {x1, x1, z}, {x0, x1, z});
    stairs.quad({x0, x0, -z}, {x0, x1, -z}, {x0, x1, z}, {x0, x0, z});
  }
  stairs.quad({-1, -1, -z}, {1, -1, -z}, {1, -1, z}, {-1, -1, z});
  stairs.quad({1, -1, -z}, {1, 1, -z}, {1, 1, z}, {1, -1, z});
  return stairs;
}

OccluderShape bentSheet(std::mt19937& engine) {
  ShapeBuilder sheet("sheet");
  const int strips = uniformInt(engine, 2, 300);
  const double angle = anyScale(engine, 1e-7, 2.0 * pi);  // by which the whole sheet is bent
  const double twist = uniformInt(engine, 0, 2) == 0 ? anyScale(engine, 1e-7, 2.0) : 0.0;
  std::array<std::vector<glm::dvec3>, 2> sides;
  for (int i = 0; i <= strips; ++i) {
    const double t = 2.0 * i / strips - 1.0;
    const double turn = 0.5 * angle * t;
    const glm::dvec3 p(2.0 * std::sin(turn) / angle, 0.0, 2.0 * (std::cos(turn) - 1.0) / angle);
    const glm::dvec3 up(0.0, std::cos(twist * t), std::sin(twist * t));
    sides[0].push_back(p - up);
    sides[1].push_back(p + up);
  }
  sheet.strip(sides[0], sides[1], false);
  return sheet;
}

// A double pyramid over a star, a notched disc or an ellipse.
OccluderShape star(std::mt19937& engine) {
  ShapeBuilder star("star");
  const std::vector<glm::dvec3> ring = outline(engine, 0.0);
  const double thickness = anyScale(engine, 1e-6, 1.0);
  star.fan({0, 0, thickness}, ring);
  star.fan({0, 0, -thickness * uniform(engine, 0.01, 1.0)}, ring);
  return star;
}

// Two rings of different size, thick or thin.
OccluderShape tapered(std::mt19937& engine) {
  ShapeBuilder tapered("tapered");
  const double length = anyScale(engine, 1e-5, 2.0);
  const std::vector<glm::dvec3> wide = outline(engine, 0.0);
  std::vector<glm::dvec3> narrow = wide;
  const double ratio = 1.0 - anyScale(engine, 1e-6, 1.0);
  for (glm::dvec3& p : narrow) {
    p = {ratio * p.x, ratio * p.y, length};
  }
  tapered.strip(wide, narrow, true);
  tapered.fan({0, 0, 0}, wide);
  tapered.fan({0, 0, length}, narrow);
  return tapered;
}

// Two sheets with a gap between.
OccluderShape boards(std::mt19937& engine) {
  ShapeBuilder boards("boards");
  for (const double z : {0.0, anyScale(engine, 1e-4, 1.0)}) {
    boards.quad({-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z});
    boards.quad({-1, 1, z}, {-1, -1, z}, {1, -1, z}, {1, 1, z});
  }
  return boards;
}

// With coordinates of few decimals.
OccluderShape ball(std::mt19937& engine) {
  ShapeBuilder ball("ball");
  const int sides = uniformInt(engine, 4, 40);
  const int rings = sides / 2;
  const double step = std::pow(10.0, -uniformInt(engine, 3, 6));
  const auto at = [&](int ring, int side) {
    const double polar = pi * ring / rings;
    const double angle = 2.0 * pi * (side % sides) / sides;
    const double r = ring == 0 || ring == rings ? 0.0 : std::sin(polar);
    const glm::dvec3 p(r * std::cos(angle), std::cos(polar), r * std::sin(angle));
    return glm::round(p / step) * step;
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int side = 0; side < sides; ++side) {
      if (ring > 0) {
        ball.triangle(at(ring, side), at(ring, side + 1), at(ring + 1, side));
      }
      if (ring + 1 < rings) {
        ball.triangle(at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side));
      }
    }
  }
  return ball;
}

}  // namespace

std::string OccluderShape::obj() const {
  std::ostringstream text;
  text.precision(17);
  for (const glm::dvec3& p : positions) {
    text << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  }
  for (size_t i = 0; i < indices.size(); i += 3) {
    text << "f " << indices[i] + 1 << ' ' << indices[i + 1] + 1 << ' ' << indices[i + 2] + 1 << '\n';
  }
  return text.str();
}

OccluderShape randomShape(std::mt19937& engine) {
  constexpr std::array kinds{wallWithArch, stairs, bentSheet, star, tapered, boards, ball};
  return kinds[static_cast<size_t>(uniformInt(engine, 0, kinds.size() - 1))](engine);
}

}  // namespace speculum::testing_support
