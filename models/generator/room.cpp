#include "models.hpp"
#include "paints.hpp"
#include "profile.hpp"

namespace speculum::generator {
namespace {

constexpr double kHeight = 4.6;

// A wall of `width` in z = 0 facing +Z, centred at x = 0, with skirting, cornice and `panels` moulded panels.
Model panelledWall(double width, int panels) {
  Model wall;
  wall.paint(paints::kPlaster);
  const double h = width / 2.0;
  wall.quad({{{-h, 0.0, 0.0}, {h, 0.0, 0.0}, {h, kHeight, 0.0}, {-h, kHeight, 0.0}}}, {0.0, 0.0, 1.0},
            {{{0.0, 0.0}, {width / 3.0, 0.0}, {width / 3.0, 1.0}, {0.0, 1.0}}});
  wall.paint(paints::kTrim);
  const double bay = width / panels;
  Profile bead({0.06, 0.0});
  bead.line({0.055, 0.015}).arc({0.0, 0.03}, 0.5, 4).line({0.0, 0.0});
  for (int k = 0; k < panels; ++k) {
    const double x = -h + bay * (k + 0.5);
    sweep(wall, bead, rectanglePath(bay - 0.5, 0.56), true, false, place({x, 0.62, 0.0}));
    sweep(wall, bead, rectanglePath(bay - 0.5, 2.5), true, false, place({x, 2.5, 0.0}));
  }
  return wall;
}

// Skirting and chair rail along the open path of the walls, the cornice all round; the room is to the right.
void runMouldings(Model& model, const std::vector<glm::dvec2>& path) {
  const Affine lying = place({0.0, 0.0, 0.0}, {-90.0, 0.0, 0.0});
  model.paint(paints::kTrim);
  Profile skirting({0.03, 0.0});
  skirting.line({0.03, 0.16}).arc({0.015, 0.2}, 0.5, 3).line({0.0, 0.205});
  sweep(model, skirting, path, false, false, lying);
  Profile rail({0.0, 1.0});
  rail.line({0.02, 1.01}).arc({0.05, 1.05}, -0.4, 3).line({0.05, 1.075}).line({0.0, 1.08});
  sweep(model, rail, path, false, false, lying);
  Profile cornice({0.0, 4.12});
  cornice.line({0.03, 4.13}).line({0.03, 4.2}).curve({0.03, 4.28}, {0.14, 4.26}, {0.14, 4.36}, 5).line({0.18, 4.37});
  cornice.line({0.18, 4.42}).arc({0.30, 4.54}, -0.4, 5).line({0.34, 4.55}).line({0.34, kHeight});
  sweep(model, cornice, path, true, false, lying);
  model.paint(paints::kGold);
  Profile bead({0.03, 4.155});
  bead.arc({0.03, 4.185}, 0.9, 4);
  sweep(model, bead, path, true, false, lying);
}

}  // namespace

Model room() {
  Model model;
  const double x = 5.0, z = 7.5;
  model.append(panelledWall(2.0 * x, 4), place({0.0, 0.0, -z}));
  model.append(panelledWall(2.0 * x, 4), place({0.0, 0.0, z}, {0.0, 180.0, 0.0}));
  model.append(panelledWall(2.0 * z, 5), place({x, 0.0, 0.0}, {0.0, -90.0, 0.0}));
  // In the lying plane (x, y) is (x, -z) of the world. The open side is -X.
  runMouldings(model, {{-x, z}, {x, z}, {x, -z}, {-x, -z}});
  return model;
}

Model frame(Opening opening, double width, double height, double border, const Paint& paint) {
  Model model;
  model.paint(paint);
  const double b = border;
  Profile p({b, -0.05});
  p.line({b, 0.03}).arc({0.86 * b, 0.055}, 0.5, 3).line({0.80 * b, 0.05});
  p.curve({0.66 * b, 0.05}, {0.60 * b, 0.085}, {0.46 * b, 0.09}, 5).line({0.42 * b, 0.08});
  p.arc({0.26 * b, 0.075}, 0.45, 4).line({0.22 * b, 0.06}).curve({0.14 * b, 0.06}, {0.12 * b, 0.045}, {0.0, 0.04}, 4);
  p.line({0.0, 0.035}).line({0.03, 0.033}).line({0.03, -0.05}).line({b, -0.05});
  const std::vector<glm::dvec2> path = opening == Opening::rectangle ? rectanglePath(width, height)
                                       : opening == Opening::arch    ? archPath(width, height, 24)
                                                                     : ellipsePath(width, height, 40);
  sweep(model, p, path, true, opening == Opening::ellipse, place({}), 2.0);
  return model;
}

}  // namespace speculum::generator
