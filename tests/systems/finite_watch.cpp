// debug.check_finite finds and names values that are not finite, and costs nothing when it is off.
#include <glm/gtc/packing.hpp>

#include "log_capture.hpp"
#include "picture_support.hpp"
#include "platform/files.hpp"
#include "sampling.hpp"
#include "test_headers.hpp"

namespace speculum::finite_watch {
namespace {

using namespace testing_support;
namespace fs = std::filesystem;

constexpr PictureSize size{64, 36};

// Findings are errors in the log; here they are expected and would hide the test's own output.
class Watch : public testing::Test {
  const LogCapture log_;
};

// Images made by hand, checked as targets are.
class WatchedImages : public Watch {
 protected:
  using Texels = std::vector<std::array<uint16_t, 4>>;

  // Each image in turn is the target of a pass with its number.
  std::vector<NonFinite> check(const std::vector<Texels>& images, VkExtent2D extent, VkExtent2D used) {
    std::vector<Image> targets;
    for (const Texels& texels : images) {
      targets.push_back(
          renderer_.uploader().image(std::as_bytes(std::span(texels)), extent, colorFormat, false, "checked"));
    }
    FiniteWatch watch(renderer_);
    Frame frame = renderer_.beginFrame().value();
    watch.begin(frame, targets.size());
    for (size_t i = 0; i < targets.size(); ++i) {
      watch.check(frame, {{.path = {static_cast<int>(i)}}, std::to_string(i)}, false, targets[i],
                  targets[i].descriptor(sampler_.get()), used);
    }
    watch.end(frame);
    renderer_.endFrame(frame);
    renderer_.waitIdle();
    watch.collect();
    uint64_t sum = 0;
    for (const NonFinite& found : watch.findings()) {
      sum += found.count;
    }
    EXPECT_EQ(watch.count(), sum);
    EXPECT_EQ(device_.validationMessages(), 0);
    return watch.findings();
  }

  Device device_{{.validation = true}};
  Renderer renderer_{device_, {.extent = {1, 1}}};
  SamplerHandle sampler_ = createSampler(device_, {}, "checked");
};

bool allowed(uint16_t half) {
  const float value = glm::unpackHalf1x16(half);
  return value >= 0.0f && value <= 65504.0f;
}

// All 65536 half floats, scattered over the image, in one channel after the other.
TEST_F(WatchedImages, EveryHalfFloatIsJudgedPerChannel) {
  constexpr VkExtent2D extent{256, 256};
  std::vector<Texels> images(4, Texels(65536, {0, 0x3c00, 0x7bff, 0x8000}));
  std::array<int, 4> first{-1, -1, -1, -1};
  std::array<uint64_t, 4> counts{};
  for (int channel = 0; channel < 4; ++channel) {
    for (int i = 0; i < 65536; ++i) {
      const auto half = static_cast<uint16_t>(40503u * static_cast<uint32_t>(i) + 9u * channel + 100u);
      images[channel][i][channel] = half;
      const bool bad = !allowed(channel == 3 ? half & 0x7fff : half);  // a negative disparity is outside a mirror
      counts[channel] += bad ? 1 : 0;
      first[channel] = first[channel] < 0 && bad ? i : first[channel];
    }
  }
  const std::vector<NonFinite> found = check(images, extent, extent);
  ASSERT_EQ(found.size(), 4u);
  for (int channel = 0; channel < 4; ++channel) {
    EXPECT_EQ(found[channel].pass, std::to_string(channel));
    EXPECT_EQ(found[channel].id.path, MirrorPath{channel});
    EXPECT_EQ(found[channel].count, counts[channel]);
    EXPECT_EQ(found[channel].y * 256 + found[channel].x, first[channel]);
    const float expected = glm::unpackHalf1x16(images[channel][first[channel]][channel]);
    EXPECT_TRUE(found[channel].value[channel] == expected ||
                (std::isnan(expected) && std::isnan(found[channel].value[channel])));
  }
}

TEST_F(WatchedImages, OnlyThePartInUseIsChecked) {
  constexpr VkExtent2D extent{64, 32};
  constexpr VkExtent2D used{37, 19};
  constexpr std::array<uint16_t, 4> bad = {0, 0, 0x7e00, 0};
  Texels texels(extent.width * extent.height, bad);
  for (uint32_t i = 0; i < used.width * used.height; ++i) {
    texels[i / used.width * extent.width + i % used.width] = {};
  }
  EXPECT_TRUE(check({texels}, extent, used).empty());
  Texels corner = texels;
  corner[(used.height - 1) * extent.width + used.width - 1] = bad;
  const std::vector<NonFinite> found = check({texels, corner, texels}, extent, used);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].pass, "1");
  EXPECT_EQ(found[0].x, 36);
  EXPECT_EQ(found[0].y, 18);
  EXPECT_EQ(found[0].sample, 0);
  EXPECT_EQ(found[0].count, 1u);
  EXPECT_TRUE(std::isnan(found[0].value.b));
}

