#include "picture_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace speculum::testing_support {

namespace {

int pixelDifference(const uint8_t* a, const uint8_t* b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

bool anyBlock(const std::vector<bool>& over, int width, int height) {
  for (int y = 0; y + 3 <= height; ++y) {
    for (int x = 0; x + 3 <= width; ++x) {
      bool all = true;
      for (int i = 0; i < 9 && all; ++i) {
        all = over[static_cast<size_t>(y + i / 3) * width + x + i % 3];
      }
      if (all) {
        return true;
      }
    }
  }
  return false;
}

void writeEvidence(const Image8& actual, const Image8& expected, const std::string& name) {
  const std::filesystem::path directory = std::filesystem::path(SPECULUM_BINARY_DIR) / "tests" / "failed";
  std::filesystem::create_directories(directory);
  Image8 shown(actual.width, actual.height);
  for (size_t i = 0; i < shown.rgba.size(); ++i) {
    shown.rgba[i] =
        i % 4 == 3 ? 255 : static_cast<uint8_t>(std::min(255, 20 * std::abs(actual.rgba[i] - expected.rgba[i])));
  }
  writePng(directory / (name + "-actual.png"), actual);
  writePng(directory / (name + "-expected.png"), expected);
  writePng(directory / (name + "-difference.png"), shown);
  std::printf("see %s/%s-{actual,expected,difference}.png\n", directory.c_str(), name.c_str());
}

}  // namespace

Difference difference(const Image8& a, const Image8& b, int tolerance, const std::vector<bool>& counts) {
  Difference result;
  const size_t pixels = static_cast<size_t>(a.width) * a.height;
  std::vector<bool> over(pixels, false);
  size_t overCount = 0;
  for (size_t i = 0; i < pixels; ++i) {
    if (!counts.empty() && !counts[i]) {
      continue;
    }
    const int d = pixelDifference(&a.rgba[4 * i], &b.rgba[4 * i]);
    ++result.counted;
    result.largest = std::max(result.largest, d);
    over[i] = d > tolerance;
    overCount += over[i] ? 1 : 0;
  }
  result.shareOver = result.counted ? static_cast<double>(overCount) / static_cast<double>(result.counted) : 0.0;
  result.blockOver = anyBlock(over, a.width, a.height);
  return result;
}

void expectAlike(const Image8& actual, const Image8& expected, int tolerance, const std::string& name,
                 const std::vector<bool>& counts) {
  ASSERT_EQ(actual.width, expected.width) << name;
  ASSERT_EQ(actual.height, expected.height) << name;
  const Difference d = difference(actual, expected, tolerance, counts);
  EXPECT_LE(d.shareOver, 0.001) << name << ": largest difference " << d.largest << "/255";
  EXPECT_FALSE(d.blockOver) << name << ": a 3x3 block is wholly over " << tolerance << "/255";
  if (d.shareOver > 0.001 || d.blockOver) {
    writeEvidence(actual, expected, name);
  }
}

std::filesystem::path sourceFile(const std::string& relative) {
  return std::filesystem::path(SPECULUM_SOURCE_DIR) / relative;
}

Options headless(const std::filesystem::path& scene, PictureSize size) {
  Options options;
  options.scene = scene.string();
  options.size = size;
  options.validation = true;
  return options;
}

Image8 draw(const Options& options, double time) {
  Session session(options);
  session.draw(time, true);
  Image8 picture = session.picture();
  EXPECT_EQ(session.device().validationMessages(), 0) << options.scene;
  return picture;
}

std::filesystem::path writeScene(const std::string& name, const std::string& toml) {
  const std::filesystem::path directory = std::filesystem::path(testing::TempDir()) / "speculum_scenes";
  std::filesystem::create_directories(directory);
  const std::filesystem::path file = directory / (name + ".toml");
  std::string text = toml;
  const std::string models = sourceFile("models").string() + "/";
  for (size_t at = text.find("MODELS/"); at != std::string::npos; at = text.find("MODELS/", at)) {
    text.replace(at, 7, models);
  }
  std::ofstream(file) << text;
  return file;
}

}  // namespace speculum::testing_support
