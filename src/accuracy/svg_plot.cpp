#include "accuracy/svg_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "accuracy/html_text.hpp"

namespace speculum {

namespace {

constexpr double characterWidth = 6.3;
constexpr double lineHeight = 14.0;
constexpr double legendRow = 20.0;
constexpr double swatchWidth = 24.0;
constexpr double labelHeight = 13.0;
constexpr double markRadius = 4.5;

struct Box {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;

  bool overlaps(const Box& o) const { return left < o.right && o.left < right && top < o.bottom && o.top < bottom; }
  bool within(const Box& o) const { return left >= o.left && right <= o.right && top >= o.top && bottom <= o.bottom; }
};

struct Place {
  double x = 0.0;
  double y = 0.0;
};

double textWidth(const std::string& text) {
  return characterWidth * characterCount(text);
}

std::string coordinate(double value) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.1f", value);
  const std::string number(text);
  return number.ends_with(".0") ? number.substr(0, number.size() - 2) : number;
}

std::string attribute(const char* name, double value) {
  return std::string(" ") + name + "=\"" + coordinate(value) + "\"";
}

std::string lineElement(const std::string& style, Place from, Place to) {
  return "<line class=\"" + style + "\"" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
         attribute("y2", to.y) + "/>";
}

std::string textElement(const std::string& style, Place at, const std::string& text) {
  return "<text class=\"" + style + "\"" + attribute("x", at.x) + attribute("y", at.y) + ">" + escapeHtml(text) +
         "</text>";
}

std::string polygonElement(const std::vector<Place>& corners) {
  std::string points;
  for (const Place& corner : corners) {
    points += (points.empty() ? "" : " ") + coordinate(corner.x) + "," + coordinate(corner.y);
  }
  return "<polygon class=\"shape\" points=\"" + points + "\"/>";
}

std::string shapeElement(MarkShape shape, Place at) {
  const double r = markRadius;
  switch (shape) {
    case MarkShape::square:
      return polygonElement({{at.x - r, at.y - r}, {at.x + r, at.y - r}, {at.x + r, at.y + r}, {at.x - r, at.y + r}});
    case MarkShape::diamond:
      return polygonElement({{at.x, at.y - 6.5}, {at.x + 6.5, at.y}, {at.x, at.y + 6.5}, {at.x - 6.5, at.y}});
    case MarkShape::triangle:
      return polygonElement({{at.x - 5.5, at.y - r}, {at.x + 5.5, at.y - r}, {at.x, at.y + 5.5}});
    case MarkShape::disc:
    case MarkShape::ring:
      break;
  }
  const bool ring = shape == MarkShape::ring;
  return std::string("<circle class=\"shape") + (ring ? " hollow\"" : "\"") + attribute("cx", at.x) +
         attribute("cy", at.y) + attribute("r", ring ? 3.5 : r) + "/>";
}

Box boundsOf(Place a, Place b) {
  return {std::min(a.x, b.x) - 1.0, std::min(a.y, b.y) - 1.0, std::max(a.x, b.x) + 1.0, std::max(a.y, b.y) + 1.0};
}

// Liang and Barsky's clipping of a segment, along y only: x never leaves the frame.
std::optional<std::pair<Place, Place>> cutAtFrame(Place a, Place b, double top, double bottom) {
  double first = 0.0;
  double last = 1.0;
  const double dy = b.y - a.y;
  if (dy == 0.0) {
    return a.y >= top && a.y <= bottom ? std::optional(std::pair{a, b}) : std::nullopt;
  }
  first = std::max(first, std::min((top - a.y) / dy, (bottom - a.y) / dy));
  last = std::min(last, std::max((top - a.y) / dy, (bottom - a.y) / dy));
  if (first > last) {
    return std::nullopt;
  }
  const auto at = [&](double t) { return Place{a.x + t * (b.x - a.x), std::clamp(a.y + t * dy, top, bottom)}; };
  return std::pair{at(first), at(last)};
}

class PlotWriter {
 public:
  explicit PlotWriter(const Plot& plot)
      : plot_(plot),
        legendHeight_(legendPlaces().second),
        frame_{62.0, legendHeight_ + 10.0, plot.width - 14.0, plot.height - 46.0},
        x_(plot.x, valuesOfX(), frame_.left, frame_.right),
        y_(plot.y, valuesOfY(), frame_.bottom, frame_.top) {}

  std::string write() {
    svg_ = "<svg class=\"plot\" role=\"img\" viewBox=\"0 0 " + std::to_string(plot_.width) + " " +
           std::to_string(plot_.height) + "\" aria-label=\"" + escapeHtml(plot_.description) + "\">\n";
    writeLegend();
    writeAxes();
    writeRules();
    writeLines();
    writeSpreads();
    writeLabels();
    for (const PlotMark& mark : plot_.marks) {
      writeMark(mark);
    }
    return svg_ + "</svg>\n";
  }

 private:
  std::vector<double> valuesOfX() const {
    std::vector<double> values;
    for (const PlotMark& mark : plot_.marks) {
      values.push_back(mark.at.x);
      if (mark.spread) {
        values.insert(values.end(), {mark.spread->minimum, mark.spread->lowerQuartile, mark.spread->upperQuartile});
      }
    }
    return values;
  }