// The eye before a mirror, and between two that face each other, under a sky that nothing hides.
const std::string wall = R"(
[environment] sky = { zenith = [0.1, 0.2, 0.9], horizon = [0.9, 0.8, 0.3], ground = [0.2, 0.5, 0.1] }
[camera] position = [0, 1, 1], target = [0.2, 1, -2]
[settings] "reflection.max_depth" = 2
[[light]] position = [0, 3, 0]
[[mirror]] name = "front", position = [0, 1, -2], size = [2, 2]
)";
const std::string rear = R"([[mirror]] name = "rear", position = [0, 1, 4], rotation = [0, 180, 0]
  size = [6, 6]
)";
const std::string hall = wall + rear;

// A folder with the program's shaders, changed so that the sky has one wrong value in one pass. The scenes have one
// light, so a view's first light is the view's index.
class BrokenSky {
 public:
  BrokenSky(int pass, int x, int y, int sample, const std::string& value) {
    writeShaders(directory_.path(), "sky.frag",
                 "  if (view.firstLight == " + std::to_string(pass) + " && ivec2(gl_FragCoord.xy) == ivec2(" +
                     std::to_string(x) + ", " + std::to_string(y) + ") && gl_SampleID == " + std::to_string(sample) +
                     ") color.g = " + value + ";\n");
  }
  fs::path path() const { return directory_.path(); }

 private:
  TemporaryDirectory directory_;
};

Options watched(const std::string& scene, const std::string& name, const BrokenSky& sky, RenderPath path, int samples) {
  Options options = headless(writeScene("watched_" + name, scene), size);
  options.renderPath = path;
  options.shaderDir = sky.path();
  set(options, {{"view.samples", std::to_string(samples)}, {"reflection.samples", std::to_string(samples)}});
  return options;
}

const FiniteWatch& drawWatched(Session& session, double time = 0.0) {
  runFrames(session, 1, time);
  EXPECT_EQ(session.device().validationMessages(), 0);
  return session.sceneRenderer().finiteWatch();
}

struct BrokenSample {
  RenderPath path;
  int samples;
  bool negative;

  std::string name() const {
    return std::string(renderPathName(path)) + std::to_string(samples) + (negative ? "negative" : "nan");
  }
};

class BrokenPass : public Watch, public testing::WithParamInterface<BrokenSample> {
 protected:
  const int samples_ = GetParam().samples;
  const bool negative_ = GetParam().negative;
  // NaN goes through storable(), which must not hide it.
  const char* const value_ =
      negative_ ? "-0.25" : "storable(vec3(uintBitsToFloat(0x7fc00000u | view.firstLight)), 0.0, gl_FragCoord.xy).g";
  void expectFinding(const NonFinite& found, int x, int y) const {
    EXPECT_EQ(std::tuple(found.x, found.y, found.sample, found.count), std::tuple(x, y, samples_ - 1, uint64_t{1}));
    EXPECT_TRUE(negative_ ? found.value.g == -0.25f : std::isnan(found.value.g)) << found.value.g;
    EXPECT_GE(found.value.r, 0.0f);
  }
};

