#include <cmath>

#include "models.hpp"
#include "paints.hpp"
#include "profile.hpp"

namespace speculum::generator {
namespace {

// Sweeps happen in XY with heights along +Z; this lays such a path down so that heights point up.
Affine lyingDown(double y) {
  return place({0.0, y, 0.0}, {-90.0, 0.0, 0.0});
}

// A base or capital on a square plan: `half` is added to the profile's offsets.
void squareMoulding(Model& model, const Profile& profile, double width, double y, double uvScale = 1.0) {
  sweep(model, profile, rectanglePath(width, width), true, false, lyingDown(y), uvScale);
}

}  // namespace

Model column() {
  Model model;
  model.paint(paints::kWhiteMarble);
  generator::box(model, {-0.36, 0.0, -0.36}, {0.36, 0.12, 0.36}, 0.006, 1.0, BoxFaces::allButBottom);
  Profile base({0.352, 0.121});
  base.arc({0.34, 0.20}, 0.9, 5).line({0.30, 0.205}).line({0.30, 0.22}).arc({0.285, 0.28}, -0.7, 4);
  base.line({0.285, 0.295}).arc({0.275, 0.34}, 0.9, 4).line({0.262, 0.345}).line({0.262, 0.365});
  base.line({0.24, 0.375});
  lathe(model, base, 32);
  const int flutes = 16, cells = 4;
  model.surface(flutes * cells, 6, [&](double u, double v) {
    const double angle = 2.0 * kPi * u, phase = u * flutes - std::floor(u * flutes + 1e-9);
    const double hollow = std::sin(kPi * phase), slope = kPi * std::cos(kPi * phase) * flutes / (2.0 * kPi);
    const double radius = 0.245 - 0.045 * v * v, depth = 0.022;
    const glm::dvec3 radial(std::sin(angle), 0.0, std::cos(angle)), around(std::cos(angle), 0.0, -std::sin(angle));
    const double r = radius - depth * hollow;
    return Corner{radial * r + glm::dvec3(0.0, 0.37 + 2.6 * v, 0.0),
                  glm::normalize(radial + around * (depth * slope / r) + glm::dvec3(0.0, 0.03 * v, 0.0)),
                  {2.0 * u, 2.6 * v}};
  });
  Profile capital({0.205, 2.965});
  capital.arc({0.205, 3.0}, 0.9, 4).line({0.192, 3.005}).line({0.192, 3.075}).line({0.21, 3.08});
  capital.line({0.21, 3.10}).curve({0.26, 3.11}, {0.315, 3.15}, {0.325, 3.215}, 6).line({0.30, 3.235});
  lathe(model, capital, 32);
  generator::box(model, {-0.35, 3.23, -0.35}, {0.35, 3.40, 0.35}, 0.01);
  return model;
}

Model pedestal() {
  Model model;
  model.paint(paints::kGreenMarble);
  Profile foot({0.07, 0.0});
  foot.line({0.07, 0.10}).line({0.06, 0.105}).arc({0.025, 0.165}, 0.6, 4).line({0.02, 0.17}).line({0.0, 0.18});
  squareMoulding(model, foot, 0.46, 0.0);
  Profile die({0.0, 0.18});
  die.line({0.0, 0.84});
  squareMoulding(model, die, 0.46, 0.0);
  model.paint(paints::kGold);
  Profile bead({0.0, 0.84});
  bead.line({0.012, 0.842}).arc({0.012, 0.866}, 0.9, 4).line({0.004, 0.868});
  squareMoulding(model, bead, 0.46, 0.0);
  model.paint(paints::kGreenMarble);
  Profile head({0.004, 0.868});
  head.curve({0.03, 0.875}, {0.035, 0.905}, {0.062, 0.91}, 5).line({0.07, 0.915}).line({0.07, 0.99});
  head.line({0.06, 1.0});
  squareMoulding(model, head, 0.46, 0.0);
  const double h = 0.29;
  model.quad({{{-h, 1.0, h}, {h, 1.0, h}, {h, 1.0, -h}, {-h, 1.0, -h}}}, {0.0, 1.0, 0.0},
             {{{-h, -h}, {h, -h}, {h, h}, {-h, h}}});
  return model;
}

Model plinth() {
  Model model;
  model.paint(paints::kWhiteMarble);
  Profile p({0.55, 0.0});
  p.line({0.55, 0.09}).arc({0.52, 0.13}, 0.8, 4).line({0.49, 0.135}).arc({0.46, 0.25}, -0.35, 5).line({0.47, 0.26});
  p.arc({0.47, 0.32}, 0.9, 5).line({0.45, 0.325}).line({0.45, 0.35}).line({0.0, 0.35});
  lathe(model, p, 44);
  return model;
}

Model baluster() {
  Model model;
  model.paint(paints::kTrim);
  generator::box(model, {-0.09, 0.0, -0.09}, {0.09, 0.07, 0.09}, 0.004, 1.0, BoxFaces::allButBottom);
  Profile p({0.075, 0.069});
  p.line({0.075, 0.09})
      .curve({0.03, 0.11}, {0.10, 0.20}, {0.085, 0.27}, 5)
      .curve({0.07, 0.38}, {0.03, 0.5}, {0.04, 0.6}, 5);
  p.arc({0.04, 0.63}, 0.8, 3).line({0.045, 0.64}).line({0.075, 0.685});
  lathe(model, p, 16);
  generator::box(model, {-0.09, 0.68, -0.09}, {0.09, 0.75, 0.09}, 0.004);
  return model;
}

Model bench() {
  Model model;
  model.paint(paints::kWood);
  generator::box(model, {-0.8, 0.39, -0.22}, {0.8, 0.45, 0.22}, 0.008);
  for (const double side : {-1.0, 1.0}) {
    const double x = 0.62 * side;
    generator::box(model, {x - 0.03, 0.0, -0.17}, {x + 0.03, 0.395, 0.17}, 0.006, 1.0, BoxFaces::allButBottom);
  }
  generator::box(model, {-0.6, 0.2, -0.025}, {0.6, 0.25, 0.025}, 0.005);
  return model;
}

Model post() {
  Model model;
  model.paint(paints::kGold);
  Profile p({0.10, 0.0});
  p.line({0.10, 0.05}).arc({0.075, 0.09}, 0.6, 3).line({0.06, 0.1}).line({0.06, 2.38}).line({0.075, 2.4});
  p.arc({0.095, 2.45}, -0.4, 3).line({0.095, 2.52});
  lathe(model, p, 20);
  return model;
}

Model arcadeBay() {
  const double half = 1.5, open = 1.0, spring = 2.5, top = 4.6, deep = 0.5;
  Model model;
  model.paint(paints::kPlaster);
  const auto wall = [&](double x0, double y0, double x1, double y1, double x2, double y2, double x3, double y3) {
    model.quad({{{x0, y0, 0.0}, {x1, y1, 0.0}, {x2, y2, 0.0}, {x3, y3, 0.0}}}, {0.0, 0.0, 1.0},
               {{{x0 / 3.0, y0 / top}, {x1 / 3.0, y1 / top}, {x2 / 3.0, y2 / top}, {x3 / 3.0, y3 / top}}});
  };
  wall(-half, 0.0, -open, 0.0, -open, top, -half, top);
  wall(open, 0.0, half, 0.0, half, top, open, top);
  const int steps = 24;
  std::vector<glm::dvec2> contour{{open, 0.0}};
  for (int i = 0; i <= steps; ++i) {
    const double angle = kPi * i / steps;
    contour.push_back({open * std::cos(angle), spring + open * std::sin(angle)});
  }
  contour.push_back({-open, 0.0});
  for (int i = 1; i <= steps; ++i) {
    const glm::dvec2 a = contour[i + 1], b = contour[i];
    wall(a.x, a.y, b.x, b.y, b.x, top, a.x, top);
  }
  model.paint(paints::kTrim);
  Profile reveal({0.0, 0.0});
  reveal.line({0.0, -deep});
  sweep(model, reveal, contour, false, true, place({}));
  Profile archivolt({0.20, 0.0});
  archivolt.line({0.20, 0.035}).arc({0.16, 0.06}, 0.5, 3).line({0.15, 0.045}).line({0.06, 0.045});
  archivolt.line({0.055, 0.035}).line({0.0, 0.035}).line({0.0, 0.0});
  sweep(model, archivolt, contour, false, true, place({}));
  return model;
}

Model arch() {
  Model model;
  model.paint(paints::kWhiteMarble);
  for (const double side : {-1.0, 1.0}) {
    const double x = 0.95 * side;
    generator::box(model, {x - 0.2, 0.0, -0.2}, {x + 0.2, 0.14, 0.2}, 0.01, 1.0, BoxFaces::allButBottom);
    generator::box(model, {x - 0.15, 0.13, -0.15}, {x + 0.15, 1.5, 0.15}, 0.008, 1.0, BoxFaces::allButBottom);
    generator::box(model, {x - 0.19, 1.49, -0.19}, {x + 0.19, 1.6, 0.19}, 0.012);
  }
  Profile ring({0.30, -0.14});
  ring.line({0.30, 0.14}).line({0.24, 0.14}).line({0.23, 0.15}).line({0.05, 0.15}).line({0.0, 0.12});
  ring.line({0.0, -0.12}).line({0.05, -0.15}).line({0.23, -0.15}).line({0.24, -0.14}).line({0.30, -0.14});
  std::vector<glm::dvec2> path;
  const int steps = 32;
  for (int i = 0; i <= steps; ++i) {
    const double angle = kPi * i / steps;
    path.push_back({0.8 * std::cos(angle), 1.6 + 0.8 * std::sin(angle)});
  }
  sweep(model, ring, path, false, true, place({}));
  return model;
}

Model coffers() {
  Model model;
  const double cell = 1.0;
  struct Step {
    double half, rise;
  };
  const Step steps[] = {{0.38, 0.14}, {0.27, 0.12}};
  for (int cx = 0; cx < 2; ++cx) {
    for (int cz = 0; cz < 2; ++cz) {
      const glm::dvec3 centre((cx - 0.5) * cell, 0.0, (cz - 0.5) * cell);
      double outer = cell / 2.0, y = 0.0;
      const auto ring = [&](double half, double height, int k) {
        const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
        return centre + glm::dvec3(signs[k % 4][0] * half, height, signs[k % 4][1] * half);
      };
      for (const Step& step : steps) {
        for (int k = 0; k < 4; ++k) {
          model.paint(paints::kWalnut);
          model.quad({ring(outer, y, k), ring(outer, y, k + 1), ring(step.half, y, k + 1), ring(step.half, y, k)},
                     {0.0, -1.0, 0.0}, {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
          const glm::dvec3 middle = 0.5 * (ring(1.0, 0.0, k) + ring(1.0, 0.0, k + 1)) - centre;
          model.quad({ring(step.half, y, k), ring(step.half, y, k + 1), ring(step.half, y + step.rise, k + 1),
                      ring(step.half, y + step.rise, k)},
                     -glm::normalize(middle), {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
        }
        outer = step.half;
        y += step.rise;
      }
      model.paint(paints::kGlaze);
      model.quad({ring(outer, y, 0), ring(outer, y, 1), ring(outer, y, 2), ring(outer, y, 3)}, {0.0, -1.0, 0.0},
                 {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
      Model rosette;
      rosette.paint(paints::kGold);
      Profile p({0.0, 0.0});
      p.line({0.13, 0.0}).arc({0.09, 0.03}, 0.5, 2).line({0.075, 0.022}).arc({0.0, 0.06}, 0.3, 2);
      lathe(rosette, p, 12);
      model.append(rosette, place(centre + glm::dvec3(0.0, y - 0.002, 0.0), {180.0, 0.0, 0.0}));
    }
  }
  return model;
}

Model chequer(BoxFaces faces) {
  Model model;
  model.paint(paints::kWhiteMarble);
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 8; ++k) {
      if ((i + k) % 2 == 0) continue;
      const glm::dvec3 low(-2.0 + 0.5 * i, -0.01, -2.0 + 0.5 * k);
      generator::box(model, low, low + glm::dvec3(0.5, 0.0115, 0.5), 0.0015, 0.7, faces);
    }
  }
  return model;
}

Model tile() {
  Model model;
  model.paint(paints::kWhiteMarble);
  generator::box(model, {-0.5, 0.0, -0.5}, {0.5, 0.02, 0.5}, 0.006, 1.0, BoxFaces::allButBottom);
  return model;
}

Model lamp() {
  Model model;
  model.paint(paints::kBronze);
  Profile stem({0.0, -0.98});
  stem.line({0.02, -0.97}).line({0.02, -0.94}).line({0.007, -0.93}).line({0.007, -0.03}).arc({0.05, -0.001}, -0.3, 4);
  lathe(model, stem, 16);
  for (const double y : {-1.12, -0.96}) {
    Profile ring({0.075, y - 0.012});
    ring.line({0.15, y - 0.012}).arc({0.15, y + 0.012}, 0.9, 4).line({0.0, y + 0.02});
    lathe(model, ring, 28);
  }
  model.paint(paints::kLampGlass);
  Profile globe({0.0, -1.2});
  globe.arc({0.125, -1.1}, 0.4, 5).line({0.125, -0.98});
  lathe(model, globe, 28);
  return model;
}

Model box() {
  Model model;
  model.paint(paints::kWood);
  generator::box(model, {-0.5, 0.0, -0.5}, {0.5, 1.0, 0.5}, 0.015);
  return model;
}

Model block() {
  Model model;
  model.paint(paints::kWhiteMarble);
  generator::box(model, {-0.5, 0.0, -0.5}, {0.5, 1.0, 0.5}, 0.015);
  return model;
}

}  // namespace speculum::generator
