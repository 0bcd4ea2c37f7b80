#include "accuracy/report_viewer.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "accuracy/html_text.hpp"
#include "accuracy/pareto.hpp"
#include "accuracy/report_plots.hpp"

namespace speculum {

namespace {

constexpr int mostShown = 12;
constexpr int pictureQuality = 88;
constexpr int mapQuality = 88;
constexpr int legendQuality = 95;
constexpr const char* legendText = "Colours of the error map and the errors they stand for";
// Characters of pictures in a report, for pictures of up to 640x360 and in proportion for larger ones.
constexpr double pictureBudget = 1.42e6;
constexpr double budgetPixels = 640.0 * 360.0;

struct Embedded {
  int width = 0;
  int height = 0;
  std::string uri;
};

struct ShownPoint {
  int point = 0;
  std::optional<Embedded> picture;
  std::optional<Embedded> map;
  std::optional<Embedded> legend;
};

Image8 rows(const Image8& image, int first, int count) {
  Image8 part(image.width, count);
  std::copy_n(image.at(0, first), part.rgba.size(), part.rgba.begin());
  return part;
}

Embedded embedded(const Image8& image, int quality) {
  return {image.width, image.height, "data:image/jpeg;base64," + base64(encodeJpeg(image, quality))};
}

// A missing or damaged file is nothing: the report says so in the picture's place.
std::optional<Image8> pictureIn(const std::filesystem::path& folder, const std::string& file) {
  if (file.empty()) {
    return std::nullopt;
  }
  try {
    return readImage8(folder / file);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

ShownPoint shownPoint(const SweepResults& results, int point, const std::filesystem::path& folder) {
  ShownPoint shown{.point = point};
  if (const auto picture = pictureIn(folder, results.points[point].picture)) {
    shown.picture = embedded(*picture, pictureQuality);
  }
  if (const auto map = pictureIn(folder, results.points[point].heatMap)) {
    // What is beyond the picture's height is the map's own legend.
    const int height = std::min(map->height, results.height > 0 ? results.height : map->height);
    shown.map = embedded(rows(*map, 0, height), mapQuality);
    if (height < map->height) {
      shown.legend = embedded(rows(*map, height, map->height - height), legendQuality);
    }
  }
  return shown;
}

std::string imageElement(const Embedded& image, const std::string& attributes, const std::string& alt) {
  return "<img " + attributes + " width=\"" + std::to_string(image.width) + "\" height=\"" +
         std::to_string(image.height) + "\" alt=\"" + escapeHtml(alt) + "\" src=\"" + image.uri + "\">\n";
}

// The first point is shown whatever it takes; a legend that is the first one's takes nothing.
std::vector<ShownPoint> shownWithin(double budget, const SweepResults& results, const std::filesystem::path& folder) {
  std::vector<ShownPoint> shown;
  for (const int point : shownPoints(results, mostShown)) {
    ShownPoint next = shownPoint(results, point, folder);
    if (!next.picture) {
      continue;
    }
    budget -= static_cast<double>(next.picture->uri.size() + (next.map ? next.map->uri.size() : 0));
    const bool sameLegend =
        !shown.empty() && shown.front().legend && next.legend && shown.front().legend->uri == next.legend->uri;
    budget -= next.legend && !sameLegend ? static_cast<double>(next.legend->uri.size()) : 0.0;
    if (budget < 0.0 && !shown.empty()) {
      break;
    }
    shown.push_back(std::move(next));
  }
  return shown;
}

// What a script shows for one point at a time; without a script it is the first point's.
std::string forPoint(int point, bool first) {
  return "data-shown=\"" + std::to_string(point) + "\"" + (first ? "" : " hidden");
}

std::string changesOrBase(const SweepPoint& point) {
  return point.changes.empty() ? "base settings" : setOptions(point.changes);
}

std::string choice(const SweepResults& results, const std::vector<ShownPoint>& shown) {
  std::vector<int> points;
  for (const ShownPoint& s : shown) {
    points.push_back(s.point);
  }
  std::stable_sort(points.begin(), points.end(),
                   [&](int a, int b) { return costMs(results.points[a]) < costMs(results.points[b]); });
  std::string html = "<p class=\"controls\"><label>Configuration <select id=\"choice\">";
  for (const int point : points) {
    const SweepPoint& p = results.points[point];
    html += "<option value=\"" + std::to_string(point) + "\"" + (point == shown.front().point ? " selected" : "") +
            ">" + escapeHtml(p.name) + " · " + numberText(costMs(p)) + " ms" + (p.onFront ? " · on the front" : "") +
            "</option>";
  }
  return html +
         "<option value=\"\" hidden>one that is not in this report</option></select></label> <span class=\"zoom\" "
         "role=\"group\" aria-label=\"Zoom\">"
         "<button type=\"button\" data-zoom=\"1\" aria-pressed=\"true\">1×</button>"
         "<button type=\"button\" data-zoom=\"2\" aria-pressed=\"false\">2×</button>"
         "<button type=\"button\" data-zoom=\"4\" aria-pressed=\"false\">4×</button>"
         "<button type=\"button\" data-zoom=\"8\" aria-pressed=\"false\">8×</button></span></p>\n";
}

std::string missing(const std::string& attributes, const std::string& what, const std::string& file) {
  const std::string where = file.empty() ? "it was not kept" : "its lossless file is " + file;
  return "<p class=\"missing\" " + attributes + ">" + escapeHtml(what + " is not in this report; " + where) + ".</p>\n";
}

const ShownPoint* findShown(const std::vector<ShownPoint>& shown, int point) {
  const auto found = std::find_if(shown.begin(), shown.end(), [&](const ShownPoint& s) { return s.point == point; });
  return found == shown.end() ? nullptr : &*found;
}

std::string splitFrame(const SweepResults& results, const std::vector<ShownPoint>& shown,
                       const std::optional<Embedded>& truth) {
  const int first = shown.front().point;
  std::string html = "<div class=\"frame split\" style=\"aspect-ratio:" + std::to_string(std::max(1, results.width)) +
                     "/" + std::to_string(std::max(1, results.height)) + "\">\n";
  html += truth ? imageElement(*truth, "class=\"reference\"", "Ray-traced reference picture of " + results.scene)
                : missing("", "The reference picture", results.truthPicture);
  html += "<div class=\"test\">\n";
  for (size_t i = 0; i < results.points.size(); ++i) {
    const int point = static_cast<int>(i);
    const SweepPoint& p = results.points[i];
    const ShownPoint* s = findShown(shown, point);
    html += s && s->picture ? imageElement(*s->picture, forPoint(point, point == first),
                                           "Rendered picture of " + p.name + ": " + changesOrBase(p))
                            : missing(forPoint(point, point == first), "The picture of " + p.name, p.picture);
  }
  return html +
         "</div>\n<span class=\"side left\" aria-hidden=\"true\">rendered</span>"
         "<span class=\"side right\" aria-hidden=\"true\">ray traced</span>"
         "<span class=\"divider\" aria-hidden=\"true\"></span>\n"
         "<input type=\"range\" id=\"divider\" min=\"0\" max=\"1000\" value=\"500\" "
         "aria-label=\"Divider between the rendered and the ray-traced picture\">\n</div>\n";
}

// The legend that all maps share, as they do unless someone has made some with another range.
std::optional<Embedded> commonLegend(const std::vector<ShownPoint>& shown) {
  const std::optional<Embedded>& first = shown.front().legend;
  const bool common = first && std::all_of(shown.begin(), shown.end(), [&](const ShownPoint& s) {
                        return s.legend && s.legend->uri == first->uri;
                      });
  return common ? first : std::nullopt;
}

std::string mapFrame(const SweepResults& results, const std::vector<ShownPoint>& shown) {
  const int first = shown.front().point;
  std::string maps;
  std::string legends;
  const std::optional<Embedded> common = commonLegend(shown);
  if (common) {
    legends = imageElement(*common, "class=\"legend\"", legendText);
  }
  for (size_t i = 0; i < results.points.size(); ++i) {
    const int point = static_cast<int>(i);
    const SweepPoint& p = results.points[i];
    const ShownPoint* s = findShown(shown, point);
    const std::string attributes = forPoint(point, point == first);
    maps += s && s->map ? imageElement(*s->map, attributes,
                                       "FLIP error map of " + p.name + ", mean " + numberText(p.whole.flip))
                        : missing(attributes, "The error map of " + p.name, p.heatMap);
    if (s && s->legend && !common) {
      legends += imageElement(*s->legend, "class=\"legend\" " + attributes, legendText);
    }
  }
  return "<div class=\"frame map\" style=\"aspect-ratio:" + std::to_string(std::max(1, results.width)) + "/" +
         std::to_string(std::max(1, results.height)) + "\">\n" + maps + "</div>\n" + legends;
}

std::string captions(const SweepResults& results, int first) {
  std::string html;
  for (size_t i = 0; i < results.points.size(); ++i) {
    const SweepPoint& p = results.points[i];
    const int point = static_cast<int>(i);
    html += "<p class=\"shown\" " + forPoint(point, point == first) + "><strong>" + escapeHtml(p.name) + "</strong> " +
            "<code>" + escapeHtml(changesOrBase(p)) + "</code><br>" + numberText(costMs(p)) + " ms, mean FLIP " +
            numberText(p.whole.flip) + ", RMSE " + numberText(p.whole.rmse);
    if (!p.picture.empty()) {
      html += ". Lossless: <code>" + escapeHtml(p.picture) + "</code>";
      html += p.heatMap.empty() ? "" : ", <code>" + escapeHtml(p.heatMap) + "</code>";
    }
    html += ".</p>\n";
  }
  return html;
}

}  // namespace

std::vector<int> shownPoints(const SweepResults& results, int most) {
  const std::vector<SweepPoint>& points = results.points;
  std::vector<int> byCost(points.size());
  std::iota(byCost.begin(), byCost.end(), 0);
  std::erase_if(byCost, [&](int i) { return points[i].picture.empty(); });
  std::stable_sort(byCost.begin(), byCost.end(), [&](int a, int b) { return costMs(points[a]) < costMs(points[b]); });
  std::vector<int> shown;
  const auto add = [&](int point) {
    if (static_cast<int>(shown.size()) < most && std::find(shown.begin(), shown.end(), point) == shown.end()) {
      shown.push_back(point);
    }
  };
  if (byCost.empty()) {
    return shown;
  }
  std::vector<int> front;
  for (const int i : byCost) {
    if (points[i].changes.empty()) {
      add(i);
    }
    if (points[i].onFront) {
      front.push_back(i);
    }
  }
  if (!front.empty()) {
    add(front.front());
    add(front.back());
  }
  const auto [best, worst] = std::minmax_element(
      byCost.begin(), byCost.end(), [&](int a, int b) { return points[a].whole.flip < points[b].whole.flip; });
  add(*worst);
  const size_t room = static_cast<size_t>(std::max(1, most - static_cast<int>(shown.size())));
  const size_t step = std::max<size_t>(1, (front.size() + room - 1) / room);
  for (size_t start = 0; start < step; ++start) {
    for (size_t i = start; i < front.size(); i += step) {
      add(front[i]);
    }
  }
  for (const int extreme : {*best, byCost.front(), byCost.back()}) {
    add(extreme);
  }
  return shown;
}

std::string viewerHtml(const SweepResults& results, const std::filesystem::path& folder) {
  const double pixels = static_cast<double>(results.width) * results.height;
  const auto truthPicture = pictureIn(folder, results.truthPicture);
  const auto truth = truthPicture ? std::optional(embedded(*truthPicture, pictureQuality)) : std::nullopt;
  const double budget = pictureBudget * std::max(1.0, pixels / budgetPixels) - (truth ? truth->uri.size() : 0);
  const std::vector<ShownPoint> shown = shownWithin(budget, results, folder);
  if (shown.empty()) {
    return "<p class=\"missing\">No pictures were kept, or none could be read.</p>\n";
  }
  return choice(results, shown) + "<div class=\"panes\">\n<div class=\"pane\">\n" + splitFrame(results, shown, truth) +
         captions(results, shown.front().point) + "</div>\n<div class=\"pane\">\n" + mapFrame(results, shown) +
         "<p class=\"shown\">FLIP error of each pixel. <span class=\"hint\">Zoomed views follow the pointer on the "
         "map, or "
         "its arrow keys.</span></p>\n</div>\n</div>\n";
}

}  // namespace speculum
