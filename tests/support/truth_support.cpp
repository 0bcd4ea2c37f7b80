#include "truth_support.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

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

Options truthOptions(const std::filesystem::path& file, PictureSize size, int maxDepth) {
  Options options = headless(file, size);
  set(options, {{"view.samples", "1"},
                {"reflection.samples", "1"},
                {"reflection.max_depth", std::to_string(maxDepth)},
                {"reflection.max_passes", "100000"},
                {"reflection.min_pixels", "0"}});
  return options;
}

void expectTruth(const std::filesystem::path& file, PictureSize size, int maxDepth, const Truth& truth, double time) {
  expectAlike(draw(truthOptions(file, size, maxDepth), time), truth.picture, tolerance, "truth_" + file.stem().string(),
              notBackground(truth.traced));
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

std::string Random::vec(double low, double high) {
  std::ostringstream out;
  out << "[" << uniform(low, high) << ", " << uniform(low, high) << ", " << uniform(low, high) << "]";
  return out.str();
}

std::string writeRandomMesh(unsigned seed) {
  Random random(seed + 1000);
  const std::filesystem::path file = sceneDirectory() / ("lump_" + std::to_string(seed) + ".obj");
  std::ofstream out(file);
  out << "# no material library\n";
  constexpr int rings = 14;
  constexpr int sectors = 20;
  const double waves = std::floor(random.uniform(1, 6));
  const double depth = random.uniform(0.05, 0.35);
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      const double theta = 3.14159265358979 * i / rings;
      const double phi = 2.0 * 3.14159265358979 * j / sectors;
      const double r = 0.5 + depth * std::sin(waves * theta) * std::cos(waves * phi);
      out << "v " << r * std::sin(theta) * std::cos(phi) << ' ' << r * std::cos(theta) << ' '
          << r * std::sin(theta) * std::sin(phi) << '\n';
      out << "vn " << std::sin(theta) * std::cos(phi) << ' ' << std::cos(theta) << ' '
          << std::sin(theta) * std::sin(phi) << '\n';
    }
  }
  const auto corner = [&](int i, int j) {
    const std::string index = std::to_string(i * sectors + j % sectors + 1);
    return seed % 2 == 0 ? index + "//" + index : index;
  };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      out << "f " << corner(i, j) << ' ' << corner(i, j + 1) << ' ' << corner(i + 1, j + 1) << ' ' << corner(i + 1, j)
          << '\n';
    }
  }
  return file.string();
}

}  // namespace speculum::testing_support
