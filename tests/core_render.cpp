#include "core_fixture.hpp"

namespace speculum::test {
namespace {

constexpr VkExtent2D extent{64, 48};

std::vector<uint8_t> render(RenderPath path, int samples) {
  Device device(validated(path));
  std::vector<uint8_t> bytes;
  {
    Renderer renderer(device, headless(extent));
    SmallScene scene(renderer, extent, samples);
    for (int i = 0; i < 5; ++i) {
      EXPECT_TRUE(scene.frame(i == 4));
    }
    bytes = renderer.readback().rgba;
  }
  EXPECT_EQ(device.validationMessages(), 0) << messagesOf(device);
  return bytes;
}

const uint8_t* pixel(const std::vector<uint8_t>& rgba, uint32_t x, uint32_t y) {
  return &rgba[4 * (y * extent.width + x)];
}

class Render : public testing::TestWithParam<int> {};

TEST_P(Render, ClearAndTriangleReachTheDisplayImage) {
  const std::vector<uint8_t> bytes = render(RenderPath::automatic, GetParam());
  ASSERT_EQ(bytes.size(), size_t{4} * extent.width * extent.height);
  // The corner holds the clear colour of the offscreen target, sampled twice on its way.
  const uint8_t* corner = pixel(bytes, 63, 0);
  EXPECT_EQ(corner[0], 64);
  EXPECT_EQ(corner[1], 32);
  EXPECT_EQ(corner[2], 191);
  EXPECT_EQ(corner[3], 255);
  // Near the triangle's second corner green rules.
  const uint8_t* green = pixel(bytes, 57, 18);
  EXPECT_GT(green[1], 150);
  EXPECT_LT(green[0], 90);
}

TEST_P(Render, PathsGiveTheSameBytes) {
  EXPECT_EQ(render(RenderPath::dynamic, GetParam()), render(RenderPath::renderPass, GetParam()));
}

TEST_P(Render, RunsGiveTheSameBytes) {
  EXPECT_EQ(render(RenderPath::automatic, GetParam()), render(RenderPath::automatic, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Samples, Render, testing::Values(1, 4));

TEST(Renderer, TimesEveryPassOfTheLastFinishedFrame) {
  Device device(validated());
  Renderer renderer(device, headless(extent));
  SmallScene scene(renderer, extent, 1);
  for (int i = 0; i < 3; ++i) {
    scene.frame();
  }
  renderer.waitIdle();
  const FrameTimings& timings = renderer.timings();
  EXPECT_EQ(timings.frame, 3u);
  ASSERT_EQ(timings.passes.size(), 4u);
  EXPECT_EQ(timings.passes[0].name, "mirror");
  EXPECT_EQ(timings.passes[3].name, "overlay");
  double sum = 0.0;
  for (const PassTiming& pass : timings.passes) {
    EXPECT_GE(pass.gpuMs, 0.0);
    sum += pass.gpuMs;
  }
  EXPECT_GT(timings.passes[0].gpuMs, 0.0);
  EXPECT_LE(sum, timings.gpuMs * 1.0001);
  ASSERT_TRUE(timings.passes[0].hasStatistics);
  EXPECT_EQ(timings.passes[0].triangles, 2u);
  EXPECT_GT(timings.passes[0].fragments, 500u);
  EXPECT_LT(timings.passes[0].fragments, 2u * extent.width * extent.height);
  EXPECT_FALSE(timings.passes[2].hasStatistics);
}

TEST(Renderer, TimesOnlyTheFrameIfItsPassesAreNotAskedFor) {
  Device device(validated());
  Renderer renderer(device, headless(extent));
  SmallScene scene(renderer, extent, 1);
  renderer.setTimerDetail(TimerDetail::frame);
  for (int i = 0; i < 3; ++i) {
    scene.frame();
  }
  renderer.waitIdle();
  EXPECT_EQ(renderer.timings().frame, 3u);
  EXPECT_TRUE(renderer.timings().passes.empty());
  EXPECT_GT(renderer.timings().gpuMs, 0.0);
  renderer.setTimerDetail(TimerDetail::passes);
  scene.frame();
  renderer.waitIdle();
  EXPECT_EQ(renderer.timings().passes.size(), 4u);
}

TEST(Renderer, ViewportOfALargerScreenShowsItsPart) {
  // An image of a part of the screen, drawn with the screen's viewport shifted, holds the screen's very texels.
  Device device(validated());
  Renderer renderer(device, headless(extent));
  constexpr VkExtent2D partExtent{24, 20};
  constexpr int32_t partX = 20;
  constexpr int32_t partY = 15;
  OffScreen whole(device, {.name = "whole", .extent = extent}, renderer.retired());
  OffScreen part(device, {.name = "part", .extent = partExtent}, renderer.retired());
  const Pipeline triangle(renderer.pipelines(), {.name = "triangle",
                                                 .vert = "triangle.vert",
                                                 .frag = "triangle.frag",
                                                 .pushConstantBytes = sizeof(TrianglePush)});
  std::optional<Frame> frame = renderer.beginFrame();
  for (OffScreen* target : {&whole, &part}) {
    PassDesc desc = fullPass(target->desc().name, target->targets());
    const bool shifted = target == &part;
    desc.viewport = {shifted ? -float(partX) : 0.0f, shifted ? -float(partY) : 0.0f, float(extent.width),
                     float(extent.height)};
    const PassScope scope = renderer.beginPass(*frame, desc);
    triangle.bind(scope.commands());
    triangle.push(scope.commands(), TrianglePush{});
    vkCmdDraw(scope.commands(), 3, 1, 0, 0);
  }
  renderer.endFrame(*frame);
  renderer.waitIdle();
  const std::vector<float> wholeTexels = renderer.uploader().readFloats(whole.color());
  const std::vector<float> partTexels = renderer.uploader().readFloats(part.color());
  int different = 0;
  for (uint32_t y = 0; y < partExtent.height; ++y) {
    for (uint32_t x = 0; x < partExtent.width * 4; ++x) {
      const size_t there = size_t{(y + partY) * extent.width + partX} * 4 + x;
      different += wholeTexels[there] != partTexels[size_t{y} * partExtent.width * 4 + x];
    }
  }
  EXPECT_EQ(different, 0);
  EXPECT_EQ(device.validationMessages(), 0) << messagesOf(device);
}

class Resize : public testing::TestWithParam<RenderPath> {};

TEST_P(Resize, TwoHundredResizesLeakNothing) {
  Device device(validated(GetParam()));
  Renderer renderer(device, headless(extent));
  SmallScene scene(renderer, extent, 4);
  scene.frame();
  scene.frame();
  renderer.waitIdle();
  const auto objects = liveObjects();
  const uint64_t bytes = device.allocatedBytes();
  uint32_t random = 1;
  for (int i = 0; i < 200; ++i) {
    random = random * 1664525 + 1013904223;
    renderer.resizeHeadless({1 + (random >> 24) % 90, 1 + (random >> 16) % 90});
    ASSERT_TRUE(scene.frame());
  }
  renderer.resizeHeadless(extent);
  scene.frame();
  scene.frame();
  renderer.waitIdle();
  EXPECT_EQ(liveObjects(), objects);
  EXPECT_EQ(device.allocatedBytes(), bytes);
  EXPECT_EQ(renderer.retired().size(), 0u);
  EXPECT_EQ(device.validationMessages(), 0) << messagesOf(device);
}

INSTANTIATE_TEST_SUITE_P(Paths, Resize, testing::Values(RenderPath::dynamic, RenderPath::renderPass));

TEST(Renderer, EverythingDiesWithTheDevice) {
  const int64_t before = liveObjectCount();
  {
    Device device(validated());
    Renderer renderer(device, headless(extent));
    SmallScene scene(renderer, extent, 4);
    scene.frame(true);
    EXPECT_GT(liveObjectCount(), before);
  }
  EXPECT_EQ(liveObjectCount(), before) << "left: " << liveObjects().begin()->first;
}

}  // namespace
}  // namespace speculum::test
