#include <bit>
#include <cstring>
#include <regex>
#include <set>

#include "core/fixture.hpp"
#include "error_message.hpp"
#include "platform/files.hpp"
#include "test_paths.hpp"

namespace speculum::test {
namespace {

namespace fs = std::filesystem;

constexpr VkExtent2D tinyExtent{32, 32};

const fs::path glslDir = sourceDir() / "tests" / "shaders";

// Draws one frame with a pipeline cache in `directory`.
bool runWithCache(Device& device, const fs::path& directory) {
  RendererOptions options = headless(tinyExtent);
  options.pipelineCacheDir = directory;
  Renderer renderer(device, options);
  SmallScene scene(renderer, tinyExtent, 1);
  EXPECT_TRUE(scene.frame());
  return renderer.pipelineCache().loaded();
}

fs::path onlyFile(const fs::path& directory) {
  return fs::directory_iterator(directory)->path();
}

using PipelineCacheTest = GpuTest;

TEST_F(PipelineCacheTest, IsWrittenAndFoundAgain) {
  const TemporaryDirectory directory;
  EXPECT_FALSE(runWithCache(device_, directory.path()));
  EXPECT_TRUE(runWithCache(device_, directory.path()));
}

TEST_F(PipelineCacheTest, DamagedFilesAreIgnoredAndReplaced) {
  const TemporaryDirectory directory;
  runWithCache(device_, directory.path());
  const fs::path file = onlyFile(directory.path());
  const std::vector<uint8_t> good = readFile(file);
  ASSERT_GE(good.size(), 56u);

  const std::vector<std::function<void(std::vector<uint8_t>&)>> damages = {
      [](auto& content) { content.clear(); },      [](auto& content) { content.resize(content.size() / 2); },
      [](auto& content) { content.push_back(0); }, [](auto& content) { content[0] ^= 1; },
      [](auto& content) { content.back() ^= 1; },  [](auto& content) { content.assign(100000, 0xff); },
  };
  for (size_t i = 0; i < damages.size(); ++i) {
    std::vector<uint8_t> content = good;
    damages[i](content);
    replaceFile(file, content);
    EXPECT_FALSE(runWithCache(device_, directory.path())) << "damage " << i;
  }
  EXPECT_TRUE(runWithCache(device_, directory.path())) << "a damaged file was not replaced";
}

TEST_F(PipelineCacheTest, UnwritableDirectoryIsNoError) {
  EXPECT_FALSE(runWithCache(device_, "/proc/speculum"));
}

// A scene whose shaders are copied to a directory that the renderer watches.
class HotReload : public GpuTest {
 protected:
  HotReload() {
    fs::create_directory(folder_);
    for (const auto& entry : fs::directory_iterator(glslDir)) {
      fs::copy_file(entry.path(), folder_ / entry.path().filename());
    }
    RendererOptions options = headless(tinyExtent);
    options.shaderDir = folder_;
    renderer_.emplace(device_, options);
    scene_.emplace(*renderer_, tinyExtent, 1);
  }

  // Replaces `from` in a shader and gives the file a newer time.
  void edit(const std::string& name, const std::string& from, const std::string& to) {
    const fs::path file = folder_ / name;
    const auto before = fs::last_write_time(file);
    replaceFile(file, replaced(readText(file), from, to));
    fs::last_write_time(file, before + std::chrono::seconds(++edits_));
  }

  std::array<int, 3> cornerColor() {
    EXPECT_TRUE(scene_->frame(true));
    const Pixels pixels = renderer_->readback();
    const uint8_t* corner = &pixels.rgba[4 * (tinyExtent.width - 1)];
    return {corner[0], corner[1], corner[2]};
  }

