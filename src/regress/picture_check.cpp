#include "regress/picture_check.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "compare/image_metrics.hpp"
#include "image/picture_files.hpp"

namespace speculum {

namespace {

struct FlipFigures {
  Plane2d map;
  double mean = 0.0;
  double p99 = 0.0;
};

FlipFigures flipFigures(const Image8& expected, const Image8& actual, const std::vector<bool>& counts) {
  FlipFigures figures{.map = flipMap(comparedImage(expected), comparedImage(actual))};
  std::vector<double> values;
  for (size_t i = 0; i < figures.map.values.size(); ++i) {
    if (counts.empty() || counts[i]) {
      values.push_back(figures.map.values[i]);
      figures.mean += values.back();
    }
  }
  if (!values.empty()) {
    figures.mean /= static_cast<double>(values.size());
    figures.p99 = nearestRank(std::move(values), 0.99);
  }
  return figures;
}

std::vector<bool> countedPixels(const RegressCase& subject, const Image8& picture) {
  if (!subject.mask) {
    return {};
  }
  const PixelMask mask = readNonEmptyMask(*subject.mask);
  if (mask.width != picture.width || mask.height != picture.height) {
    throw std::runtime_error(fmt::format("{}: the mask is {}x{}, the picture {}x{}", subject.mask->string(), mask.width,
                                         mask.height, picture.width, picture.height));
  }
  return {mask.selected.begin(), mask.selected.end()};
}

std::string percent(double share) {
  return fmt::format("{:.3g} %", 100.0 * share);
}

}  // namespace

PictureCheck checkPicture(const Image8& expected, const Image8& actual, const RegressCase& subject) {
  if (expected.width != actual.width || expected.height != actual.height) {
    throw std::runtime_error(fmt::format("the picture is {}x{}, but {} is {}x{}", actual.width, actual.height,
                                         subject.picture.string(), expected.width, expected.height));
  }
  const Tolerance& limits = subject.tolerance;
  const std::vector<bool> counts = countedPixels(subject, actual);
  const int maxDiff = limits.maxDiff.value_or(0);
  PictureCheck check{.agreement = difference(expected, actual, maxDiff, counts)};
  const auto add = [&](OutcomeFigure figure, const std::string& sentence) {
    if (figure.over && !check.problem) {
      check.problem = sentence;
    }
    check.figures.push_back(std::move(figure));
  };
  const PictureAgreement& found = check.agreement;
  const double share = found.share();
  const std::string most = percent(limits.share.value_or(0.0));
  add({fmt::format("pixels over {}/255", maxDiff), percent(share), most, share > limits.share.value_or(0.0)},
      fmt::format("{} of the pixels differ by more than {}/255 (limit {})", percent(share), maxDiff, most));
  const bool blocks = limits.block.value_or(true);
  const std::string at = found.block ? fmt::format("at {}, {}", found.block->x, found.block->y) : "none";
  add({"3x3 block of such pixels", at, blocks ? "not allowed" : "–", blocks && found.block},
      fmt::format("every pixel of the 3x3 block {} differs by more than {}/255", at, maxDiff));
  add({"largest difference", fmt::format("{}/255", found.largest), "–", false}, "");
  // FLIP takes longer than everything else.
  if (limits.flip || limits.flipP99) {
    FlipFigures flip = flipFigures(expected, actual, counts);
    const auto addFlip = [&](const std::string& label, double value, std::optional<double> limit) {
      const std::string text = fmt::format("{:.4f}", value);
      const std::string bound = limit ? fmt::format("{:.4g}", *limit) : "–";
      add({label, text, bound, limit && value > *limit}, fmt::format("{} is {} (limit {})", label, text, bound));
    };
    addFlip("mean FLIP", flip.mean, limits.flip);
    addFlip("FLIP, 99th percentile", flip.p99, limits.flipP99);
    check.flip = std::move(flip.map);
  }
  return check;
}

CaseFiles::CaseFiles(const std::filesystem::path& folder, const std::string& name)
    : expected(folder / (name + ".expected.png")),
      actual(folder / (name + ".actual.png")),
      difference(folder / (name + ".difference.png")),
      flip(folder / (name + ".flip.png")) {}

void judge(const Image8& expected, const Image8& actual, const RegressCase& subject, const CaseFiles& files,
           Outcome& outcome) {
  const PictureCheck check = checkPicture(expected, actual, subject);
  outcome.figures.insert(outcome.figures.end(), check.figures.begin(), check.figures.end());
  if (check.problem && outcome.verdict == Verdict::passed) {
    outcome.verdict = Verdict::failed;
    outcome.message = *check.problem;
    outcome.replaceable = true;
  }
  if (outcome.verdict == Verdict::passed) {
    return;
  }
  if (const auto region = largestGroup(check.agreement, actual.width)) {
    outcome.region = {region->x, region->y, region->width, region->height};
  }
  // Makes small differences visible too: a tint of 2/255 as well as a missing light.
  outcome.gain = std::max(20.0, std::floor(200.0 / std::max(1, check.agreement.largest)));
  writePng(files.expected, expected);
  writePng(files.actual, actual);
  writePng(files.difference, differencePicture(expected, actual, check.agreement, outcome.gain));
  writePng(files.flip, heatColors(check.flip ? *check.flip : flipMap(comparedImage(expected), comparedImage(actual))));
  outcome.hasFiles = true;
}

void applyExpectation(const ExpectedCase& expected, Outcome& outcome) {
  if (expected.result != ExpectedResult::fail || outcome.verdict == Verdict::error) {
    return;
  }
  outcome.replaceable = false;
  if (outcome.verdict == Verdict::failed) {
    outcome.verdict = Verdict::passed;
    outcome.message = "fails as expected: " + expected.reason;
  } else {
    outcome.verdict = Verdict::failed;
    outcome.message = "passes, but is expected to fail: " + expected.reason;
  }
}

}  // namespace speculum
