#include <nlohmann/json.hpp>

#include "accuracy/sweep_json.hpp"
#include "cli/commands.hpp"
#include "cli/stats.hpp"
#include "compare/compared_image.hpp"
#include "compare/image_metrics.hpp"
#include "compare/picture_agreement.hpp"
#include "image/picture_files.hpp"
#include "platform/text.hpp"

namespace speculum {

namespace {

// Lists the measures that exceed the given limits; empty if none does.
std::string exceeded(const ImageMetrics& metrics, const Options& options) {
  std::string text;
  if (options.compare.maxFlip && metrics.flip > *options.compare.maxFlip) {
    text += "FLIP " + std::to_string(metrics.flip) + " is above --max-flip " +
            std::to_string(*options.compare.maxFlip) + ". ";
  }
  if (options.compare.maxDiff && metrics.maxDiff > *options.compare.maxDiff) {
    text += std::to_string(metrics.pixelsOver) + " pixels differ by more than --max-diff " +
            std::to_string(*options.compare.maxDiff) + ".";
  }
  return text;
}

}  // namespace

int runCompare(const Options& options) {
  if (options.compare.heatmap.has_extension() && options.compare.heatmap.extension() != ".png") {
    throw UsageError("--heatmap: '" + options.compare.heatmap.string() + "' must end in .png (the heat map is a PNG)");
  }
  const ComparedImage reference = readComparedImage(options.compare.reference);
  const ComparedImage test = readComparedImage(options.compare.test);
  std::optional<PixelMask> mask;
  if (!options.compare.mask.empty()) {
    mask = readNonEmptyMask(options.compare.mask);
  }
  const double tolerance = options.compare.maxDiff.value_or(2);
  const Comparison comparison =
      compareImages(reference, test, {.tolerance = tolerance, .mask = mask ? &*mask : nullptr});
  std::fputs(comparisonTable(comparison, tolerance).c_str(), besideOutput(options.json));
  if (!options.json.empty()) {
    writeJson(options.json, comparisonJson(comparison));
  }
  if (!options.compare.heatmap.empty()) {
    writePng(options.compare.heatmap, heatMap(comparison.flip));
  }
  const std::string problem = exceeded(comparison.masked.value_or(comparison.whole), options);
  if (!problem.empty()) {
    printLine(problem, stderr);
  }
  return problem.empty() ? 0 : 1;
}

}  // namespace speculum
