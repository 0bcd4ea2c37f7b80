#include "truth_support.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "image/color.hpp"

namespace speculum::testing_support {

namespace {

constexpr int tolerance = 2;  // in 1/255

}  // namespace

Truth trace(const std::filesystem::path& file, PictureSize size, int maxDepth, double time) {
  const Scene scene = loadScene(file);
  const Settings settings = settingsOf(scene);
  const RayTracer tracer(scene, evaluate(scene, time));
  Truth truth;
  truth.traced = *tracer.render({.width = size.width,
                                 .height = size.height,
                                 .samples = 1,
                                 .maxDepth = maxDepth,
                                 .minThroughput = settings.reflection.minThroughput,
                                 .clearColor = settings.view.clearColor});
  truth.picture = toDisplay(truth.traced.image, settings.view.exposure, settings.view.toneMap);
  return truth;
}

std::vector<std::pair<std::string, std::string>> truthSettings(int maxDepth) {
  return {{"view.samples", "1"},
          {"reflection.samples", "1"},
          {"reflection.max_depth", std::to_string(maxDepth)},
          {"reflection.max_passes", "100000"},
          {"reflection.min_pixels", "0"},
          {"effects.shadow_lookup", "traced"}};
}

Options truthOptions(const std::filesystem::path& file, PictureSize size, int maxDepth) {
  Options options = headless(file, size);
  set(options, truthSettings(maxDepth));
  return options;
}

void expectTruth(const std::filesystem::path& file, PictureSize size, int maxDepth, const Truth& truth, double time) {
  expectAlike(draw(truthOptions(file, size, maxDepth), time), truth.picture, tolerance, "truth_" + file.stem().string(),
              notBackground(truth.traced));
}

void expectTruths(const std::vector<std::filesystem::path>& files, PictureSize size, int maxDepth) {
  const Options options = truthOptions(files.front(), size, maxDepth);
  Gpu gpu(options);
  Studio studio(gpu, options);
  for (const std::filesystem::path& file : files) {
    expectTruth(studio, file, trace(file, size, maxDepth));
  }
}

void expectTruth(Studio& studio, const std::filesystem::path& file, const Truth& truth, double time) {
  studio.show(loadScene(file));
  studio.time = time;
  expectAlike(studio.fresh(), truth.picture, tolerance, "truth_" + file.stem().string(), notBackground(truth.traced));
}

std::vector<bool> notBackground(const TraceResult& traced) {
  std::vector<bool> counts;
  for (const uint8_t background : traced.backgroundMask) {
    counts.push_back(background == 0);
  }
  return counts;
}

double share(const std::vector<uint8_t>& values, int atLeast) {
  const auto count = std::count_if(values.begin(), values.end(), [&](uint8_t v) { return v >= atLeast; });
  return static_cast<double>(count) / static_cast<double>(values.size());
}

}  // namespace speculum::testing_support
