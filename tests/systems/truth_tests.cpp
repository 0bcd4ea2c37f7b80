// The rasteriser against the ray tracer, which shares no drawing code with it: one sample each, every pixel that is not
// background.
#include "image/image.hpp"
#include "sampling.hpp"
#include "scene_text.hpp"
#include "shaders/gpu_data.h"
#include "truth_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class SceneTruth : public testing::TestWithParam<std::string> {};

TEST_P(SceneTruth, IsDrawn) {
  const std::filesystem::path file = sceneFile(GetParam());
  // In a smaller picture, silhouettes of the pool's ripples take too large a share of the pixels.
  const bool large = fullTests() || GetParam() == "pool";
  const PictureSize size = large ? PictureSize{640, 360} : PictureSize{240, 135};
  expectTruth(file, size, 4, trace(file, size, 4));
}

std::string nameOf(const testing::TestParamInfo<std::string>& info) {
  return std::filesystem::path(info.param).filename();
}

// Without the rough one, whose rays are random: accumulated_pictures.cpp compares its mean.
std::vector<std::string> smoothScenes() {
  std::vector<std::string> names = sceneNames();
  std::erase(names, "rough");
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneTruth, testing::ValuesIn(smoothScenes()), nameOf);
INSTANTIATE_TEST_SUITE_P(HardScenes, SceneTruth, testing::ValuesIn(sceneNames("hard/")), nameOf);

// Edges may lie anywhere within 1/256 pixel, and no farther.
TEST(Tracing, NearestAllowsPartsOfAPixel) {
  const Truth truth = trace(sceneFile("facing_mirrors"), {160, 90}, 4);
  const auto moved = [&](double x, double y) {
    return toDisplay(truth.tracing.result({x, y}).image, truth.tracing.curve);
  };
  const auto differing = [](const Image8& a, const Image8& b) { return difference(a, b, 2).over; };
  const Image8 little = moved(1.0 / 256.0, -1.0 / 256.0);
  EXPECT_GT(differing(little, truth.picture), 5);
  EXPECT_EQ(differing(little, truth.tracing.nearest(little)), 0);
  for (const glm::dvec2 far : {glm::dvec2(1.0 / 16.0, 0.0), glm::dvec2(0.0, -1.0 / 16.0)}) {
    const Image8 picture = moved(far.x, far.y);
    EXPECT_GT(differing(picture, truth.tracing.nearest(picture)), differing(picture, truth.picture) / 2);
  }
}

TEST(ObjectFields, EmissionReplacesTheMaterials) {
  const std::filesystem::path file = writeScene("emission", R"(
[camera] position = [0, 0, 4], target = [0, 0, 0]
[[object]] model = "MODELS/sphere.obj", color = [0, 0, 0], specular = [0, 0, 0], emission = [0.25, 0.5, 1]
[[mirror]] position = [0, 0, -2], size = [6, 6]
)");
  constexpr PictureSize size{160, 90};
  const Truth truth = trace(file, size, 1);
  expectTruth(file, size, 1, truth);
  const uint8_t* middle = &truth.picture.rgba[4 * (45 * 160 + 80)];
  EXPECT_NEAR(middle[0], 137, 1);
  EXPECT_NEAR(middle[1], 188, 1);
  EXPECT_EQ(middle[2], 255);
}

// Objects of one mesh share a draw only if they look alike and have the same handedness; lights are read at fixed
// addresses up to a number, and in a loop above it.
class LookAlikes : public testing::TestWithParam<int> {};

TEST_P(LookAlikes, AreDrawnWithTheirOwnColors) {
  std::ostringstream out;
  out << "[environment]\nambient = [0.05, 0.05, 0.05]\n[camera]\nposition = [0, 1, 6]\ntarget = [0, 0.3, 0]\n"
      << "[[mirror]]\nposition = [0, 0, -3]\nsize = [12, 8]\nbase_color = [0.1, 0.2, 0.1]\n";
  const std::vector<std::string> looks = {"",
                                          "scale = [-1, 1, 1]",
                                          "color = [0.8, 0.1, 0.1]",
                                          "color = [0.8, 0.1, 0.1]\nscale = [-1, 1, 1]",
                                          "specular = [0.4, 0.4, 0.1]\nshininess = 9",
                                          "specular = [0, 0, 0]",
                                          "emission = [0.1, 0, 0.3]",
                                          "",
                                          "shininess = 3"};
  for (size_t i = 0; i < looks.size(); ++i) {
    out << "[[object]]\nmodel = \"MODELS/" << (i % 2 == 0 ? "pedestal" : "teapot") << ".obj\"\nposition = ["
        << 0.7 * static_cast<double>(i) - 2.8 << ", -0.5, " << (i % 3) << "]\n"
        << looks[i] << "\n";
    out << "[[object]]\nmodel = \"MODELS/" << (i % 2 == 0 ? "teapot" : "pedestal") << ".obj\"\nposition = ["
        << 0.7 * static_cast<double>(i) - 2.8 << ", 1, " << (i % 3) - 1.0 << "]\n"
        << looks[i] << "\n";
  }
  for (int i = 0; i < GetParam(); ++i) {
    out << "[[light]]\nposition = [" << 3.0 * std::cos(i) << ", " << 2.5 + 0.1 * i << ", " << 3.0 * std::sin(i)
        << "]\nintensity = " << 0.5 + 0.1 * i << "\n";
  }
  const std::filesystem::path file = writeScene("look_alikes_" + std::to_string(GetParam()), out.str());
  constexpr PictureSize size{160, 90};
  expectTruth(file, size, 1, trace(file, size, 1));
}

INSTANTIATE_TEST_SUITE_P(Lights, LookAlikes, testing::Values(int{gpu::fixedLights}, int{gpu::fixedLights} + 1));

}  // namespace
}  // namespace speculum
