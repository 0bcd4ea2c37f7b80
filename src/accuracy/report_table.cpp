#include "accuracy/report_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numeric>
#include <optional>

#include "accuracy/html_text.hpp"
#include "accuracy/pareto.hpp"

namespace speculum {

namespace {

using Metric = std::function<double(const ImageMetrics&)>;

struct MetricColumn {
  std::string heading;
  Metric of;
  bool ofMirrors = false;
  bool higherIsBetter = false;
};

double shareOver(const ImageMetrics& m) {
  return m.pixels > 0 ? 100.0 * static_cast<double>(m.pixelsOver) / static_cast<double>(m.pixels) : 0.0;
}

const std::vector<MetricColumn>& metricColumns() {
  static const std::vector<MetricColumn> columns = {
      {"FLIP", [](const ImageMetrics& m) { return m.flip; }},
      {"RMSE", [](const ImageMetrics& m) { return m.rmse; }},
      {"rel. RMSE", [](const ImageMetrics& m) { return m.relativeRmse; }},
      {"PSNR, dB", [](const ImageMetrics& m) { return m.psnr; }, false, true},
      {"SSIM", [](const ImageMetrics& m) { return m.ssim; }, false, true},
      {"max", [](const ImageMetrics& m) { return m.maxDiff; }},
      {"p99", [](const ImageMetrics& m) { return m.p99Diff; }},
      {"&gt; 2/255, %", shareOver},
      {"RMSE", [](const ImageMetrics& m) { return m.rmse; }, true},
  };
  return columns;
}

std::optional<double> valueOf(const MetricColumn& column, const ImageMetrics& whole,
                              const std::optional<ImageMetrics>& mirrors) {
  if (column.ofMirrors) {
    return mirrors ? std::optional(column.of(*mirrors)) : std::nullopt;
  }
  return column.of(whole);
}

// What a script sorts by: JavaScript reads 1e999 as infinity.
std::string sortKey(double value) {
  if (std::isnan(value)) {
    return "";
  }
  char text[64];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return std::isinf(value) ? (value > 0.0 ? "1e999" : "-1e999") : text;
}

std::string numberCell(const std::string& text, const std::string& key) {
  return "<td class=\"number\" data-key=\"" + key + "\">" + text + "</td>";
}

std::string metricCell(std::optional<double> value, int decimals) {
  return value ? numberCell(fixedText(*value, decimals), sortKey(*value)) : numberCell("–", "");
}

std::string heading(int column, const std::string& text, bool sorted, bool higherFirst = false) {
  return "<th scope=\"col\"" + std::string(sorted ? " aria-sort=\"ascending\"" : "") + "><button type=\"button\" " +
         "data-column=\"" + std::to_string(column) + "\"" + (higherFirst ? " data-first=\"descending\"" : "") + ">" +
         text + "</button></th>";
}

std::string headings() {
  std::string html =
      "<thead>\n<tr class=\"groups\"><td></td><th scope=\"colgroup\" colspan=\"2\">Configuration</th>"
      "<th scope=\"colgroup\" colspan=\"2\">Median ms a frame</th>"
      "<th scope=\"colgroup\" colspan=\"5\">Whole picture</th>"
      "<th scope=\"colgroup\" colspan=\"3\">Difference, 1/255</th><th scope=\"colgroup\">Mirrors</th></tr>\n<tr>";
  html += heading(0, "<abbr title=\"on the front of mean FLIP\">Front</abbr>", false, true);
  html += heading(1, "Name", false) + heading(2, "Settings", false);
  html += heading(3, "GPU [quartiles]", true) + heading(4, "CPU", false);
  int column = 5;
  for (const MetricColumn& metric : metricColumns()) {
    html += heading(column++, metric.heading, false, metric.higherIsBetter);
  }
  return html + "</tr>\n</thead>\n";
}

std::string timeCell(const Spread& spread, int decimals, bool quartiles) {
  if (spread.repeats == 0) {
    return numberCell("–", "");
  }
  std::string text = fixedText(spread.median, decimals);
  if (quartiles) {
    text += " <span class=\"quartiles\">[" + fixedText(spread.lowerQuartile, decimals) + ", " +
            fixedText(spread.upperQuartile, decimals) + "]</span>";
  }
  return numberCell(text, sortKey(spread.median));
}

std::string settingsCell(const SweepPoint& point) {
  if (point.changes.empty()) {
    return "<td class=\"settings\" data-key=\"\"><span class=\"none\">base settings</span></td>";
  }
  const std::string options = escapeHtml(setOptions(point.changes));
  std::string parts;
  for (const SettingChange& change : point.changes) {
    parts += (parts.empty() ? "<span>" : " <span>") + escapeHtml(setOptions({change})) + "</span>";
  }
  return "<td class=\"settings\" data-key=\"" + options + "\"><code>" + parts +
         "</code> <button type=\"button\" class=\"copy\" data-copy=\"" + options +
         "\" aria-label=\"Copy the settings of " + escapeHtml(point.name) + "\">copy</button></td>";
}

// Decimals of each column, so that the smallest value keeps three digits.
struct Decimals {
  int gpu = 0;
  int cpu = 0;
  std::vector<int> metrics;
};

Decimals decimalsOf(const SweepResults& results) {
  std::vector<double> gpu;
  std::vector<double> cpu;
  for (const SweepPoint& point : results.points) {
    gpu.push_back(point.gpuMs.median);
    cpu.push_back(point.cpuMs.median);
  }
  Decimals decimals{std::min(3, columnDecimals(gpu)), std::min(3, columnDecimals(cpu)), {}};
  for (const MetricColumn& column : metricColumns()) {
    std::vector<double> values;
    for (const SweepPoint& point : results.points) {
      values.push_back(valueOf(column, point.whole, point.mirrors).value_or(0.0));
    }
    const bool whole = std::all_of(values.begin(), values.end(), [](double v) { return v == std::floor(v); });
    const int enough = column.heading == "SSIM" ? 5 : column.heading == "PSNR, dB" ? 2 : columnDecimals(values);
    decimals.metrics.push_back(whole ? 0 : enough);
  }
  return decimals;
}

std::string row(const SweepPoint& point, int index, const Decimals& decimals) {
  std::string html = "<tr data-point=\"" + std::to_string(index) + "\" class=\"" +
                     (point.onFront ? "front" : "dominated") + (point.changes.empty() ? " base" : "") + "\">";
  html += std::string("<td class=\"mark\" data-key=\"") + (point.onFront ? "1" : "0") + "\">" +
          (point.onFront ? "<span role=\"img\" aria-label=\"on the front\">●</span>" : "") + "</td>";
  html += "<th scope=\"row\" data-key=\"" + escapeHtml(point.name) +
          "\"><button type=\"button\" class=\"name\" aria-pressed=\"false\">" + escapeHtml(point.name) +
          "</button></th>";
  html += settingsCell(point) + timeCell(point.gpuMs, decimals.gpu, true) + timeCell(point.cpuMs, decimals.cpu, false);
  for (size_t i = 0; i < metricColumns().size(); ++i) {
    html += metricCell(valueOf(metricColumns()[i], point.whole, point.mirrors), decimals.metrics[i]);
  }
  return html + "</tr>\n";
}

std::string floorRow(const SweepResults& results, const Decimals& decimals) {
  std::string html =
      "<tfoot>\n<tr><td></td><th scope=\"row\" colspan=\"2\">noise floor of the ground truth</th>"
      "<td class=\"number\" colspan=\"2\">" +
      numberText(results.truthMs / 1000.0) + " s, " + std::to_string(results.truthThreads) + " threads</td>";
  for (size_t i = 0; i < metricColumns().size(); ++i) {
    html += metricCell(valueOf(metricColumns()[i], results.floorWhole, results.floorMirrors), decimals.metrics[i]);
  }
  return html + "</tr>\n</tfoot>\n";
}

}  // namespace

std::string pointTable(const SweepResults& results) {
  std::vector<int> order(results.points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return costMs(results.points[a]) < costMs(results.points[b]); });
  const Decimals decimals = decimalsOf(results);
  std::string rows;
  for (const int index : order) {
    rows += row(results.points[index], index, decimals);
  }
  return "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"All configurations\">\n"
         "<table id=\"points\">\n<caption>Every configuration, blue dots: on the front. <span class=\"hint\">The "
         "headings sort; a name shows "
         "its picture and marks it in the plots.</span></caption>\n" +
         headings() + "<tbody>\n" + rows + "</tbody>\n" + floorRow(results, decimals) + "</table>\n</div>\n";
}

}  // namespace speculum
