#include "core/fixture.hpp"

#include "log_capture.hpp"

namespace speculum::test {
namespace {

// Draws frames with every kind of target, copies and uploads, with one kind of barrier omitted. Returns the first
// message of the validation layer.
std::string messageWithout(std::optional<BarrierKind> kind, int samples) {
  const LogCapture log;
  Device device(validated(RenderPath::renderPass));
  Renderer renderer(device, headless(smallExtent));
  SmallScene scene(renderer, smallExtent, samples);
  device.barriers().omit(kind);
  for (int i = 0; i < 4; ++i) {
    scene.frame(i == 3);
  }
  renderer.waitIdle();
  renderer.uploader().readFloats(scene.main().color());
  const std::vector<uint16_t> texels(4 * (256 + 64 + 16 + 4 + 1), 0x3800);
  const Image image =
      renderer.uploader().image(std::as_bytes(std::span(texels)), {16, 16}, colorFormat, true, "upload");
  renderer.waitIdle();
  return log.validationMessage();
}

class Barrier : public testing::TestWithParam<BarrierKind> {};

TEST_P(Barrier, IsMissedWhenLeftOut) {
  const std::string message = messageWithout(GetParam(), 4);
  EXPECT_TRUE(contains(message, "SYNC-HAZARD")) << message;
}

// The other kinds are tested where they occur: presenting in window.cpp, those of compute shaders in
// finite_watch.cpp, sampled depth in target_views.cpp.
std::vector<BarrierKind> kindsWithoutWindow() {
  std::vector<BarrierKind> kinds(allBarrierKinds().begin(), allBarrierKinds().end());
  for (const BarrierKind other : {BarrierKind::swapchainToPresent, BarrierKind::targetToCheck,
                                  BarrierKind::checkToLookUp, BarrierKind::checkToWrite, BarrierKind::surfacesToShade,
                                  BarrierKind::shadedToDraw, BarrierKind::depthToSample}) {
    std::erase(kinds, other);
  }
  return kinds;
}

INSTANTIATE_TEST_SUITE_P(Kinds, Barrier, testing::ValuesIn(kindsWithoutWindow()),
                         [](const auto& info) { return std::string(barrierName(info.param)); });

TEST(Barriers, AllInPlaceGiveNoMessage) {
  EXPECT_EQ(messageWithout(std::nullopt, 4), "");
  EXPECT_EQ(messageWithout(std::nullopt, 1), "");
}

TEST(Barriers, NamesAndKindsAgree) {
  EXPECT_EQ(allBarrierKinds().size(), size_t{barrierKindCount});
  for (const BarrierKind kind : allBarrierKinds()) {
    EXPECT_EQ(barrierFromName(barrierName(kind)), kind);
  }
  EXPECT_EQ(barrierFromName("offscreen"), std::nullopt);
}

}  // namespace
}  // namespace speculum::test
