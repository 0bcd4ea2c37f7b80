// Mirrors that meet each other and walls.
#include "random.hpp"
#include "sampling.hpp"
#include "scene_text.hpp"
#include "truth_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

// On a column of pixel centres two mirrors that meet there tie, which the traced picture cannot settle either. The
// walls meet at the dihedral angle on x = 0, which a picture of odd width sees through the middle of its pixels.
TEST(SeamOnPixelCentres, ChangesNoOtherColumn) {
  constexpr PictureSize size{81, 61};
  std::optional<Studio> studio;
  for (const double degrees : {180.0 / 2, 180.0 / 3, 180.0 / 4, 180.0 / 5, 75.0, 120.0, 135.0, 170.0}) {
    const double half = 0.5 * degrees * std::numbers::pi / 180.0;
    const glm::dvec3 far(4.0 * std::sin(half), 0.0, 4.0 * std::cos(half) - 1.0);
    std::string text = "[environment]\nambient = [0.3, 0.3, 0.3]\nbackground = [1, 0, 1]\n" +
                       cameraText({0, 1, 4}, {0, 1, 0}) + "[[light]]\nposition = [1, 3, 3]\nintensity = 10\n";
    for (const glm::dvec3& position : {glm::dvec3(0.7, 0.6, 1), glm::dvec3(0, 1.2, 6), glm::dvec3(-2, 1.2, 1)}) {
      text += objectText("MODELS/sphere.obj", position, {0, 0, 0}, 0.6, glm::abs(position) / 6.0);
    }
    const auto wall = [](const glm::dvec3& from, const glm::dvec3& to) {
      const glm::dvec3 down(0, -2, 0);
      const glm::dvec3 up(0, 4, 0);
      return "[[mirror]]\n" + polygonText({from + down, to + down, to + up, from + up});
    };
    text += wall({-far.x, 0, far.z}, {0, 0, -1}) + wall({0, 0, -1}, far);
    const auto file = writeScene("corner" + std::to_string(static_cast<int>(degrees)), text);
    const Truth truth = trace(file, size, 8);
    if (!studio) {
      studio.emplace(truthOptions(file, size, 8));
    }
    studio->show(loadScene(file));
    const Image8 picture = studio->fresh();
    std::vector<bool> besideTheSeam;
    for (int i = 0; i < size.width * size.height; ++i) {
      besideTheSeam.push_back(i % size.width != size.width / 2);
    }
    EXPECT_LE(difference(picture, truth.picture, 2, besideTheSeam).over, 5)
        << degrees << " degrees, of " << size.width * size.height;
    // On that column either mirror may show its image, nothing else.
    EXPECT_LE(difference(picture, truth.tracing.nearest(picture), 2).over, 5) << degrees << " degrees";
  }
}

// Two walls of a closed room are mirrors. Their images have nothing behind the other walls, where lookups that mix
// texels would find the red background.
TEST(SeamsOfCoarseImages, ShowNoBackground) {
  constexpr PictureSize size{160, 100};
  writeModel("shell.obj",
             "v -2 -1 -2\nv 2 -1 -2\nv 2 -1 2\nv -2 -1 2\nv -2 2 -2\nv 2 2 -2\nv 2 2 2\nv -2 2 2\n"
             "f 4 3 2 1\nf 5 6 7 8\nf 2 3 7 6\nf 3 4 8 7\n");
  Random random(1);
  std::optional<Studio> studio;
  for (int i = 0; i < (fullTests() ? 40 : 6); ++i) {
    const glm::dvec3 eye(random.uniform(-1, 1.5), random.uniform(-0.5, 1.5), random.uniform(-1, 1.5));
    const std::string text =
        "[environment]\nbackground = [9, 0, 0]\nambient = [1, 1, 1]\n" +
        cameraText(eye, {-1.9, random.uniform(-0.5, 1.5), -1.9}, {random.uniform(-0.5, 0.5), 1, 0}) +
        objectText("shell.obj", {0, 0, 0}, {0, 0, 0}, 1.0, {0.1, 0.5, 0.2}) + "[[mirror]]\n" +
        polygonText({{-2, -1, 2}, {-2, -1, -2}, {-2, 2, -2}, {-2, 2, 2}}) + "[[mirror]]\n" +
        polygonText({{-2, -1, -2}, {2, -1, -2}, {2, 2, -2}, {-2, 2, -2}});
    const auto file = writeScene("room" + std::to_string(i), text);
    if (!studio) {
      studio.emplace(truthOptions(file, size, 3));
    }
    studio->show(loadScene(file));
    for (const auto& [scale, samples, imageSamples] :
         {std::tuple(0.5, 1, 1), std::tuple(0.3, 4, 4), std::tuple(0.77, 4, 1), std::tuple(1.7, 1, 1),
          std::tuple(1.0, 4, 1), std::tuple(1.0, 1, 4)}) {
      studio->settings.reflection.scale = scale;
      studio->settings.view.samples = samples;
      studio->settings.reflection.samples = imageSamples;
      const Image8 picture = studio->fresh();
      int red = 0;
      for (size_t at = 0; at < picture.rgba.size(); at += 4) {
        red += picture.rgba[at] > picture.rgba[at + 1] ? 1 : 0;
      }
      EXPECT_LE(red, size.width * size.height / 1000)
          << "scale " << scale << ", samples " << samples << " and " << imageSamples << ", seed " << i;
    }
  }
}

}  // namespace
}  // namespace speculum
