#include "picture_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "driver.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"
#include "test_paths.hpp"

namespace speculum::testing_support {

namespace {

void writeEvidence(const Image8& actual, const Image8& expected, const std::string& name) {
  const std::filesystem::path directory = binaryDir() / "tests" / "failed";
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

PictureAgreement difference(const Image8& a, const Image8& b, int tolerance, const std::vector<bool>& counts) {
  std::vector<uint8_t> exclude;
  for (const bool counted : counts) {
    exclude.push_back(counted ? 0 : 1);
  }
  return pictureAgreement(a, b, tolerance, exclude);
}

void expectAlike(const Image8& actual, const Image8& expected, int tolerance, const std::string& name,
                 const std::vector<bool>& counts) {
  const PictureAgreement d = difference(actual, expected, tolerance, counts);
  EXPECT_GE(d.fractionWithin(), 0.999) << name << ": largest difference " << d.largest << "/255";
  EXPECT_FALSE(d.solidBlock) << name << ": wholly over " << tolerance << "/255 at " << d.blockX << ", " << d.blockY;
  if (!d.holds(0.999)) {
    writeEvidence(actual, expected, name);
  }
}

std::filesystem::path sourceFile(const std::string& relative) {
  return sourceDir() / relative;
}

Options headless(const std::filesystem::path& scene, PictureSize size) {
  keepDriverLoaded();
  Options options;
  options.scene = scene.string();
  options.size = size;
  options.validation = true;
  options.settings = {{"debug.check_finite", "true"}};
  return options;
}

void set(Options& options, const std::vector<std::pair<std::string, std::string>>& settings) {
  options.settings.insert(options.settings.end(), settings.begin(), settings.end());
}

void expectQuiet(Session& session) {
  session.finish();
  EXPECT_EQ(session.device().validationMessages(), 0) << session.scene().file;
  const FiniteWatch& watch = session.sceneRenderer().finiteWatch();
  EXPECT_EQ(watch.count(), 0u) << session.scene().file << ": " << describe(watch.findings().front());
}

Image8 draw(const Options& options, double time) {
  Session session(options);
  session.draw(time, true);
  Image8 picture = session.picture();
  expectQuiet(session);
  return picture;
}

std::vector<bool> blackPixels(const Image8& image) {
  std::vector<bool> mask;
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    mask.push_back(image.rgba[i] == 0 && image.rgba[i + 1] == 0 && image.rgba[i + 2] == 0);
  }
  return mask;
}

// Empty at a test's first call: what an earlier run left is not found. Not called scenes: the programs beside it would
// take it for the folder that they come with.
std::filesystem::path sceneDirectory() {
  static std::filesystem::path made;
  std::filesystem::path directory = binaryDir() / "tests" / "written";
  if (const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info()) {
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    std::replace(name.begin(), name.end(), '/', '_');
    directory /= name;
    if (std::exchange(made, directory) != directory) {
      std::filesystem::remove_all(directory);
    }
  }
  std::filesystem::create_directories(directory);
  return directory;
}

std::filesystem::path writeScene(const std::string& name, const std::string& toml) {
  const std::filesystem::path file = sceneDirectory() / (name + ".toml");
  std::string text = toml;
  const std::string models = sourceFile("models").string() + "/";
  for (size_t at = text.find("MODELS/"); at != std::string::npos; at = text.find("MODELS/", at)) {
    text.replace(at, 7, models);
  }
  std::ofstream(file) << text;
  return file;
}

void writeShaders(const std::filesystem::path& directory, const std::string& shader, const std::string& code) {
  for (const auto& entry : std::filesystem::directory_iterator(sourceFile("shaders"))) {
    std::filesystem::copy_file(entry.path(), directory / entry.path().filename());
  }
  const std::vector<uint8_t> content = readFile(directory / shader);
  std::string text(content.begin(), content.end());
  text.insert(text.rfind('}'), code);
  std::ofstream(directory / shader) << text;
}

}  // namespace speculum::testing_support
