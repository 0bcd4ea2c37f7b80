#pragma once

#include <optional>
#include <string>
#include <vector>

#include "accuracy/plot_axis.hpp"
#include "accuracy/statistics.hpp"

namespace speculum {

enum class MarkShape { disc, ring, square, diamond, triangle };

// `style` of all that follows is a class of the report's style sheet, which gives the colours.
struct PlotMark {
  Sample2d at;
  MarkShape shape = MarkShape::disc;
  std::string style;
  std::string label;             // beside the mark, where there is room; may be empty
  std::string tooltip;           // lines
  int point = -1;                // for scripts: the point that is shown; -1: none
  std::optional<Spread> spread;  // of x: the quartiles as a bar, the minimum as a thin tick
};

struct PlotLine {
  std::string style;
  std::vector<Sample2d> points;  // cut at the frame
};

struct PlotRule {
  double y = 0.0;
  std::string style;
  std::string label;
};

struct LegendEntry {
  std::string label;
  std::string style;
  std::optional<MarkShape> shape;  // nothing: a line
};

struct Plot {
  std::string description;  // for who cannot see it
  int width = 480;          // SVG units; text is 12 high
  int height = 380;
  PlotAxis x;
  PlotAxis y;
  std::vector<PlotMark> marks;  // later ones cover earlier ones; their labels come first
  std::vector<PlotLine> lines;
  std::vector<PlotRule> rules;  // a rule that is not positive on a logarithmic axis is left out
  std::vector<LegendEntry> legend;
};

// An <svg> element. Everything in it lies within its viewBox whatever the values are.
std::string plotSvg(const Plot& plot);

}  // namespace speculum
