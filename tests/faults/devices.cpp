// Devices that lack what others have: hidden by fault_layer/fault_layer.cpp.
#include "faults/support.hpp"
#include "image/picture_files.hpp"
#include "instrumented.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class Devices : public FaultTest {
 protected:
  // Two devices: lavapipe twice, whose file is named differently on Debian 12 and 13.
  std::string twoDevices() {
    const std::filesystem::path folder = "/usr/share/vulkan/icd.d";
    const bool older = std::filesystem::exists(folder / "lvp_icd.x86_64.json");
    const std::filesystem::path driver = folder / (older ? "lvp_icd.x86_64.json" : "lvp_icd.json");
    std::filesystem::copy_file(driver, folder_.path() / "second.json");
    return "VK_ICD_FILENAMES=" + driver.string() + ":" + (folder_.path() / "second.json").string();
  }
  static void expectQuiet(const Run& run) {
    EXPECT_EQ(run.exitCode, 0);
    EXPECT_EQ(run.output, "");
  }
  static void expectLine(const Run& run, int exitCode, const std::string& says) {
    EXPECT_EQ(run.exitCode, exitCode) << says;
    EXPECT_EQ(run.lines, 1) << run.output;
    EXPECT_TRUE(contains(run.output, says)) << run.output;
  }
  TemporaryDirectory folder_;
};

// But for rays, which need storage buffers.
TEST_F(Devices, WithoutWhatIsOptionalDrawAll) {
  auto withoutRays = render;
  withoutRays.options.insert(withoutRays.options.end(), {"--set", "effects.shadows=false"});
  const Run plain = run(withoutRays, {});
  const Run poor =
      run(withoutRays,
          {"SPECULUM_HIDE=storage_buffers=4 timestamps statistics precise_counts primitive_id depth_clamp "
           "sample_shading lines wide_lines anisotropy VK_EXT_extended_dynamic_state3 VK_EXT_memory_budget"},
          Place::inner);
  expectQuiet(poor);
  EXPECT_TRUE(poor.picture == plain.picture);
}

TEST_F(Devices, WithoutRoomForRaysDrawMaps) {
  const Run maps = run(withSettings(render, {"effects.shadow_lookup=map"}), {});
  for (const auto& [lacks, says] : {std::pair("storage_buffers=12", "lacks geometryShader or 14 storage buffers"),
                                    std::pair("storage_range=40000", "MiB of trace vertices, the device takes")}) {
    const Run few = run(render, {"SPECULUM_HIDE=" + std::string(lacks)}, Place::inner);
    expectLine(few, 0, says);
    EXPECT_TRUE(few.picture == maps.picture);
  }
}

TEST_F(Devices, WithLittleRoomShrinkTexturesOfRays) {
  const Run few = run(render, {"SPECULUM_HIDE=storage_range=500000"}, Place::inner);
  expectLine(few, 0, "rays see textures of at most 128 texels a side");
  EXPECT_TRUE(few.picture);
}

TEST_F(Devices, OlderVersionsDrawTheSame) {
  const Run plain = run(render, {});
  for (const char* version : {"vulkan=1", "vulkan=2", "vulkan=2 VK_KHR_dynamic_rendering"}) {
    const Run old = run(render, {"SPECULUM_HIDE=" + std::string(version)}, Place::inner);
    expectQuiet(old);
    EXPECT_TRUE(old.picture == plain.picture) << version;
  }
}

TEST_F(Devices, OlderLoaderThanDriverDraws) {
  const Run old = run(render, {"SPECULUM_HIDE=loader=2"}, Place::early);
  expectQuiet(old);
  EXPECT_TRUE(old.picture);
}

TEST_F(Devices, SampleCountsAreAsked) {
  for (const char* lacks : {"color_samples", "depth_samples", "sampled_color_samples", "sampled_depth_samples"}) {
    const Run fewer = run(render, {"SPECULUM_HIDE=" + std::string(lacks) + "=1"}, Place::inner);
    EXPECT_EQ(fewer.exitCode, 0) << lacks;
    EXPECT_TRUE(contains(fewer.output, "has no 4 samples per pixel: 1 are used")) << lacks << fewer.output;
  }
}

TEST_F(Devices, NextOneIsTakenWithoutPresentation) {
  Kind talkative = window;
  talkative.options.back() = "info";
  for (const char* lacks : {"SPECULUM_HIDE=present@0", "SPECULUM_HIDE=graphics@0"}) {
    const std::string two = twoDevices();
    const Run second = run(talkative, {two, lacks}, Place::inner);
    EXPECT_EQ(second.exitCode, 0) << second.output;
    EXPECT_TRUE(contains(second.output, "GPU 1: "));
    std::filesystem::remove(folder_.path() / "second.json");
  }
}

TEST_F(Devices, SeparatePresentQueueShows) {
  const Run separate = run(window, {"SPECULUM_HIDE=present_queue"}, Place::inner);
  expectQuiet(separate);
}

TEST_F(Devices, FewImagesOfASwapChainShow) {
  const Run few = run(window, {"SPECULUM_HIDE=swapchain_images=2"}, Place::inner);
  expectQuiet(few);
}

