#include "core/fixture.hpp"

namespace speculum::test {
namespace {

constexpr VkExtent2D extent = smallExtent;

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
  EXPECT_EQ(device.validationMessages(), 0);
  return bytes;
}

const uint8_t* pixel(const std::vector<uint8_t>& rgba, uint32_t x, uint32_t y) {
  return &rgba[4 * (y * extent.width + x)];
}

class Render : public testing::TestWithParam<int> {};

TEST_P(Render, BothPathsShowTheTriangle) {
  const std::vector<uint8_t> bytes = render(RenderPath::dynamic, GetParam());
  EXPECT_EQ(render(RenderPath::renderPass, GetParam()), bytes);
  ASSERT_EQ(bytes.size(), size_t{4} * extent.width * extent.height);
  // The corner holds the clear color of the offscreen target, sampled twice on its way.
  const uint8_t* corner = pixel(bytes, 63, 0);
  EXPECT_EQ(std::vector(corner, corner + 4), (std::vector<uint8_t>{64, 32, 191, 255}));
  // Near the triangle's second corner green dominates.
  const uint8_t* green = pixel(bytes, 57, 18);
  EXPECT_GT(green[1], 150);
  EXPECT_LT(green[0], 90);
}

INSTANTIATE_TEST_SUITE_P(Samples, Render, testing::Values(1, 4));

TEST_F(RendererTest, TimesEveryPassOfTheFinishedFrame) {
  SmallScene scene(renderer_, extent, 1);
  scene.frames(3);
  const FrameTimings& timings = renderer_.timings();
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

TEST_F(RendererTest, MeasuresNoMoreThanAsked) {
  SmallScene scene(renderer_, extent, 1);
  renderer_.setTimerDetail(TimerDetail::frame);
  scene.frames(3);
  EXPECT_EQ(renderer_.timings().frame, 3u);
  EXPECT_TRUE(renderer_.timings().passes.empty());
  EXPECT_GT(renderer_.timings().gpuMs, 0.0);
  renderer_.setTimerDetail(TimerDetail::passes);
  scene.frames(1);
  ASSERT_EQ(renderer_.timings().passes.size(), 4u);
  EXPECT_FALSE(renderer_.timings().passes[0].hasSamples);
  renderer_.setTimerDetail(TimerDetail::samples);
  scene.frames(1);
  EXPECT_TRUE(renderer_.timings().passes[0].hasSamples);
  EXPECT_GT(renderer_.timings().passes[0].samples, 500u);
  EXPECT_LE(renderer_.timings().passes[0].samples, extent.width * extent.height);
}

// A part of 513 passes measures only the first 512. The last one is listed all the same, without a time, so that the
// next part's pass stands behind it.
TEST_F(RendererTest, PartsOfAFrameAddUp) {
  OffScreen target(device_, {.name = "target", .extent = extent}, renderer_.retired());
  Frame frame = renderer_.beginFrame().value();
  const VkCommandBuffer first = frame.commands;
  for (int i = 0; i < 514; ++i) {
    if (i == 513) {
      renderer_.submitPart(frame);
    }
    const PassScope scope =
        renderer_.beginPass(frame, fullPass(i == 513 ? "second part" : "first part", target.targets()));
  }
  EXPECT_EQ(frame.commands, first) << "its buffer begins anew";
  EXPECT_GT(frame.waitedMs, 0.0);
  renderer_.endFrame(frame);
  renderer_.waitIdle();
  const FrameTimings& timings = renderer_.timings();
  ASSERT_EQ(timings.passes.size(), 514u);
  EXPECT_GT(timings.passes[511].gpuMs, 0.0);
  EXPECT_EQ(timings.passes[512].gpuMs, 0.0);
  EXPECT_EQ(timings.passes[513].name, "second part");
  EXPECT_GT(timings.passes[513].gpuMs, 0.0);
  double sum = 0.0;
  for (const PassTiming& pass : timings.passes) {
    sum += pass.gpuMs;
  }
  EXPECT_GE(timings.gpuMs * 1.0001, sum);
}

// An image of a part of the picture, drawn with a shifted viewport, has exactly the picture's texels.
TEST_F(RendererTest, ShiftedViewportShowsItsPart) {
  constexpr VkExtent2D partExtent{24, 20};
  constexpr int32_t partX = 20;
  constexpr int32_t partY = 15;
  OffScreen whole(device_, {.name = "whole", .extent = extent}, renderer_.retired());
  OffScreen part(device_, {.name = "part", .extent = partExtent}, renderer_.retired());
  const Pipeline triangle(renderer_.pipelines(), GraphicsPipelineDesc{.name = "triangle",
                                                                      .vert = "triangle.vert",
                                                                      .frag = "triangle.frag",
                                                                      .pushConstantBytes = sizeof(TrianglePush)});
  std::optional<Frame> frame = renderer_.beginFrame();
  for (OffScreen* target : {&whole, &part}) {
    PassDesc desc = fullPass(target->desc().name, target->targets());
    const bool shifted = target == &part;
    desc.viewport = {shifted ? -float(partX) : 0.0f, shifted ? -float(partY) : 0.0f, float(extent.width),
                     float(extent.height)};
    const PassScope scope = renderer_.beginPass(*frame, desc);
    triangle.bind(scope.commands());
    triangle.push(scope.commands(), TrianglePush{});
    vkCmdDraw(scope.commands(), 3, 1, 0, 0);
  }
  renderer_.endFrame(*frame);
  renderer_.waitIdle();
  const std::vector<float> wholeTexels = renderer_.uploader().readFloats(whole.color());
  const std::vector<float> partTexels = renderer_.uploader().readFloats(part.color());
  for (uint32_t y = 0; y < partExtent.height; ++y) {
    const auto row = partTexels.begin() + y * partExtent.width * 4;
    EXPECT_TRUE(
        std::equal(row, row + partExtent.width * 4, wholeTexels.begin() + ((y + partY) * extent.width + partX) * 4))
        << y;
  }
}

class Resize : public testing::TestWithParam<RenderPath> {};

TEST_P(Resize, ManyResizesLeakNothing) {
  Device device(validated(GetParam()));
  Renderer renderer(device, headless(extent));
  SmallScene scene(renderer, extent, 4);
  scene.frames(2);
  const auto objects = liveObjects();
  const uint64_t bytes = device.allocatedBytes();
  uint32_t random = 1;
  for (int i = 0; i < manyResizes(); ++i) {
    random = random * 1664525 + 1013904223;
    renderer.resizeHeadless({1 + (random >> 24) % 90, 1 + (random >> 16) % 90});
    ASSERT_TRUE(scene.frame());
  }
  renderer.resizeHeadless(extent);
  scene.frames(2);
  EXPECT_EQ(liveObjects(), objects);
  EXPECT_EQ(device.allocatedBytes(), bytes);
  EXPECT_EQ(renderer.retired().size(), 0u);
  EXPECT_EQ(device.validationMessages(), 0);
}

INSTANTIATE_TEST_SUITE_P(Paths, Resize, testing::Values(RenderPath::dynamic, RenderPath::renderPass));

TEST(Renderer, DiesWithAllItsObjects) {
  const auto before = liveObjects();
  {
    Device device(validated());
    Renderer renderer(device, headless(extent));
    SmallScene scene(renderer, extent, 4);
    scene.frame(true);
    EXPECT_NE(liveObjects(), before);
  }
  EXPECT_EQ(liveObjects(), before);
}

}  // namespace
}  // namespace speculum::test
