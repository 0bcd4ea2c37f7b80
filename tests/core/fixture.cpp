#include "core/fixture.hpp"

#include "driver.hpp"
#include "test_paths.hpp"

namespace speculum::test {

namespace {

GraphicsPipelineDesc copyPipeline(std::string name, VkDescriptorSetLayout layout) {
  return {.name = std::move(name),
          .vert = "full_screen.vert",
          .frag = "copy.frag",
          .setLayouts = {layout},
          .depthTest = false,
          .depthWrite = false};
}

GraphicsPipelineDesc mainCopy(VkDescriptorSetLayout layout, VkSampleCountFlagBits samples) {
  GraphicsPipelineDesc desc = copyPipeline("copy to main", layout);
  desc.samples = samples;
  return desc;
}

GraphicsPipelineDesc displayCopy(VkDescriptorSetLayout layout, VkFormat format) {
  GraphicsPipelineDesc desc = copyPipeline("display", layout);
  desc.color = format;
  desc.depth = VK_FORMAT_UNDEFINED;
  return desc;
}

}  // namespace

DeviceOptions validated(RenderPath path) {
  testing_support::keepDriverLoaded();
  return {.validation = true, .renderPath = path};
}

RendererOptions headless(VkExtent2D extent) {
  return {.extent = extent,
          .spirvDir = binaryDir() / "tests" / "core_shaders",
          .pipelineCacheDir = std::filesystem::path()};
}

VkDescriptorSetLayout oneBinding(Device& device, VkDescriptorType type, uint32_t count) {
  const DescriptorBinding binding{
      .type = type, .count = count, .stages = VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT};
  return descriptorSetLayout(device, {&binding, 1}, "test");
}

SmallScene::SmallScene(Renderer& renderer, VkExtent2D extent, int samples)
    : renderer_(renderer),
      shared_(renderer.device(), renderer.device().sampleCount(samples), "mirrors"),
      mirror_(renderer.device(), {.name = "mirror", .extent = extent, .shared = &shared_}, renderer.retired()),
      main_(renderer.device(),
            {.name = "main", .extent = extent, .samples = shared_.samples(), .role = TargetRole::main},
            renderer.retired()),
      layout_(oneBinding(renderer.device(), VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER)),
      triangle_(renderer.pipelines(), GraphicsPipelineDesc{.name = "triangle",
                                                           .vert = "triangle.vert",
                                                           .frag = "triangle.frag",
                                                           .pushConstantBytes = sizeof(TrianglePush),
                                                           .samples = shared_.samples()}),
      copyToMain_(renderer.pipelines(), mainCopy(layout_, shared_.samples())),
      display_(renderer.pipelines(), displayCopy(layout_, renderer.displayFormat())),
      idle_(renderer.device()) {}

void SmallScene::drawTriangles(Frame& frame, OffScreen& target, const std::string& name,
                               std::span<const TrianglePush> triangles) {
  PassDesc desc = fullPass(name, target.targets());
  desc.clearColor = {0.25f, 0.125f, 0.75f, 1.0f};
  desc.collectStatistics = true;
  PassScope scope = renderer_.beginPass(frame, desc);
  scope.countSamples();
  if (&target == &main_) {
    copy(frame, scope.commands(), copyToMain_, mirror_);
  }
  triangle_.bind(scope.commands());
  for (const TrianglePush& triangle : triangles) {
    triangle_.push(scope.commands(), triangle);
    vkCmdDraw(scope.commands(), 3, 1, 0, 0);
  }
}

void SmallScene::copy(Frame& frame, VkCommandBuffer commands, const Pipeline& pipeline, OffScreen& source) {
  const VkDescriptorSet set = frame.descriptors->allocate(layout_);
  DescriptorWriter().image(0, source.descriptor()).update(renderer_.device(), set);
  pipeline.bind(commands);
  pipeline.bindSet(commands, 0, set);
  vkCmdDraw(commands, 3, 1, 0, 0);
}

void SmallScene::draw(Frame& frame) {
  constexpr std::array inMirror = {TrianglePush{.depth = 0.6f}, TrianglePush{{0.05f, 0.1f}, 0.4f, 0.5f}};
  constexpr std::array inMain = {TrianglePush{{-0.5f, 0.4f}, 0.7f, 0.8f}};
  drawTriangles(frame, mirror_, "mirror", inMirror);
  drawTriangles(frame, main_, "main", inMain);
  {
    const PassScope scope = renderer_.beginPass(frame, fullPass("display", renderer_.displayTargets(frame)));
    copy(frame, scope.commands(), display_, main_);
  }
  const PassScope overlay = renderer_.beginOverlay(frame, true);
}

bool SmallScene::frame(bool capture) {
  std::optional<Frame> frame = renderer_.beginFrame();
  if (!frame) {
    return false;
  }
  if (frame->extent.width != main_.extent().width || frame->extent.height != main_.extent().height) {
    resize(frame->extent);
  }
  frame->capture = capture;
  draw(*frame);
  renderer_.endFrame(*frame);
  return true;
}

void SmallScene::frames(int count) {
  for (int i = 0; i < count; ++i) {
    EXPECT_TRUE(frame());
  }
  renderer_.waitIdle();
}

void SmallScene::resize(VkExtent2D extent) {
  shared_.trim(extent, renderer_.retired());
  mirror_.resize(extent, renderer_.retired());
  main_.resize(extent, renderer_.retired());
}

}  // namespace speculum::test