TEST_F(Devices, TooLittleIsOneLine) {
  struct Case {
    const Kind& kind;
    std::string lacks;
    std::string says;
  };
  for (const auto& [kind, lacks, says] :
       {Case{render, "clip_distance", "lacks shaderClipDistance"}, Case{render, "graphics", "lacks a queue that draws"},
        Case{window, "present", "lacks a queue that presents to this window"},
        Case{render, "allocations=17", "the device takes 17 allocations"},
        Case{render, "signals", "has not finished within a minute"},
        Case{render, "image_side=40", "the device takes at most 40 a side"}}) {
    const Run poor = run(kind, {"SPECULUM_HIDE=" + lacks}, Place::inner);
    expectLine(poor, 2, says);
    EXPECT_FALSE(poor.picture) << lacks;
  }
}

TEST_F(Devices, StuckDriverForCpusNamesTheMemoryLimit) {
  if (instrumented > 1) {
    GTEST_SKIP() << "sanitizers reserve terabytes of addresses";
  }
  const Run stuck = run(render, {"SPECULUM_HIDE=signals", "prlimit", "--as=34359738368"}, Place::inner);
  expectLine(stuck, 2, "32768 MiB of address space: raise ulimit -v");
}

TEST_F(Devices, MissingFunctionsAreNamed) {
  for (const std::string function : {"vkCmdSetCullMode", "vkCmdBeginRendering"}) {
    const Run poor = run(render, {"SPECULUM_HIDE=" + function});
    expectLine(poor, 2, "does not return " + function);
  }
}

TEST_F(Devices, OtherDepthFormatsDraw) {
  const Run plain = run(render, {});
  for (const char* path : {"dynamic", "renderpass"}) {
    Kind kind = render;
    kind.options.insert(kind.options.end(), {"--render-path", path});
    const Run stencil = run(kind, {"SPECULUM_HIDE=D32"}, Place::inner);
    expectQuiet(stencil);
    EXPECT_TRUE(stencil.picture == plain.picture) << path;
    const Run fixed = run(kind, {"SPECULUM_HIDE=D32 D32_S8"}, Place::inner);
    expectLine(fixed, 0, "has no 32 bit depth");
    ASSERT_TRUE(fixed.picture);
    const PictureAgreement agreement =
        difference(readTexture("fixed", *fixed.picture), readTexture("plain", plain.picture.value()), 2);
    EXPECT_TRUE(agreement.holds()) << path << ": " << agreement.over;
  }
}

TEST_F(Devices, WithoutWideLinesSaySo) {
  const auto wire = [&](const char* width) {
    return withSettings(render, {"view.wireframe=true", std::string("view.line_width=") + width});
  };
  const Run thin = run(wire("1"), {});
  const Run poor = run(wire("5"), {"SPECULUM_HIDE=wide_lines"}, Place::inner);
  expectLine(poor, 0, "has no lines 5 pixels wide: 1 is used");
  EXPECT_TRUE(poor.picture == thin.picture);
  expectQuiet(run(wire("5"), {"SPECULUM_HIDE=VK_EXT_extended_dynamic_state3"}, Place::inner));
}

TEST_F(Devices, WithoutAnisotropicFilterShadersMixLookups) {
  const auto with = [&](const char* filter) {
    return withSettings(render, {std::string("view.texture_filter=") + filter, "effects.shadows=false"});
  };
  const Run poor = run(with("anisotropic"), {"SPECULUM_HIDE=anisotropy"}, Place::inner);
  expectQuiet(poor);
  EXPECT_FALSE(poor.picture == run(with("trilinear"), {}).picture);
}

TEST_F(Devices, NoImageForAMinuteIsSaid) {
  const Run covered = run(window, {"SPECULUM_HIDE=images=70"}, Place::inner);
  expectLine(covered, 0, "no image to draw into for a minute");
}

TEST_F(Devices, EveryPipelineGoesThroughTheCache) {
  std::map<std::string, int> calls = callsOf(window);
  EXPECT_GT(calls["vkCreateGraphicsPipelines"], 3);
  EXPECT_EQ(calls.at("pipelines_without_cache"), 0) << "those of Dear ImGui too";
}

// Also in the window, without a budget and while debug.check_finite is on, so that no system ends a draw for taking
// long.
TEST_F(Devices, LongDrawsAreSubmittedInParts) {
  addToScene(smallRoughMirror);
  const auto submissions = [&](const Kind& kind, const std::vector<std::string>& settings) {
    return callsOf(withSettings(kind, settings))["vkQueueSubmit"];
  };
  const auto inWindow = [&](const std::string& roughSamples) {
    return submissions(window, {"quality.motion_ms=0", "effects.rough_samples=" + roughSamples});
  };
  const int whole = inWindow("1");
  EXPECT_GT(inWindow("500"), whole + 4);
  addToScene("[[object]] model = \"MODELS/sphere.obj\", position = [1, 1, 0], scale = 0.3, mirror = {}\n");
  const auto withFaces = [&](const std::string& size) {
    return submissions(
        render, {"effects.curved_lookup=environment", "effects.rough_samples=100", "effects.environment_size=" + size});
  };
  const int small = withFaces("64");
  EXPECT_GE(withFaces("512"), small + 4) << "faces of a map";
}

}  // namespace
}  // namespace speculum