  std::vector<double> valuesOfY() const {
    std::vector<double> values;
    for (const PlotMark& mark : plot_.marks) {
      values.push_back(mark.at.y);
    }
    for (const PlotRule& rule : plot_.rules) {
      if (drawn(rule)) {
        values.push_back(rule.y);
      }
    }
    return values;
  }

  bool drawn(const PlotRule& rule) const {
    return std::isfinite(rule.y) && (plot_.y.scale == AxisScale::linear || rule.y > 0.0);
  }

  std::optional<Place> placeOf(Sample2d sample) const {
    const std::optional<double> x = x_.at(sample.x);
    const std::optional<double> y = y_.at(sample.y);
    return x && y ? std::optional(Place{*x, *y}) : std::nullopt;
  }

  std::pair<std::vector<Place>, double> legendPlaces() const {
    std::vector<Place> places;
    Place next{14.0, 12.0};
    for (const LegendEntry& entry : plot_.legend) {
      const double width = swatchWidth + 6.0 + textWidth(entry.label) + 14.0;
      if (next.x > 14.0 && next.x + width > plot_.width) {
        next = {14.0, next.y + legendRow};
      }
      places.push_back(next);
      next.x += width;
    }
    return {places, places.empty() ? 0.0 : next.y + 0.5 * legendRow};
  }

  void writeLegend() {
    const std::vector<Place> places = legendPlaces().first;
    for (size_t i = 0; i < places.size(); ++i) {
      const LegendEntry& entry = plot_.legend[i];
      const Place at = places[i];
      svg_ += "<g class=\"" + entry.style + "\">";
      svg_ += entry.shape ? shapeElement(*entry.shape, {at.x + 0.5 * swatchWidth, at.y})
                          : lineElement("stroke", at, {at.x + swatchWidth, at.y});
      svg_ += textElement("text", {at.x + swatchWidth + 6.0, at.y + 4.0}, entry.label) + "</g>\n";
    }
  }

  void writeAxes() {
    for (const PlotScale::Tick& tick : x_.ticks(characterWidth, 10.0)) {
      svg_ += lineElement(tick.offAxis ? "grid apart" : "grid", {tick.at, frame_.top}, {tick.at, frame_.bottom});
      if (!tick.label.empty()) {
        svg_ += textElement("text middle", {tick.at, frame_.bottom + 16.0}, tick.label) + "\n";
      }
    }
    for (const PlotScale::Tick& tick : y_.ticks(0.0, 20.0)) {
      svg_ += lineElement(tick.offAxis ? "grid apart" : "grid", {frame_.left, tick.at}, {frame_.right, tick.at});
      if (!tick.label.empty()) {
        svg_ += textElement("text end", {frame_.left - 8.0, tick.at + 4.0}, tick.label) + "\n";
      }
    }
    svg_ += lineElement("axis", {frame_.left, frame_.top}, {frame_.left, frame_.bottom});
    svg_ += lineElement("axis", {frame_.left, frame_.bottom}, {frame_.right, frame_.bottom});
    writeBreaks();
    const double middle = 0.5 * (frame_.left + frame_.right);
    svg_ += textElement("text middle title", {middle, plot_.height - 10.0}, plot_.x.label);
    const double centre = 0.5 * (frame_.top + frame_.bottom);
    svg_ += "<text class=\"text middle title\"" + attribute("x", 12.0) + attribute("y", centre) +
            " transform=\"rotate(-90 12 " + coordinate(centre) + ")\">" + escapeHtml(plot_.y.label) + "</text>\n";
  }

  // Two slanted strokes where an axis leaves out a part of its range.
  void writeBreaks() {
    const auto strokes = [&](Place at) {
      for (const double shift : {-2.5, 2.5}) {
        const bool upright = at.x == frame_.left;
        const Place centre = upright ? Place{at.x, at.y + shift} : Place{at.x + shift, at.y};
        svg_ += lineElement("axis", {centre.x - 2.5, centre.y + 4.0}, {centre.x + 2.5, centre.y - 4.0});
      }
    };
    if (x_.hasApart()) {
      strokes({x_.axisEnd() + 8.0, frame_.bottom});
    }
    if (x_.hasZero()) {
      strokes({x_.axisStart() - 6.0, frame_.bottom});
    }
    if (y_.hasZero()) {
      strokes({frame_.left, y_.axisStart() + 6.0});
    }
  }

  void writeRules() {
    for (const PlotRule& rule : plot_.rules) {
      if (!drawn(rule)) {
        continue;
      }
      const double y = *y_.at(rule.y);
      svg_ += "<g class=\"" + rule.style + "\">" + lineElement("stroke", {frame_.left, y}, {frame_.right, y});
      occupied_.push_back({frame_.left, y - 1.0, frame_.right, y + 1.0});
      const Place text{frame_.left + 6.0, y - lineHeight > frame_.top ? y - 5.0 : y + lineHeight};
      svg_ += textElement("text", text, rule.label) + "</g>\n";
      occupied_.push_back({text.x, text.y - 11.0, text.x + textWidth(rule.label), text.y + 3.0});
    }
  }

