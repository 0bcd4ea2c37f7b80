// Images of several mirrors in one frame: overlapping, nested, many; what they cost in memory; what guards them.
#include <gtest/gtest.h>

#include <algorithm>

#include "picture_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr PictureSize size{320, 180};

const std::string room = R"(
[environment]
sky = { zenith = [0.1, 0.2, 0.9], horizon = [0.9, 0.8, 0.3], ground = [0.2, 0.5, 0.1] }
ambient = [0.2, 0.2, 0.2]
[camera]
position = [0, 1, 5]
target = [0, 1, 0]
[settings]
"view.samples" = 1
"reflection.samples" = 1
[[object]]
model = "MODELS/teapot.obj"
position = [-1.2, 0.3, 6.5]
[[object]]
model = "MODELS/torus_knot.obj"
position = [1.2, 1, 7]
scale = 0.6
[[light]]
position = [0, 3, 5]
intensity = 20
)";

std::string mirror(const std::string& name, const std::string& rest) {
  return "[[mirror]]\nname = \"" + name + "\"\n" + rest + "\n";
}

// One behind the other on the screen, both towards the eye; neither sees the other.
const std::string left = mirror("left", "position = [-0.5, 1, 0]\nrotation = [0, 8, 0]\nsize = [2, 1.6]");
const std::string right = mirror("right", "position = [0.5, 1.2, -1]\nrotation = [0, -6, 0]\nsize = [2.4, 1.6]");
const std::string leftBlack =
    mirror("left", "position = [-0.5, 1, 0]\nrotation = [0, 8, 0]\nsize = [2, 1.6]\nreflectance = [0, 0, 0]");
const std::string rightBlack =
    mirror("right", "position = [0.5, 1.2, -1]\nrotation = [0, -6, 0]\nsize = [2.4, 1.6]\nreflectance = [0, 0, 0]");

Image8 drawText(const std::string& name, const std::string& text) {
  return draw(headless(writeScene(name, text), size));
}

std::vector<bool> black(const Image8& image) {
  std::vector<bool> mask;
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    mask.push_back(image.rgba[i] == 0 && image.rgba[i + 1] == 0 && image.rgba[i + 2] == 0);
  }
  return mask;
}

// Where one mirror is seen, the picture with both is the picture with the other one black.
void expectIndependent(const std::string& name, const std::string& before, const std::string& after) {
  const Image8 both = drawText(name, before + left + right + after);
  const Image8 leftOnly = drawText(name + "_l", before + left + rightBlack + after);
  const Image8 rightOnly = drawText(name + "_r", before + leftBlack + right + after);
  const std::vector<bool> leftMask = black(rightOnly);
  const std::vector<bool> rightMask = black(leftOnly);
  ASSERT_GT(std::count(leftMask.begin(), leftMask.end(), true), 200);
  ASSERT_GT(std::count(rightMask.begin(), rightMask.end(), true), 200);
  EXPECT_EQ(difference(both, leftOnly, 0, leftMask).largest, 0);
  EXPECT_EQ(difference(both, rightOnly, 0, rightMask).largest, 0);
}

TEST(MirrorPictures, OverlappingMirrorsHaveImagesOfTheirOwn) {
  expectIndependent("overlap", room, "");
}

TEST(MirrorPictures, OverlappingMirrorsSeenInAMirrorHaveImagesOfTheirOwn) {
  // The camera looks the other way, into a large mirror that shows the two.
  std::string turned = room;
  turned.replace(turned.find("target = [0, 1, 0]"), 18, "target = [0, 1, 9]");
  const std::string behind = mirror("big", "position = [0, 1, 9]\nrotation = [0, 180, 0]\nsize = [12, 8]");
  expectIndependent("nested_overlap", turned, behind);
}

TEST(MirrorPictures, ManyMirrorsStayWithinTheirMemory) {
  Options options = headless(sourceFile("scenes/many_mirrors.toml"), {1280, 720});
  options.settings = {{"reflection.max_depth", "4"}, {"reflection.samples", "4"}, {"view.samples", "4"}};
  Session session(options);
  session.draw(0.0, false);
  session.draw(1.0, false);
  session.renderer().waitIdle();
  EXPECT_LT(session.device().allocatedBytes(), 512u << 20);
  EXPECT_EQ(session.device().validationMessages(), 0);
}

TEST(MirrorPictures, MovingFramesKeepTheirMemory) {
  Session session(headless(sourceFile("scenes/many_mirrors.toml"), size));
  for (int i = 0; i < 40; ++i) {
    session.draw(0.1 * i, false);
  }
  session.renderer().waitIdle();
  const uint64_t before = session.device().allocatedBytes();
  for (int i = 0; i < 80; ++i) {
    session.draw(0.1 * (i % 40), false);
  }
  session.renderer().waitIdle();
  EXPECT_LT(static_cast<double>(session.device().allocatedBytes()), 1.2 * static_cast<double>(before));
  EXPECT_EQ(session.device().validationMessages(), 0);
}

TEST(MirrorPictures, TurningAwayGivesTheMirrorsMemoryBack) {
  std::string turned = room;
  turned.replace(turned.find("target = [0, 1, 0]"), 18, "target = [0, 1, 9]");
  Session with(headless(writeScene("away", turned + left + right), size));
  Session without(headless(writeScene("no_mirrors", turned), size));
  for (Session* session : {&with, &without}) {
    session->draw(0.0, true);
    session->renderer().waitIdle();
  }
  EXPECT_TRUE(with.lastFrame().plan.passes.empty());
  EXPECT_EQ(with.picture().rgba, without.picture().rgba);
  EXPECT_LE(with.device().allocatedBytes(), without.device().allocatedBytes() + 4096);
}

class OmittedBarrier : public testing::TestWithParam<const char*> {};

// Synchronisation validation sees through render passes better than through dynamic rendering; the barriers are the
// same on both paths.
TEST_P(OmittedBarrier, IsNoticed) {
  Options options = headless(writeScene("barriers", room + left + right), {64, 36});
  options.renderPath = RenderPath::renderPass;
  options.settings = {{"debug.omit_barrier", GetParam()}, {"view.samples", "4"}, {"reflection.samples", "4"}};
  Session session(options);
  for (int i = 0; i < 3; ++i) {
    // A capture's own barriers order the next frame's writes as well.
    session.draw(0.1 * i, std::string(GetParam()) == "readbackToCopy");
  }
  session.renderer().waitIdle();
  EXPECT_GT(session.device().validationMessages(), 0) << GetParam();
}

INSTANTIATE_TEST_SUITE_P(Kinds, OmittedBarrier,
                         testing::Values("offscreenBeforeWrite", "offscreenSamplesBeforeWrite",
                                         "offscreenDepthBeforeWrite", "offscreenToSample", "mainBeforeWrite",
                                         "mainSamplesBeforeWrite", "mainDepthBeforeWrite", "mainToSample",
                                         "swapchainBeforeWrite", "readbackToCopy"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace speculum