TEST_P(BrokenPass, IsNamedWithItsMirrorsAndPixel) {
  // Passes are recorded in this order: the rear mirror's seen in the front one, the front one's, the main view.
  const BrokenSky sky(0, 5, 3, samples_ - 1, value_);
  Session session(watched(hall, "nested_" + GetParam().name(), sky, GetParam().path, samples_));
  const FiniteWatch& watch = drawWatched(session);
  ASSERT_EQ(session.lastFrame().plan.drawnMirrors().size(), 2u);
  ASSERT_FALSE(watch.findings().empty());
  const NonFinite& found = watch.findings().front();
  EXPECT_EQ(found.pass, "mirror front > rear");
  EXPECT_EQ(found.id.path, (MirrorPath{0, 1}));
  expectFinding(found, 5, 3);
  EXPECT_TRUE(startsWith(describe(found),
                         "mirror front > rear: pixel 5, 3, sample " + std::to_string(samples_ - 1) + ": radiance "));
  EXPECT_EQ(session.exitCode(), 1);
}

TEST_P(BrokenPass, MainViewIsFoundInItsSamples) {
  const BrokenSky sky(2, 60, 34, samples_ - 1, value_);
  Session session(watched(hall, "main_" + GetParam().name(), sky, GetParam().path, samples_));
  const FiniteWatch& watch = drawWatched(session);
  ASSERT_FALSE(watch.findings().empty());
  const NonFinite& found = watch.findings().front();
  EXPECT_EQ(found.pass, samples_ > 1 ? "main view (samples)" : "main view");
  EXPECT_EQ(found.id.kind, PassKind::main);
  expectFinding(found, 60, 34);
  // The mean of four samples hides a negative value but not NaN.
  EXPECT_EQ(watch.findings().size(), samples_ > 1 && !negative_ ? 2u : 1u);
}

// Unless all run, each pair of values comes once.
std::vector<BrokenSample> brokenPasses() {
  std::vector<BrokenSample> passes;
  for (const RenderPath path : {RenderPath::dynamic, RenderPath::renderPass}) {
    for (const int samples : {1, 4}) {
      for (const bool negative : {false, true}) {
        if (fullTests() || negative == ((path == RenderPath::dynamic) == (samples == 4))) {
          passes.push_back({path, samples, negative});
        }
      }
    }
  }
  return passes;
}

INSTANTIATE_TEST_SUITE_P(Values, BrokenPass, testing::ValuesIn(brokenPasses()),
                         [](const auto& info) { return info.param.name(); });

using WatchedFrames = Watch;

// A cached image is checked when it is rendered, not again in each frame that reuses it.
TEST_F(WatchedFrames, CachedImagesAreCheckedWhenRendered) {
  const BrokenSky sky(0, 5, 3, 0, "-1.0");
  Options options = watched(wall, "cached", sky, RenderPath::automatic, 1);
  set(options, {{"reflection.update_interval", "3"}, {"reflection.skip_unchanged", "false"}});
  Session session(options);
  int rendered = 0;
  for (uint64_t frame = 1; frame <= 9; ++frame) {
    const FiniteWatch& watch = drawWatched(session);
    const bool fresh = !session.lastFrame().plan.drawnMirrors().empty();
    rendered += fresh ? 1 : 0;
    // Without mirror passes the main view is the first view; it shows the sky at the same texel.
    ASSERT_EQ(watch.findingsFrame(), frame);
    EXPECT_EQ(watch.findings().front().pass, fresh ? "mirror front" : "main view");
    EXPECT_EQ(watch.findings().size(), 1u);
    EXPECT_EQ(watch.count(), frame);
  }
  EXPECT_GE(rendered, 3);
  EXPECT_LE(rendered, 4);
}

TEST_F(WatchedFrames, StayFoundWhenLaterOnesAreClean) {
  const BrokenSky sky(0, 5, 3, 0, "-1.0");
  Session session(watched(hall, "later", sky, RenderPath::automatic, 1));
  EXPECT_EQ(drawWatched(session).count(), 1u);
  set(session, {{"view.clear_color", "0.5,0.5,0.5"}});  // no sky
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(drawWatched(session).count(), 1u);
  }
  EXPECT_EQ(session.sceneRenderer().finiteWatch().findingsFrame(), 1u);
  set(session, {{"debug.check_finite", "false"}});
  EXPECT_EQ(drawWatched(session).count(), 1u);
  EXPECT_EQ(session.exitCode(), 1);
}