  void writeLines() {
    const double top = std::min(y_.axisStart(), y_.axisEnd());
    for (const PlotLine& line : plot_.lines) {
      std::string path;
      for (size_t i = 1; i < line.points.size(); ++i) {
        const auto cut = segment(line.points[i - 1], line.points[i], top);
        if (cut) {
          occupied_.push_back(boundsOf(cut->first, cut->second));
          path += "M" + coordinate(cut->first.x) + " " + coordinate(cut->first.y) + "L" + coordinate(cut->second.x) +
                  " " + coordinate(cut->second.y);
        }
      }
      if (!path.empty()) {
        svg_ += "<g class=\"" + line.style + "\"><path class=\"stroke\" d=\"" + path + "\"/></g>\n";
      }
    }
  }

  // Off the axis (zero, behind the break) points have their places, elsewhere a line keeps its slope up to the frame.
  std::optional<std::pair<Place, Place>> segment(Sample2d a, Sample2d b, double top) const {
    const auto place = [&](Sample2d s) -> std::optional<Place> {
      const std::optional<double> x = x_.at(s.x);
      const std::optional<double> y = s.y > 0.0 || !y_.hasZero() ? y_.unclampedAt(s.y) : y_.at(s.y);
      return x && y ? std::optional(Place{*x, *y}) : std::nullopt;
    };
    const std::optional<Place> from = place(a);
    const std::optional<Place> to = place(b);
    return from && to ? cutAtFrame(*from, *to, top, frame_.bottom) : std::nullopt;
  }

  void writeSpreads() {
    for (const PlotMark& mark : plot_.marks) {
      const std::optional<Place> at = placeOf(mark.at);
      if (!at || !mark.spread) {
        continue;
      }
      const auto low = x_.at(mark.spread->lowerQuartile);
      const auto high = x_.at(mark.spread->upperQuartile);
      const auto minimum = x_.at(mark.spread->minimum);
      if (!low || !high || !minimum) {
        continue;
      }
      svg_ += "<g class=\"spread " + mark.style + "\">" + lineElement("bar", {*low, at->y}, {*high, at->y}) +
              lineElement("minimum", {*minimum, at->y}, {*low, at->y}) +
              lineElement("minimum", {*minimum, at->y - 4.0}, {*minimum, at->y + 4.0}) + "</g>\n";
    }
  }

  // Greedy: the first of eight places around the mark that hides nothing.
  void writeLabels() {
    for (const PlotMark& mark : plot_.marks) {
      if (const std::optional<Place> at = placeOf(mark.at)) {
        occupied_.push_back({at->x - 6.0, at->y - 6.0, at->x + 6.0, at->y + 6.0});
      }
    }
    for (auto mark = plot_.marks.rbegin(); mark != plot_.marks.rend(); ++mark) {
      const std::optional<Place> at = placeOf(mark->at);
      if (at && !mark->label.empty()) {
        writeLabel(mark->label, *at);
      }
    }
  }

  void writeLabel(const std::string& label, Place at) {
    const double width = textWidth(label);
    const double right = at.x + 9.0;
    const double left = at.x - 9.0 - width;
    const double centre = at.x - 0.5 * width;
    const double middle = at.y - 0.5 * labelHeight;
    const double above = at.y - 7.0 - labelHeight;
    const double below = at.y + 7.0;
    const std::array<Place, 8> corners{{{right, middle},
                                        {right - 4.0, above},
                                        {centre, above},
                                        {right - 4.0, below},
                                        {left, middle},
                                        {left + 4.0, below},
                                        {centre, below},
                                        {left + 4.0, above}}};
    const auto free = std::find_if(corners.begin(), corners.end(), [&](const Place& corner) {
      const Box box{corner.x, corner.y, corner.x + width, corner.y + labelHeight};
      return box.within(frame_) &&
             std::none_of(occupied_.begin(), occupied_.end(), [&](const Box& other) { return box.overlaps(other); });
    });
    if (free != corners.end()) {
      occupied_.push_back({free->x, free->y, free->x + width, free->y + labelHeight});
      svg_ += textElement("text label", {free->x, free->y + 10.0}, label) + "\n";
    }
  }

  void writeMark(const PlotMark& mark) {
    const std::optional<Place> at = placeOf(mark.at);
    if (!at) {
      return;
    }
    svg_ += "<g class=\"mark " + mark.style + "\"";
    if (mark.point >= 0) {
      svg_ += " data-point=\"" + std::to_string(mark.point) + "\"";
    }
    svg_ += "><title>" + escapeHtml(mark.tooltip) + "</title><circle class=\"hit\"" + attribute("cx", at->x) +
            attribute("cy", at->y) + " r=\"10\"/>" + shapeElement(mark.shape, *at) + "</g>\n";
  }

  const Plot& plot_;
  double legendHeight_;
  Box frame_;
  PlotScale x_;
  PlotScale y_;
  std::vector<Box> occupied_;
  std::string svg_;
};

}  // namespace

std::string plotSvg(const Plot& plot) {
  return PlotWriter(plot).write();
}

}  // namespace speculum
