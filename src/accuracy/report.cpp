#include "accuracy/report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "accuracy/pareto.hpp"
#include "accuracy/sweep_json.hpp"
#include "image/picture_files.hpp"
#include "platform/text.hpp"

namespace speculum {

namespace {

using nlohmann::ordered_json;

constexpr int mostShown = 12;
constexpr int pictureQuality = 88;
constexpr int legendQuality = 95;
// Characters that all pictures of a report together may take. The budget grows in proportion for pictures larger than
// 640x360.
constexpr double pictureBudget = 1.42e6;
constexpr double framesBudget = 4.0;  // characters of a movement's frames, as a multiple of that budget
constexpr double budgetPixels = 640.0 * 360.0;

Image8 rows(const Image8& image, int first, int count) {
  Image8 part(image.width, count);
  std::copy_n(image.at(0, first), part.rgba.size(), part.rgba.begin());
  return part;
}

ordered_json embedded(const Image8& image, int quality) {
  return {{"width", image.width},
          {"height", image.height},
          {"uri", "data:image/jpeg;base64," + base64(encodeJpeg(image, quality))}};
}

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

size_t sizeOf(const ordered_json& picture) {
  return picture.is_null() ? 0 : picture["uri"].get_ref<const std::string&>().size();
}

// Embeds a movement's frames as far as the budget allows it, and lowers the budget. No frames are embedded of a
// configuration whose frames do not all fit.
ordered_json framesJson(const std::vector<std::string>& files, const std::filesystem::path& folder, double& budget) {
  ordered_json frames = ordered_json::array();
  double size = 0.0;
  for (const std::string& file : files) {
    const auto frame = pictureIn(folder, file);
    frames.push_back(frame ? embedded(*frame, pictureQuality) : ordered_json());
    size += static_cast<double>(sizeOf(frames.back()));
    if (size > budget) {
      return ordered_json::array();
    }
  }
  budget -= size;
  return frames;
}

// Embeds pictures of points up to the budget, at least those of the first point. All heat maps have the same legend.
ordered_json picturesJson(const SweepResults& results, const std::filesystem::path& folder) {
  ordered_json pictures = {
      {"reference", nullptr}, {"legend", nullptr}, {"shown", ordered_json::array()}, {"frames", ordered_json::array()}};
  if (const auto reference = pictureIn(folder, results.truthPicture)) {
    pictures["reference"] = embedded(*reference, pictureQuality);
  }
  const double pixels = static_cast<double>(results.width) * results.height;
  const double budget = pictureBudget * std::max(1.0, pixels / budgetPixels);
  double forFrames = framesBudget * budget;
  pictures["frames"] = framesJson(results.truthFrames, folder, forFrames);
  size_t size = sizeOf(pictures["reference"]);
  for (const int point : shownPoints(results, mostShown)) {
    const auto picture = pictureIn(folder, results.points[point].picture);
    const auto map = pictureIn(folder, results.points[point].heatMap);
    if (!picture) {
      continue;
    }
    ordered_json shown = {{"point", point},
                          {"picture", embedded(*picture, pictureQuality)},
                          {"map", nullptr},
                          {"frames", framesJson(results.points[point].frames, folder, forFrames)}};
    if (map) {
      const int height =
          results.height > 0 ? std::min(results.height, map->height) : map->height;  // the legend is below the map
      shown["map"] = embedded(rows(*map, 0, height), pictureQuality);
      if (height < map->height && pictures["legend"].is_null()) {
        pictures["legend"] = embedded(rows(*map, height, map->height - height), legendQuality);
      }
    }
    size += sizeOf(shown["picture"]) + sizeOf(shown["map"]);
    if (static_cast<double>(size) > budget && !pictures["shown"].empty()) {
      break;
    }
    pictures["shown"].push_back(std::move(shown));
  }
  return pictures;
}

std::vector<int> flipFront(const SweepResults& results) {
  std::vector<int> front = indicesByCost(results.points);
  std::erase_if(front, [&](int i) { return !results.points[i].onFront; });
  return front;
}

ordered_json frontsJson(const SweepResults& results) {
  const std::vector<SweepPoint>& points = results.points;
  const auto ofMirrors = [](const SweepPoint& point) {
    return point.mirrors ? std::optional(point.mirrors->rmse) : std::nullopt;
  };
  return {{"flip", flipFront(results)},
          {"rmse", paretoFront(points, [](const SweepPoint& point) { return point.whole.rmse; })},
          {"mirrors", paretoFront(points, ofMirrors)},
          {"flicker", paretoFront(points, &SweepPoint::flicker)}};
}

ordered_json changedSettings(const SweepResults& results) {
  ordered_json changed = ordered_json::object();
  for (const SettingChange& setting : results.base) {
    if (settingValue(Settings{}, setting.key) != setting.value) {
      changed[setting.key] = setting.value;
    }
  }
  return changed;
}

}  // namespace

std::vector<int> shownPoints(const SweepResults& results, int most) {
  const std::vector<SweepPoint>& points = results.points;
  std::vector<int> byCost = indicesByCost(points);
  std::erase_if(byCost, [&](int i) { return points[i].picture.empty(); });
  std::vector<int> shown;
  const auto add = [&](int point) {
    if (static_cast<int>(shown.size()) < most && std::ranges::find(shown, point) == shown.end()) {
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
  const auto [best, worst] =
      std::ranges::minmax_element(byCost, [&](int a, int b) { return points[a].whole.flip < points[b].whole.flip; });
  add(*worst);
  const auto flickering = std::ranges::max_element(byCost, {}, [&](int i) { return points[i].flicker; });
  if (points[*flickering].flicker) {
    add(*flickering);
  }
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

ordered_json reportJson(const SweepResults& results, const std::filesystem::path& folder) {
  return {{"results", sweepJson(results)},
          {"fronts", frontsJson(results)},
          {"changed", changedSettings(results)},
          {"pictures", picturesJson(results, folder)}};
}

std::string reportHtml(const SweepResults& results, const std::filesystem::path& folder) {
  return pageWithData(reportPage(), reportJson(results, folder));
}

std::string base64(std::span<const uint8_t> bytes) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < count ? bytes[i + k] : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      text += k <= count ? alphabet[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

std::string pageWithData(std::string_view page, const nlohmann::ordered_json& data) {
  constexpr std::string_view placeholder = "@DATA@";
  const size_t at = page.find(placeholder);
  const std::string json = data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  return std::string(page.substr(0, at)) + escaped(json, {{'<', "\\u003c"}}) +  // nothing can end a script element
         std::string(page.substr(at + placeholder.size()));
}

}  // namespace speculum
