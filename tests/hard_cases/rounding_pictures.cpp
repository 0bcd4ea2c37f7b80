// Rounding to the 16-bit floats of targets: no mean of pictures is darker or brighter for it, whatever the device does
// when it stores a float.
#include "image/image.hpp"
#include "reference/ray_tracer.hpp"
#include "sampling.hpp"
#include "scene_text.hpp"
#include "studio.hpp"
#include "test_headers.hpp"

namespace speculum::rounding_pictures {
namespace {

using namespace testing_support;

const PictureSize size = fullTests() ? PictureSize{96, 54} : PictureSize{64, 36};
constexpr int mirrorsDeep = 5;

// Returns the mean of actual - expected over all pixels and channels, in steps of 8 bits before they are rounded.
double signedError(const LinearImage& actual, const LinearImage& expected) {
  const auto steps = [](float value) { return 255.0 * srgbEncode(std::min(static_cast<double>(value), 1.0)); };
  double sum = 0.0;
  for (size_t i = 0; i < actual.pixels.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      sum += steps(actual.pixels[i][channel]) - steps(expected.pixels[i][channel]);
    }
  }
  return sum / (3.0 * static_cast<double>(actual.pixels.size()));
}

// Pictures of plain scenes, and their signed errors against the tracer's same samples.
class UnbiasedPictures : public testing::Test {
 protected:
  UnbiasedPictures() { writeQuad(); }

  // Expects the error to be small, and keeps it in the report of the tests.
  static void expectUnbiased(double error, const auto& name) {
    std::ostringstream key;
    key << "signed_error_" << name;
    RecordProperty(key.str(), std::to_string(error));
    EXPECT_NEAR(error, 0.0, 0.05) << key.str();
  }

  double error(const std::string& toml, const SettingList& settings) {
    Options options = headless(writeScene("plain", toml), size, settings);
    set(options, {{"reflection.max_depth", std::to_string(mirrorsDeep)},
                  {"reflection.min_throughput", "0"},
                  {"reflection.min_pixels", "0"}});
    QuietSession session(options);
    session.draw(0.0, true);
    const TraceOptions traced{
        .width = size.width, .height = size.height, .maxDepth = mirrorsDeep, .minThroughput = 0.0};
    const SceneState state = evaluate(session.scene(), 0.0);
    return signedError(session.radiance(), RayTracer(session.scene(), state).render(traced)->image);
  }
};

TEST_F(UnbiasedPictures, MeanOfFlatColorsFiveMirrorsDeep) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    expectUnbiased(error(plainScene(seed, PlainMirrors::facing), {{"view.accumulate", "64"}}), seed);
  }
}

TEST_F(UnbiasedPictures, MeanOfMultisampledPictures) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    expectUnbiased(error(plainScene(seed, PlainMirrors::facing), {{"view.accumulate", "8"}}), seed);
  }
}

// The device adds the reflection to a base that another draw has stored in the target: at several samples a pixel, or
// with rays.
TEST_F(UnbiasedPictures, ReflectionsAddedToABase) {
  for (const auto& [pictures, shadows] : {std::pair("8", "map"), std::pair("8", "traced"), std::pair("16", "traced")}) {
    double sum = 0.0;
    for (unsigned seed = 0; seed < 3; ++seed) {
      sum += error(plainScene(seed, PlainMirrors::facing, "base_color = [0.2, 0.3, 0.4]\n") +
                       "[[light]]\nposition = [3, 9, 0.2]\nintensity = 3\ncasts_shadow = true\n",
                   {{"view.accumulate", pictures}, {"effects.shadow_lookup", shadows}});
    }
    expectUnbiased(sum / 3.0, std::string(pictures) + shadows);
  }
}

}  // namespace
}  // namespace speculum::rounding_pictures
