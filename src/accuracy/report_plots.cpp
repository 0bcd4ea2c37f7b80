#include "accuracy/report_plots.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "accuracy/html_text.hpp"
#include "accuracy/pareto.hpp"
#include "accuracy/svg_plot.hpp"

namespace speculum {

namespace {

constexpr int longestLabel = 26;  // characters

struct ErrorMeasure {
  std::string name;
  std::function<std::optional<double>(const SweepPoint&)> of;
  std::optional<double> floor;
};

std::string shortName(const std::string& name) {
  if (characterCount(name) <= longestLabel) {
    return name;
  }
  std::string text;
  int characters = 0;
  for (const char c : name) {
    characters += (c & 0xc0) != 0x80;
    if (characters == longestLabel) {
      break;
    }
    text += c;
  }
  return text + "…";
}

std::string costText(const SweepPoint& point) {
  const Spread& cost = costSpread(point);
  return numberText(cost.median) + " ms [" + numberText(cost.lowerQuartile) + ", " + numberText(cost.upperQuartile) +
         "], at least " + numberText(cost.minimum) + " ms";
}

std::string tooltipOf(const SweepPoint& point, const std::string& measure, double error) {
  const std::string options = setOptions(point.changes);
  return point.name + "\n" + (options.empty() ? "base settings" : options) + "\n" + costText(point) + "\n" + measure +
         " " + numberText(error);
}

// Indices of points that are on the front of this measure, cheapest first.
std::vector<int> frontOf(const SweepResults& results, const ErrorMeasure& measure) {
  std::vector<FrontCandidate> candidates;
  std::vector<int> points;
  for (size_t i = 0; i < results.points.size(); ++i) {
    if (const std::optional<double> error = measure.of(results.points[i])) {
      candidates.push_back({*error, costSpread(results.points[i])});
      points.push_back(static_cast<int>(i));
    }
  }
  std::vector<int> front;
  for (const int candidate : paretoFront(candidates)) {
    front.push_back(points[candidate]);
  }
  return front;
}

std::vector<int> flipFront(const SweepResults& results) {
  std::vector<int> front;
  for (size_t i = 0; i < results.points.size(); ++i) {
    if (results.points[i].onFront) {
      front.push_back(static_cast<int>(i));
    }
  }
  std::stable_sort(front.begin(), front.end(),
                   [&](int a, int b) { return costMs(results.points[a]) < costMs(results.points[b]); });
  return front;
}

// What a budget buys: each error holds until the next point of the front can be paid for.
PlotLine stairs(const SweepResults& results, const ErrorMeasure& measure, const std::vector<int>& front) {
  PlotLine line{.style = "front-line"};
  for (const int i : front) {
    const Sample2d at{costMs(results.points[i]), *measure.of(results.points[i])};
    if (!line.points.empty()) {
      line.points.push_back({at.x, line.points.back().y});
    }
    line.points.push_back(at);
  }
  return line;
}

PlotMark markOf(const SweepResults& results, int index, const ErrorMeasure& measure, bool onFront) {
  const SweepPoint& point = results.points[index];
  const double error = *measure.of(point);
  const bool base = point.changes.empty();
  PlotMark mark{.at = {costMs(point), error}, .style = onFront ? "front" : "dominated", .point = index};
  mark.shape = error <= 0.0 ? MarkShape::triangle
               : base       ? MarkShape::square
               : onFront    ? MarkShape::disc
                            : MarkShape::ring;
  mark.style += base ? " base" : "";
  mark.label = onFront || base ? shortName(point.name) : "";
  mark.tooltip = tooltipOf(point, measure.name, error);
  if (costSpread(point).repeats > 1) {
    mark.spread = costSpread(point);
  }
  return mark;
}

void addTruth(Plot& plot, const SweepResults& results, const ErrorMeasure& measure) {
  if (!(results.truthMs > 0.0) || !measure.floor) {
    return;
  }
  double dearest = 0.0;
  for (const SweepPoint& point : results.points) {
    dearest = std::max(dearest, costMs(point));
  }
  if (results.truthMs > 20.0 * dearest && dearest > 0.0) {
    plot.x.apart = results.truthMs;
  }
  plot.marks.push_back({.at = {results.truthMs, *measure.floor},
                        .shape = MarkShape::diamond,
                        .style = "truth",
                        .label = "ray traced",
                        .tooltip = "Ray-traced ground truth\n" + numberText(results.truthMs / 1000.0) + " s on " +
                                   std::to_string(results.truthThreads) + " threads, wall clock\nnoise floor, " +
                                   measure.name + " " + numberText(*measure.floor)});
  plot.legend.push_back({"ray traced, CPU", "truth", MarkShape::diamond});
}

void addFrontLegend(Plot& plot) {
  const auto any = [&](auto&& test) { return std::any_of(plot.marks.begin(), plot.marks.end(), test); };
  plot.legend.push_back({"on the front", "mark front", MarkShape::disc});
  plot.legend.push_back({"dominated", "mark dominated", MarkShape::ring});
  for (const char* style : {"front base", "dominated base"}) {
    if (any([&](const PlotMark& m) { return m.style == style; })) {
      plot.legend.push_back({"base settings", std::string("mark ") + style, MarkShape::square});
      break;
    }
  }
  if (any([](const PlotMark& m) { return m.shape == MarkShape::triangle; })) {
    plot.legend.push_back({"no difference", "mark dominated", MarkShape::triangle});
  }
}

std::string costAxisLabel(const SweepResults& results) {
  return timedOnGpu(results) ? "GPU time, ms a frame" : "frame time, ms";
}

Plot frontPlot(const SweepResults& results, const ErrorMeasure& measure, const std::vector<int>& front) {
  Plot plot;
  plot.x.label = costAxisLabel(results);
  plot.y.label = measure.name;
  plot.description = measure.name + " against " + plot.x.label +
                     ", both logarithmic: " + std::to_string(results.points.size()) + " configurations, " +
                     std::to_string(front.size()) + " of them on the front. The table below has every value.";
  plot.lines.push_back(stairs(results, measure, front));
  for (size_t i = 0; i < results.points.size(); ++i) {
    if (measure.of(results.points[i])) {
      const int index = static_cast<int>(i);
      const bool onFront = std::find(front.begin(), front.end(), index) != front.end();
      plot.marks.push_back(markOf(results, index, measure, onFront));
    }
  }
  // The base covers the front, which covers the dominated.
  const auto layer = [](const PlotMark& m) { return m.style.ends_with("base") ? 2 : m.style == "front" ? 1 : 0; };
  std::stable_sort(plot.marks.begin(), plot.marks.end(),
                   [&](const PlotMark& a, const PlotMark& b) { return layer(a) < layer(b); });
  addFrontLegend(plot);
  if (measure.floor) {
    plot.rules.push_back({*measure.floor, "floor", "noise floor " + numberText(*measure.floor)});
  }
  addTruth(plot, results, measure);
  return plot;
}

std::string figure(const std::string& style, const std::string& title, const std::string& text,
                   const std::string& svg) {
  return "<figure class=\"" + style + "\">\n<figcaption><h3>" + escapeHtml(title) + "</h3><p>" + text +
         "</p></figcaption>\n" + svg + "</figure>\n";
}

Plot resized(Plot plot, int width, int height) {
  plot.width = width;
  plot.height = height;
  return plot;
}

// The two lines of a series, over the points that the fit takes.
void addSlopes(Plot& plot, const SweepSeries& series, const std::vector<Sample2d>& samples) {
  std::vector<Sample2d> fitted;
  for (const int place : series.fitted) {
    if (place >= 0 && place < static_cast<int>(samples.size()) && std::isfinite(samples[place].y) &&
        samples[place].y > 0.0) {
      fitted.push_back(samples[place]);
    }
  }
  if (fitted.empty()) {
    return;
  }
  const auto ends =
      std::minmax_element(fitted.begin(), fitted.end(), [](const Sample2d& a, const Sample2d& b) { return a.x < b.x; });
  const auto along = [&](double x) { return series.axis == SweepSeries::Axis::logarithmic ? std::log(x) : x; };
  const auto line = [&](const char* style, const LineFit& fit) {
    PlotLine result{.style = style};
    for (const double x : {ends.first->x, ends.second->x}) {
      result.points.push_back({x, std::exp(fit.offset + fit.slope * along(x))});
    }
    return result;
  };
  const Sample2d anchor = fitted.front();
  if (series.theorySlope != 0.0 && std::isfinite(series.theorySlope) && std::isfinite(along(anchor.x))) {
    plot.lines.push_back(
        line("theory", {series.theorySlope, std::log(anchor.y) - series.theorySlope * along(anchor.x)}));
    plot.legend.push_back({"theory, slope " + numberText(series.theorySlope), "theory", std::nullopt});
  }
  if (series.fit && std::isfinite(series.fit->slope) && std::isfinite(series.fit->offset)) {
    plot.lines.push_back(line("fit", *series.fit));
    plot.legend.push_back({"fit, slope " + numberText(series.fit->slope), "fit", std::nullopt});
  }
}

std::vector<Sample2d> samplesOf(const SweepResults& results, const SweepSeries& series) {
  std::vector<Sample2d> samples;
  for (size_t i = 0; i < std::min(series.x.size(), series.points.size()); ++i) {
    const int point = series.points[i];
    const bool known = point >= 0 && point < static_cast<int>(results.points.size());
    samples.push_back(
        {series.x[i], known ? seriesError(results.points[point]) : std::numeric_limits<double>::quiet_NaN()});
  }
  return samples;
}

bool seriesHasMirrors(const SweepResults& results, const SweepSeries& series) {
  return !series.points.empty() && std::all_of(series.points.begin(), series.points.end(), [&](int point) {
    return point >= 0 && point < static_cast<int>(results.points.size()) && results.points[point].mirrors;
  });
}

Plot seriesPlot(const SweepResults& results, const SweepSeries& series) {
  const bool mirrors = seriesHasMirrors(results, series);
  const std::vector<Sample2d> samples = samplesOf(results, series);
  Plot plot;
  plot.width = 440;
  plot.height = 330;
  plot.x = {.label = series.key,
            .scale = series.axis == SweepSeries::Axis::logarithmic ? AxisScale::logarithmic : AxisScale::linear,
            .ticks = series.x};
  plot.y.label = mirrors ? "RMSE over mirrors" : "RMSE";
  plot.description = plot.y.label + " against " + series.key + " at " + std::to_string(samples.size()) + " settings.";
  for (size_t i = 0; i < samples.size(); ++i) {
    const bool fits = std::find(series.fitted.begin(), series.fitted.end(), static_cast<int>(i)) != series.fitted.end();
    if (std::isnan(samples[i].y)) {
      continue;
    }
    plot.marks.push_back({.at = samples[i],
                          .shape = samples[i].y <= 0.0 ? MarkShape::triangle
                                   : fits              ? MarkShape::disc
                                                       : MarkShape::ring,
                          .style = fits ? "front" : "dominated",
                          .tooltip = tooltipOf(results.points[series.points[i]], plot.y.label, samples[i].y),
                          .point = series.points[i]});
  }
  addSlopes(plot, series, samples);
  const ImageMetrics* floor = !mirrors ? &results.floorWhole : results.floorMirrors ? &*results.floorMirrors : nullptr;
  if (floor) {
    plot.rules.push_back({floor->rmse, "floor", "noise floor " + numberText(floor->rmse)});
  }
  return plot;
}

}  // namespace

bool timedOnGpu(const SweepResults& results) {
  return std::all_of(results.points.begin(), results.points.end(),
                     [](const SweepPoint& point) { return point.gpuMs.repeats > 0; });
}

std::string frontFigures(const SweepResults& results) {
  const ErrorMeasure flip{"mean FLIP", [](const SweepPoint& p) { return std::optional(p.whole.flip); },
                          results.floorWhole.flip};
  const ErrorMeasure rmse{"RMSE", [](const SweepPoint& p) { return std::optional(p.whole.rmse); },
                          results.floorWhole.rmse};
  const ErrorMeasure mirrors{
      "RMSE over mirrors",
      [](const SweepPoint& p) { return p.mirrors ? std::optional(p.mirrors->rmse) : std::nullopt; },
      results.floorMirrors ? std::optional(results.floorMirrors->rmse) : std::nullopt};

  const Plot main = frontPlot(results, flip, flipFront(results));
  std::string html =
      figure("main", "Visible error against time", "Mean FLIP of the whole picture. Lower left is better.",
             "<div class=\"wide\">" + plotSvg(resized(main, 900, 480)) + "</div>\n<div class=\"narrow\">" +
                 plotSvg(main) + "</div>\n");
  html += figure("half", "Linear error against time", "Root mean square error of linear light, whole picture.",
                 plotSvg(frontPlot(results, rmse, frontOf(results, rmse))));
  if (std::any_of(results.points.begin(), results.points.end(), [](const SweepPoint& p) { return !!p.mirrors; })) {
    html += figure("half", "Linear error in the mirrors", "The same, over the pixels that show a mirror’s front.",
                   plotSvg(frontPlot(results, mirrors, frontOf(results, mirrors))));
  }
  return html;
}

std::string seriesFigures(const SweepResults& results) {
  std::string html;
  for (const SweepSeries& series : results.series) {
    html += figure("half", series.name, escapeHtml(series.note), plotSvg(seriesPlot(results, series)));
  }
  return html;
}

}  // namespace speculum
