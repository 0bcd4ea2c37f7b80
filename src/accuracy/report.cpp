#include "accuracy/report.hpp"

#include <algorithm>

#include "accuracy/html_text.hpp"
#include "accuracy/pareto.hpp"
#include "accuracy/report_assets.hpp"
#include "accuracy/report_plots.hpp"
#include "accuracy/report_table.hpp"
#include "accuracy/report_viewer.hpp"
#include "frame/settings.hpp"

namespace speculum {

namespace {

std::string counted(size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::vector<const SweepPoint*> frontPoints(const SweepResults& results) {
  std::vector<const SweepPoint*> front;
  for (const SweepPoint& point : results.points) {
    if (point.onFront) {
      front.push_back(&point);
    }
  }
  std::stable_sort(front.begin(), front.end(),
                   [](const SweepPoint* a, const SweepPoint* b) { return costMs(*a) < costMs(*b); });
  return front;
}

const SweepPoint* basePoint(const SweepResults& results) {
  const auto base = std::find_if(results.points.begin(), results.points.end(),
                                 [](const SweepPoint& point) { return point.changes.empty(); });
  return base == results.points.end() ? nullptr : &*base;
}

std::string atText(const SweepPoint& point) {
  return numberText(costMs(point)) + " ms and mean FLIP " + numberText(point.whole.flip);
}

std::string frontSentence(const std::vector<const SweepPoint*>& front, size_t points) {
  if (front.empty()) {
    return "Of " + counted(points, "configuration") + ", none is on the front";
  }
  if (front.size() == 1) {
    return "Of " + counted(points, "configuration") + ", one is worth its price: " + front[0]->name + " at " +
           atText(*front[0]);
  }
  return "Of " + counted(points, "configuration") + ", " + std::to_string(front.size()) +
         " are worth their price, from " + atText(*front.front()) + " (" + front.front()->name + ") to " +
         atText(*front.back()) + " (" + front.back()->name + ")";
}

std::string floorSentence(const SweepResults& results, const SweepPoint* base) {
  const double floor = results.floorWhole.flip;
  const std::string text = "the ground truth itself is known to " + numberText(floor);
  if (base == nullptr || !(floor > 0.0)) {
    return text;
  }
  return base->whole.flip > floor ? text + ", " + numberText(base->whole.flip / floor, 2) + " times below that"
                                  : text + ", which is no better than that";
}

// What was found, in one sentence.
std::string summary(const SweepResults& results) {
  if (results.points.empty()) {
    return "No configuration was measured.";
  }
  const SweepPoint* base = basePoint(results);
  std::string text = frontSentence(frontPoints(results), results.points.size());
  if (base != nullptr) {
    text += "; the base settings take " + atText(*base) + (base->onFront ? ", on the front" : ", off the front");
  }
  return text + "; " + floorSentence(results, base) + ".";
}

std::string fact(const std::string& term, const std::string& text) {
  return "<div><dt>" + escapeHtml(term) + "</dt><dd>" + escapeHtml(text.empty() ? "–" : text) + "</dd></div>\n";
}

std::string header(const SweepResults& results) {
  const std::string title = results.title.empty() ? results.scene : results.title;
  const std::string size = std::to_string(results.width) + " × " + std::to_string(results.height) + "\u00a0pixels";
  return "<header>\n<p class=\"kicker\">Speculum · accuracy sweep</p>\n<h1>" + escapeHtml(title) +
         "</h1>\n<p class=\"lede\">" + escapeHtml(summary(results)) + "</p>\n<dl class=\"facts\">\n" +
         fact("Scene", results.scene) + fact("Picture", size + ", time\u00a0" + exactText(results.time) + "\u00a0s") +
         fact("Sweep", results.sweep + ", " + counted(results.points.size(), "configuration")) +
         fact("Device", results.device) + fact("Driver", results.driver) + fact("Render path", results.renderPath) +
         fact("Machine", results.machine) +
         fact("Ground truth", numberText(results.truthMs / 1000.0) + " s on " +
                                  counted(static_cast<size_t>(std::max(0, results.truthThreads)), "thread")) +
         fact("Date", results.date) + fact("Speculum", results.version) + "</dl>\n</header>\n";
}

std::string frontSection(const SweepResults& results) {
  if (results.points.empty()) {
    return {};
  }
  return "<section aria-labelledby=\"front\">\n<h2 id=\"front\">Error against time</h2>\n"
         "<p>Each mark is one configuration. Bars span the quartiles of the repeats, the thin tick is their minimum. "
         "The "
         "stairs are what each budget of time buys.</p>\n<div class=\"figures\">\n" +
         frontFigures(results) + "</div>\n</section>\n";
}

std::string viewerSection(const SweepResults& results, const std::filesystem::path& folder) {
  if (results.points.empty()) {
    return {};
  }
  const std::string truth =
      results.truthPicture.empty() ? "" : " The reference is <code>" + escapeHtml(results.truthPicture) + "</code>.";
  return "<section aria-labelledby=\"pictures\">\n<h2 id=\"pictures\">Pictures</h2>\n"
         "<p><span class=\"hint\">Drag the divider, or focus it and use the arrow keys.</span> These pictures are JPEG "
         "to keep the report small; "
         "every figure was computed from the lossless PNG files beside <code>results.json</code>, which the captions "
         "name." +
         truth + "</p>\n" + viewerHtml(results, folder) + "</section>\n";
}

std::string seriesSection(const SweepResults& results) {
  const std::string figures = seriesFigures(results);
  if (figures.empty()) {
    return {};
  }
  return "<section aria-labelledby=\"series\">\n<h2 id=\"series\">How the error falls</h2>\n"
         "<p>One setting changes; the names of the points say what the others are. The fit takes the filled marks, "
         "those "
         "above the floor of what else is wrong; the theory’s line starts at the first of them and shows its slope "
         "only.</p>\n"
         "<div class=\"figures\">\n" +
         figures + "</div>\n</section>\n";
}

std::string tableSection(const SweepResults& results) {
  if (results.points.empty()) {
    return {};
  }
  return "<section aria-labelledby=\"all\">\n<h2 id=\"all\">All configurations</h2>\n" + pointTable(results) +
         "</section>\n";
}

std::string term(const std::string& name, const std::string& meaning) {
  return "<dt>" + name + "</dt><dd>" + meaning + "</dd>\n";
}

std::string metricTerms() {
  return "<dl class=\"terms\">\n" +
         term("FLIP",
              "visible difference as the eye sees it when two pictures alternate, 0 to 1, mean over pixels "
              "(Andersson et al. 2020), at 67 pixels a degree") +
         term("RMSE", "root mean square over pixels and channels of the display picture’s linear light, 0 to 1") +
         term("Relative RMSE", "RMSE divided by the root mean square of the reference") +
         term("PSNR", "peak signal to noise ratio of display values, dB; ∞ for equal pictures") +
         term("SSIM", "structural similarity of display values, 1 for equal pictures (Wang et al. 2004)") +
         term("Max, p99",
              "largest difference of any channel, in 1/255: of all pixels, and what 99 % of the pixels do "
              "not exceed") +
         term("Over 2/255", "share of the pixels that differ by more in any channel") +
         term("RMSE, mirrors",
              "the same RMSE over the inside of mirrors: pixels that show a reflecting side, and whose neighbours do") +
         "</dl>\n";
}

std::string timeText(const SweepResults& results) {
  int repeats = 0;
  for (const SweepPoint& point : results.points) {
    repeats = std::max(repeats, costSpread(point).repeats);
  }
  const std::string many = repeats > 0 ? "up to " + counted(static_cast<size_t>(repeats), "repeat") + " each" : "none";
  return "<p><strong>Times.</strong> Medians of repeated frames (" + many +
         "), taken in rounds that go through all configurations in turn, so that a machine that warms up or slows down "
         "does so for all of them alike, and after frames of warm-up that do not count. " +
         (timedOnGpu(results)
              ? "GPU times come from the device’s timestamps; CPU times are the processor’s share of a frame."
              : "The device has no timestamps, so the time of the whole frame stands in for the "
                "GPU’s.") +
         "</p>\n";
}

std::string readingSection(const SweepResults& results) {
  return "<section aria-labelledby=\"reading\">\n<h2 id=\"reading\">How to read this</h2>\n"
         "<p><strong>The front.</strong> A configuration is on the front if it is cheaper than every more accurate "
         "one: by its median, and than those on the front by more than the repeats spread, its upper quartile below "
         "their lower ones. Of equal pictures the one with the fewest changes stands for all, unless another is "
         "clearly cheaper. What is not on the front is dominated: for its price something better exists, or the "
         "difference in time cannot be told from chance.</p>\n"
         "<p><strong>The noise floor.</strong> The ground truth is ray traced in double precision with " +
         counted(static_cast<size_t>(std::max(0, results.truthSamples)), "sample") +
         " a pixel on a regular grid, depth 64. The floor is the error of that against a grid with one more a side. "
         "Errors near it or below say nothing: they are the reference’s own.</p>\n" +
         timeText(results) +
         "<p><strong>Metrics.</strong> Against the ground truth, on the display picture; "
         "where "
         "mirrors are updated every so many frames, means over the phases.</p>\n" +
         metricTerms() +
         "<p><strong>Limits.</strong> One scene, one moment, one size, one machine: the order of configurations can "
         "differ on another. The ray tracer’s time is wall clock on the processor and stands in the plots for scale "
         "only.</p>\n</section>\n";
}

// Settings that are not the program's defaults: a scene or the caller has set them.
std::vector<SettingChange> changedFromDefaults(const SweepResults& results) {
  std::vector<SettingChange> changes;
  for (const SettingChange& setting : results.base) {
    if (settingValue(Settings{}, setting.key) != setting.value) {
      changes.push_back(setting);
    }
  }
  return changes;
}

std::string reproduceSection(const SweepResults& results) {
  const std::string where = " --scene " + shellWord(results.scene) + " --size " + std::to_string(results.width) + "x" +
                            std::to_string(results.height) + " --time " + exactText(results.time);
  const std::string changed = setOptions(changedFromDefaults(results));
  const std::string base = changed.empty() ? "" : " " + changed;
  std::string settings;
  for (const SettingChange& setting : results.base) {
    settings += setting.key + " = " + (setting.value.empty() ? "(the scene's)" : setting.value) + "\n";
  }
  return "<section aria-labelledby=\"again\">\n<h2 id=\"again\">Do it again</h2>\n<p>The sweep:</p>\n<pre>" +
         escapeHtml("speculum accuracy" + where + " --sweep " + shellWord(results.sweep) + base + " --out FOLDER") +
         "</pre>\n<p>One picture, with the settings from the table:</p>\n<pre>" +
         escapeHtml("speculum render" + where + base + " --out picture.png --set …") + "</pre>\n" +
         (settings.empty()
              ? ""
              : "<details><summary>Base settings</summary>\n<pre>" + escapeHtml(settings) + "</pre></details>\n") +
         "</section>\n";
}

}  // namespace

std::string reportHtml(const SweepResults& results, const std::filesystem::path& folder) {
  const std::string title = results.title.empty() ? results.scene : results.title;
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n<title>" +
      escapeHtml(title + " – accuracy sweep") + "</title>\n<style>" + std::string(reportStyle()) +
      "</style>\n</head>\n<body>\n";
  html += header(results) + "<main>\n" + frontSection(results) + viewerSection(results, folder) +
          seriesSection(results) + tableSection(results) + readingSection(results) + reproduceSection(results) +
          "</main>\n<footer>Made by Speculum " + escapeHtml(results.version) + " from <code>results.json</code>" +
          (results.date.empty() ? "" : ", " + escapeHtml(results.date)) + ".</footer>\n";
  return html + "<script>" + std::string(reportScript()) + "</script>\n</body>\n</html>\n";
}

}  // namespace speculum
