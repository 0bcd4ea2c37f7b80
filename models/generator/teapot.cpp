#include <array>

#include "models.hpp"

namespace speculum::generator {
namespace {

using Curve = std::array<glm::dvec3, 4>;
using Patch = std::array<Curve, 4>;  // [v][u]

// Newell's surfaces of revolution, (radius, height); Z is up in his data. Each makes four patches.
constexpr double kTurned[6][4][2] = {
    {{1.4, 2.4}, {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4}},  // rim
    {{1.5, 2.4}, {1.75, 1.875}, {2.0, 1.35}, {2.0, 0.9}},            // body, above
    {{2.0, 0.9}, {2.0, 0.45}, {1.5, 0.225}, {1.5, 0.15}},            // body, below
    {{0.0, 3.15}, {0.8, 3.15}, {0.0, 2.85}, {0.2, 2.7}},             // knob
    {{0.2, 2.7}, {0.4, 2.55}, {1.3, 2.55}, {1.3, 2.4}},              // lid
    {{1.5, 0.15}, {1.5, 0.075}, {1.425, 0.0}, {0.0, 0.0}},           // bottom
};

// Handle and spout: four curves in the plane y = 0 or at the given half width, each mirrored in y. (x, z) of the inner
// and the outer curve, and the half widths of the control points between them.
struct Tube {
  double inner[4][2], outer[4][2], width[4];
};
constexpr Tube kTubes[4] = {
    {{{-1.6, 2.025}, {-2.3, 2.025}, {-2.7, 2.025}, {-2.7, 1.8}},
     {{-1.5, 2.25}, {-2.5, 2.25}, {-3.0, 2.25}, {-3.0, 1.8}},
     {0.3, 0.3, 0.3, 0.3}},
    {{{-2.7, 1.8}, {-2.7, 1.575}, {-2.5, 1.125}, {-2.0, 0.9}},
     {{-3.0, 1.8}, {-3.0, 1.35}, {-2.65, 0.9375}, {-1.9, 0.6}},
     {0.3, 0.3, 0.3, 0.3}},
    {{{1.7, 1.425}, {2.6, 1.425}, {2.3, 2.1}, {2.7, 2.4}},
     {{1.7, 0.6}, {3.1, 0.825}, {2.4, 2.025}, {3.3, 2.4}},
     {0.66, 0.66, 0.25, 0.25}},
    {{{2.7, 2.4}, {2.8, 2.475}, {2.9, 2.475}, {2.8, 2.4}},
     {{3.3, 2.4}, {3.525, 2.49375}, {3.45, 2.5125}, {3.2, 2.4}},
     {0.25, 0.25, 0.15, 0.15}},
};

double bernstein(int k, double t) {
  const double s = 1.0 - t;
  return k == 0 ? s * s * s : k == 1 ? 3.0 * s * s * t : k == 2 ? 3.0 * s * t * t : t * t * t;
}

glm::dvec3 evaluate(const Patch& patch, double u, double v) {
  glm::dvec3 sum(0.0);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) sum += bernstein(i, u) * bernstein(j, v) * patch[j][i];
  return sum;
}

// At the poles one edge of a patch is a point; the normal there is the limit from inside the patch.
glm::dvec3 normalAt(const Patch& patch, double u, double v) {
  const double h = 1e-4;
  v = std::min(std::max(v, h), 1.0 - h);
  const glm::dvec3 du = evaluate(patch, u + h, v) - evaluate(patch, u - h, v);
  const glm::dvec3 dv = evaluate(patch, u, v + h) - evaluate(patch, u, v - h);
  return glm::normalize(glm::cross(du, dv));
}

void addPatch(Model& model, const Patch& patch, int steps, double sign) {
  const auto yUp = [](const glm::dvec3& p) { return glm::dvec3(p.x, p.z, -p.y); };
  model.surface(steps, steps, [&](double u, double v) {
    return Corner{yUp(evaluate(patch, u, v)) * 0.2, yUp(sign * normalAt(patch, u, v)), {u, v}};
  });
}

}  // namespace

Model teapot(int steps, const Paint& paint) {
  Model model;
  model.paint(paint);
  constexpr double kQuarter = 0.56;  // Newell's control points of a quarter circle
  for (const auto& profile : kTurned) {
    for (int turn = 0; turn < 4; ++turn) {
      Patch patch;
      for (int j = 0; j < 4; ++j) {
        const double r = profile[j][0];
        const glm::dvec2 arc[4] = {{r, 0.0}, {r, r * kQuarter}, {r * kQuarter, r}, {0.0, r}};
        for (int i = 0; i < 4; ++i) {
          glm::dvec2 p = arc[i];
          for (int k = 0; k < turn; ++k) p = {-p.y, p.x};
          patch[j][i] = {p, profile[j][1]};
        }
      }
      addPatch(model, patch, steps, -1.0);
    }
  }
  for (const Tube& tube : kTubes) {
    for (double side : {-1.0, 1.0}) {
      Patch patch;
      for (int j = 0; j < 4; ++j) {
        const glm::dvec2 inner(tube.inner[j][0], tube.inner[j][1]), outer(tube.outer[j][0], tube.outer[j][1]);
        const double y = side * tube.width[j];
        patch[j] = {
            glm::dvec3{inner.x, 0.0, inner.y}, {inner.x, y, inner.y}, {outer.x, y, outer.y}, {outer.x, 0.0, outer.y}};
      }
      addPatch(model, patch, steps, -side);
    }
  }
  return model;
}

}  // namespace speculum::generator