// Shader modules stay in their library, the others with the device.
std::map<std::string, int64_t> objectsThatGo() {
  std::map<std::string, int64_t> objects = liveObjects();
  for (const char* kept : {"VkShaderModule", "VkDescriptorSetLayout", "VkPipeline", "VkPipelineLayout"}) {
    objects.erase(kept);
  }
  return objects;
}

TEST_F(WatchedFrames, CostNothingWhenTheCheckIsOff) {
  Session session(headless(writeScene("hall_off", hall), size, {{"debug.check_finite", "false"}}));
  const auto drawFrames = [&](bool checked) {
    set(session, {{"debug.check_finite", checked ? "true" : "false"}});
    for (int i = 0; i < 4; ++i) {
      drawWatched(session);
    }
  };
  drawFrames(false);
  const auto objects = objectsThatGo();
  const size_t pipelines = session.renderer().pipelines().count();
  const uint64_t bytes = session.device().allocatedBytes();
  drawFrames(true);
  EXPECT_NE(objectsThatGo(), objects);
  EXPECT_GT(session.renderer().pipelines().count(), pipelines);
  drawFrames(false);
  EXPECT_EQ(objectsThatGo(), objects);
  EXPECT_EQ(session.renderer().pipelines().count(), pipelines);
  EXPECT_EQ(session.device().allocatedBytes(), bytes);
}

TEST_F(WatchedFrames, ShowTheSameBytesAsUnwatchedOnes) {
  Options options = headless(writeScene("hall_same", hall), size);
  const Image8 checked = draw(options);
  set(options, {{"debug.check_finite", "false"}});
  EXPECT_EQ(draw(options).rgba, checked.rgba);
}

class CheckBarrier : public Watch, public testing::WithParamInterface<BarrierKind> {};

const std::string shadow = R"([[light]] position = [1, 3, 0], casts_shadow = true
[[object]] model = "MODELS/teapot.obj", position = [0, 0, -1]
)";

// Draws three frames with images and a main view of `samples`. Returns the first message of the validation layer.
std::string messageWithout(const std::string& kind, const fs::path& scene, const std::string& samples) {
  const LogCapture log;
  Options options = headless(scene, size);
  options.renderPath = RenderPath::renderPass;
  set(options, {{"debug.omit_barrier", kind}, {"view.samples", samples}, {"reflection.samples", samples}});
  Session session(options);
  for (int i = 0; i < 3; ++i) {
    session.draw(0.0, false);
  }
  session.finish();
  return log.validationMessage();
}

TEST_P(CheckBarrier, IsMissedWhenLeftOut) {
  const std::string kind(barrierName(GetParam()));
  const fs::path scene = writeScene("hall_" + kind, hall + shadow);
  // Unless all run, kinds are left out in turn at one sample and at four.
  const bool single = static_cast<int>(GetParam()) % 2 == 0;
  for (const char* samples : fullTests() ? std::vector{"1", "4"} : std::vector{single ? "1" : "4"}) {
    const std::string message = messageWithout(kind, scene, samples);
    EXPECT_TRUE(contains(message, "SYNC-HAZARD")) << samples << " samples: " << message;
  }
}

TEST_F(WatchedFrames, AllBarriersInPlaceGiveNoMessage) {
  for (const char* samples : {"1", "4"}) {
    EXPECT_EQ(messageWithout("", writeScene("hall_whole", hall + shadow), samples), "") << samples;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, CheckBarrier,
                         testing::Values(BarrierKind::targetToCheck, BarrierKind::checkToLookUp,
                                         BarrierKind::checkToWrite, BarrierKind::surfacesToShade,
                                         BarrierKind::shadedToDraw),
                         [](const auto& info) { return std::string(barrierName(info.param)); });

}  // namespace
}  // namespace speculum::finite_watch
