// Two mirrors that meet on a column of pixel centres: a tie there, which the traced picture cannot settle either.
#include "scene_text.hpp"
#include "truth_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

// Walls that meet at the dihedral angle on x = 0, which a picture of odd width sees through the middle of its pixels.
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

}  // namespace
}  // namespace speculum