  TemporaryDirectory directory_;
  const fs::path folder_ = directory_.path() / "with a blank: and \\ more";
  std::optional<Renderer> renderer_;
  std::optional<SmallScene> scene_;
  int edits_ = 0;
};

constexpr std::array<int, 3> unedited = {64, 32, 191};

TEST_F(HotReload, EditChangesThePictureAndLeaksNothing) {
  EXPECT_EQ(cornerColor(), unedited);
  EXPECT_EQ(cornerColor(), unedited);
  const auto objects = liveObjects();  // after both frames in flight have made what they keep
  edit("copy.frag", "texelFetch(source, ivec2(gl_FragCoord.xy), 0)",
       "texelFetch(source, ivec2(gl_FragCoord.xy), 0).bgra");
  EXPECT_TRUE(renderer_->reloadShaders());
  EXPECT_TRUE(renderer_->pipelines().errors().empty());
  // Swapped twice, once into the main target and once onto the display image.
  EXPECT_EQ(cornerColor(), unedited);
  edit("copy.frag", ".bgra", " * vec4(2.0, 1.0, 1.0, 1.0)");
  EXPECT_TRUE(renderer_->reloadShaders());
  EXPECT_EQ(cornerColor(), (std::array<int, 3>{255, 32, 191}));
  EXPECT_EQ(liveObjects(), objects);
}

// Returns the values that fill.comp writes.
std::vector<uint32_t> filled(Renderer& renderer, const Pipeline& pipeline, VkDescriptorSetLayout layout) {
  constexpr uint32_t offset = 7;
  const Buffer buffer(renderer.device(), 8 * sizeof(uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferMemory::host,
                      "filled");
  Frame frame = renderer.beginFrame().value();
  const VkDescriptorSet set = frame.descriptors->allocate(layout);
  DescriptorWriter().buffer(0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, buffer.descriptor()).update(renderer.device(), set);
  pipeline.bind(frame.commands);
  pipeline.bindSet(frame.commands, 0, set);
  pipeline.push(frame.commands, offset);
  vkCmdDispatch(frame.commands, 1, 1, 1);
  Barriers::computeToHost(frame.commands);
  renderer.endFrame(frame);
  renderer.waitIdle();
  std::vector<uint32_t> values(8);
  std::memcpy(values.data(), buffer.mapped(), buffer.bytes());
  return values;
}

TEST_F(HotReload, ComputePipelinesSpecialiseAndAreRebuilt) {
  const VkDescriptorSetLayout layout = oneBinding(device_, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  const Pipeline pipeline(renderer_->pipelines(), ComputePipelineDesc{.name = "fill",
                                                                      .comp = "fill.comp",
                                                                      .constants = {{0, 3}},
                                                                      .setLayouts = {layout},
                                                                      .pushConstantBytes = sizeof(uint32_t)});
  const std::vector<uint32_t> values = {7, 10, 13, 16, 19, 22, 25, 28};
  for (uint32_t frame = 0; frame < framesInFlight; ++frame) {
    EXPECT_EQ(filled(*renderer_, pipeline, layout), values);
  }
  const auto objects = liveObjects();  // after both frames in flight have made what they keep
  edit("fill.comp", "offset + ", "1000 + ");
  EXPECT_TRUE(renderer_->reloadShaders());
  EXPECT_EQ(filled(*renderer_, pipeline, layout).back(), 1021u);
  EXPECT_EQ(filled(*renderer_, pipeline, layout).back(), 1021u);
  EXPECT_EQ(liveObjects(), objects);
}

TEST_F(HotReload, SparePipelinesServeTheSameDescriptionAndShader) {
  const VkDescriptorSetLayout layout = oneBinding(device_, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  EXPECT_EQ(oneBinding(device_, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER), layout);
  EXPECT_NE(oneBinding(device_, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2), layout);
  constexpr size_t most = 20;
  device_.sparePipelines().keepAtMost(most);
  const auto secondValue = [&](uint32_t step) {
    uint32_t value = 0;
    {
      const Pipeline pipeline(renderer_->pipelines(), ComputePipelineDesc{.name = "fill",
                                                                          .comp = "fill.comp",
                                                                          .constants = {{0, step}},
                                                                          .setLayouts = {layout},
                                                                          .pushConstantBytes = sizeof(uint32_t)});
      value = filled(*renderer_, pipeline, layout).at(1);
    }
    renderer_->waitIdle();
    return value;
  };
  EXPECT_EQ(secondValue(3), 10u);
  const int64_t alive = liveHandles<VkPipeline>;
  EXPECT_EQ(secondValue(3), 10u);
  EXPECT_EQ(liveHandles<VkPipeline>, alive);
  EXPECT_EQ(secondValue(4), 11u);
  EXPECT_EQ(liveHandles<VkPipeline>, alive + 1) << "another constant";
  edit("fill.comp", "offset + ", "1000 + ");
  renderer_->reloadShaders();
  EXPECT_EQ(secondValue(3), 1003u);
  EXPECT_EQ(liveHandles<VkPipeline>, alive + 2) << "another shader";
  for (uint32_t step = 5; step < 50; ++step) {
    EXPECT_EQ(secondValue(step), 1000u + step);
  }
  EXPECT_EQ(liveHandles<VkPipeline>, alive - 1 + static_cast<int64_t>(most));
}

TEST_F(HotReload, UnchangedSpirvRebuildsNothing) {
  EXPECT_FALSE(renderer_->reloadShaders());
  edit("copy.frag", "void main()", "// a comment\nvoid main()");
  EXPECT_FALSE(renderer_->reloadShaders());
}

TEST_F(HotReload, CompileErrorKeepsTheOldPipeline) {
  edit("copy.frag", "result = ", "result = nonsense + ");
  EXPECT_FALSE(renderer_->reloadShaders());
  EXPECT_TRUE(contains(renderer_->pipelines().errors(), "nonsense"));
  EXPECT_EQ(cornerColor(), unedited);
  edit("copy.frag", "nonsense + ", "0.5 * ");
  EXPECT_TRUE(renderer_->reloadShaders());
  EXPECT_TRUE(renderer_->pipelines().errors().empty());
  EXPECT_EQ(cornerColor()[0], 16);
}

TEST_F(RendererTest, CopiesAndShadersDecodeSrgbAlike) {
  std::array<uint32_t, 256> codes;
  for (uint32_t i = 0; i < codes.size(); ++i) {
    codes[i] = 0x010101u * i;
  }
  const Image image =
      renderer_.uploader().image(std::as_bytes(std::span(codes)), {256, 1}, VK_FORMAT_R8G8B8A8_SRGB, false, "codes");
  const SamplerHandle sampler = createSampler(device_, nearestSampler, "codes");
  const Buffer buffer(device_, 256 * sizeof(float), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferMemory::host, "decoded");
  const VkDescriptorSetLayout layout =
      descriptorSetLayout(device_, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                          VK_SHADER_STAGE_COMPUTE_BIT, "decode");
  const Pipeline pipeline(renderer_.pipelines(),
                          ComputePipelineDesc{.name = "decode", .comp = "decode.comp", .setLayouts = {layout}});
  Frame frame = renderer_.beginFrame().value();
  const VkDescriptorSet set = frame.descriptors->allocate(layout);
  DescriptorWriter()
      .image(0, image.descriptor(sampler.get()))
      .buffer(1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, buffer.descriptor())
      .update(device_, set);
  pipeline.bind(frame.commands);
  pipeline.bindSet(frame.commands, 0, set);
  vkCmdDispatch(frame.commands, 1, 1, 1);
  Barriers::computeToHost(frame.commands);
  renderer_.endFrame(frame);
  renderer_.waitIdle();
  std::array<float, 256> read;
  std::memcpy(read.data(), buffer.mapped(), buffer.bytes());
  const std::array<float, 256> copied = renderer_.uploader().decodedSrgb();
  double apart = 0.0;
  double error = 0.0;  // in steps of 8 bits
  for (size_t i = 0; i < read.size(); ++i) {
    const double x = read[i];
    const double code = 255.0 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
    error = std::max(error, std::abs(code - static_cast<double>(i)));
    apart = std::max(apart, std::abs(x - static_cast<double>(copied[i])) / std::max(x, 1e-4));
  }
  std::printf("sRGB is decoded with an error of %.3f of a step; copies differ by %.2e\n", error, apart);
  EXPECT_LT(error, 0.5) << "codes survive";
  EXPECT_LT(apart, 1e-3);
}

// Every half float from 0 to 1, then floats that lie densely in value and in magnitude.
TEST_F(RendererTest, ShadersEncodeSrgbAsExactly) {
  constexpr size_t halfFloats = 0x3c01;
  std::vector<float> linear(1u << 20);
  for (uint32_t i = 0; i < linear.size(); ++i) {
    const uint32_t fraction = i & 0x3ff;
    const int exponent = static_cast<int>(i >> 10);
    linear[i] = i < halfFloats ? std::ldexp(static_cast<float>(exponent > 0 ? 1024 + fraction : fraction),
                                            std::max(exponent, 1) - 25)
                : i % 2 == 0   ? static_cast<float>(i) / static_cast<float>(linear.size())
                               : std::bit_cast<float>(0x3f800000 - 96 * i);
  }
  const Buffer buffer(device_, linear.size() * sizeof(float), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferMemory::host,
                      "encoded");
  buffer.write(std::as_bytes(std::span(linear)));
  const VkDescriptorSetLayout layout = oneBinding(device_, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  const Pipeline pipeline(renderer_.pipelines(),
                          ComputePipelineDesc{.name = "encode", .comp = "encode.comp", .setLayouts = {layout}});
  Frame frame = renderer_.beginFrame().value();
  const VkDescriptorSet set = frame.descriptors->allocate(layout);
  DescriptorWriter().buffer(0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, buffer.descriptor()).update(device_, set);
  pipeline.bind(frame.commands);
  pipeline.bindSet(frame.commands, 0, set);
  vkCmdDispatch(frame.commands, static_cast<uint32_t>(linear.size() / 256), 1, 1);
  Barriers::computeToHost(frame.commands);
  renderer_.endFrame(frame);
  renderer_.waitIdle();
  std::vector<float> encoded(linear.size());
  std::memcpy(encoded.data(), buffer.mapped(), buffer.bytes());
  double error = 0.0;  // in steps of 8 bits
  int others = 0;      // codes other than the exact curve's
  for (size_t i = 0; i < linear.size(); ++i) {
    const double x = linear[i];
    const double steps = 255.0 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
    error = std::max(error, std::abs(255.0 * encoded[i] - steps));
    // Devices whose roots are less exact may miss codes this close to a tie of rounding.
    const bool isTie = std::abs(steps - std::floor(steps) - 0.5) < (device_.info().isCpu() ? 0.0 : 1.0 / 4000.0);
    others += i < halfFloats && !isTie && std::floor(255.0f * encoded[i] + 0.5f) != std::floor(steps + 0.5);
  }
  RecordProperty("error", std::to_string(error));
  EXPECT_LT(error, 1.0 / 4000.0);
  EXPECT_EQ(others, 0);
}

TEST(ShaderLibrary, ErrorsNameTheFileOrDirectory) {
  Device device({});
  ShaderLibrary library(device, binaryDir() / "tests" / "shaders");
  EXPECT_TRUE(contains(messageOf([&] { library.module("missing.frag"); }), "missing.frag.spv"));
  EXPECT_THROW(ShaderLibrary(device, "", "/no/such/directory"), std::runtime_error);
  const TemporaryDirectory directory;
  replaceFile(directory.path() / "bad.frag.spv", std::vector<uint8_t>(64, 7));
  ShaderLibrary damaged(device, directory.path());
  EXPECT_THROW(damaged.module("bad.frag"), std::runtime_error);
}

TEST(SpecialisationConstants, EachHasANumberOfItsOwn) {
  const std::string text = readText(sourceDir() / "shaders" / "gpu_data.h");
  const std::regex constant("const uint (constant[A-Z]\\w*) = (\\d+);");
  std::set<std::string> numbers;
  for (std::sregex_iterator at(text.begin(), text.end(), constant), end; at != end; ++at) {
    EXPECT_TRUE(numbers.insert((*at)[2]).second) << (*at)[1] << " has the number of another";
  }
  EXPECT_GE(numbers.size(), 24u);
}

// All levels are black but the last, which is one half.
TEST_F(RendererTest, MipmapLevelsAreUploaded) {
  constexpr uint32_t size = 16;
  constexpr size_t count = 256 + 64 + 16 + 4 + 1;
  std::vector<uint16_t> texels(4 * count);
  std::fill(texels.end() - 4, texels.end(), uint16_t{0x3800});
  const Image image =
      renderer_.uploader().image(std::as_bytes(std::span(texels)), {size, size}, colorFormat, true, "texture");
  EXPECT_EQ(image.desc().mipLevels, 5u);
  const SamplerHandle sampler = createSampler(device_, {.filter = VK_FILTER_NEAREST}, "texture");
  const VkDescriptorSetLayout layout = oneBinding(device_, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
  OffScreen target(device_, {.name = "target", .depth = false}, renderer_.retired());
  const Pipeline pipeline(renderer_.pipelines(), GraphicsPipelineDesc{.name = "textured",
                                                                      .vert = "full_screen.vert",
                                                                      .frag = "textured.frag",
                                                                      .constants = {{0, std::bit_cast<uint32_t>(4.0f)}},
                                                                      .setLayouts = {layout},
                                                                      .depth = VK_FORMAT_UNDEFINED});
  std::optional<Frame> frame = renderer_.beginFrame();
  const VkDescriptorSet set = frame->descriptors->allocate(layout);
  DescriptorWriter().image(0, image.descriptor(sampler.get())).update(device_, set);
  {
    const PassScope scope = renderer_.beginPass(*frame, fullPass("textured", target.targets()));
    pipeline.bind(scope.commands());
    pipeline.bindSet(scope.commands(), 0, set);
    vkCmdDraw(scope.commands(), 3, 1, 0, 0);
  }
  renderer_.endFrame(*frame);
  renderer_.waitIdle();
  EXPECT_EQ(renderer_.uploader().readFloats(target.color()), (std::vector<float>{0.5f, 0.5f, 0.5f, 0.5f}));
}

TEST_F(GpuTest, DescriptorAllocatorReusesItsPools) {
  const VkDescriptorSetLayout layout = oneBinding(device_, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 100);
  DescriptorAllocator allocator(device_);
  const auto allocateAll = [&] {
    for (int i = 0; i < 200; ++i) {
      EXPECT_NE(allocator.allocate(layout), VkDescriptorSet{VK_NULL_HANDLE});
    }
  };
  allocateAll();
  const auto objects = liveObjects();
  allocator.reset();
  allocateAll();
  EXPECT_EQ(liveObjects(), objects);
}

}  // namespace
}  // namespace speculum::test
