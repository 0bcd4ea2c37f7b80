// An effect that nothing calls for costs nothing. Objects and draws are counted where the program calls Vulkan, by
// linking those calls through functions of this file.
#include "cli/stats.hpp"
#include "picture_support.hpp"
#include "sampling.hpp"
#include "test_headers.hpp"

namespace {

struct Counts {
  std::map<std::string, int> created;
  std::map<std::string, int> alive;
  int draws = 0;

  void create(const char* kind, int count = 1) {
    created[kind] += count;
    alive[kind] += count;
  }
  void destroy(const char* kind, bool exists) { alive[kind] -= exists; }
};

Counts counts;

}  // namespace

// The linker's --wrap leads calls of NAME to __wrap_NAME, and __real_NAME to the loader.
extern "C" {
#define SPECULUM_COUNT_OBJECT(Kind)                                                                               \
  VkResult __real_vkCreate##Kind(VkDevice, const Vk##Kind##CreateInfo*, const VkAllocationCallbacks*, Vk##Kind*); \
  VkResult __wrap_vkCreate##Kind(VkDevice device, const Vk##Kind##CreateInfo* info,                               \
                                 const VkAllocationCallbacks* allocator, Vk##Kind* object) {                      \
    counts.create(#Kind);                                                                                         \
    return __real_vkCreate##Kind(device, info, allocator, object);                                                \
  }                                                                                                               \
  void __real_vkDestroy##Kind(VkDevice, Vk##Kind, const VkAllocationCallbacks*);                                  \
  void __wrap_vkDestroy##Kind(VkDevice device, Vk##Kind object, const VkAllocationCallbacks* allocator) {         \
    counts.destroy(#Kind, object != VK_NULL_HANDLE);                                                              \
    __real_vkDestroy##Kind(device, object, allocator);                                                            \
  }
SPECULUM_COUNT_OBJECT(Buffer)
SPECULUM_COUNT_OBJECT(Image)
SPECULUM_COUNT_OBJECT(ShaderModule)
SPECULUM_COUNT_OBJECT(DescriptorSetLayout)
#undef SPECULUM_COUNT_OBJECT

VkResult __real_vkCreateGraphicsPipelines(VkDevice, VkPipelineCache, uint32_t, const VkGraphicsPipelineCreateInfo*,
                                          const VkAllocationCallbacks*, VkPipeline*);
VkResult __wrap_vkCreateGraphicsPipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                          const VkGraphicsPipelineCreateInfo* infos,
                                          const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
  counts.create("Pipeline", static_cast<int>(count));
  return __real_vkCreateGraphicsPipelines(device, cache, count, infos, allocator, pipelines);
}
VkResult __real_vkCreateComputePipelines(VkDevice, VkPipelineCache, uint32_t, const VkComputePipelineCreateInfo*,
                                         const VkAllocationCallbacks*, VkPipeline*);
VkResult __wrap_vkCreateComputePipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                         const VkComputePipelineCreateInfo* infos,
                                         const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
  counts.create("Pipeline", static_cast<int>(count));
  return __real_vkCreateComputePipelines(device, cache, count, infos, allocator, pipelines);
}
void __real_vkDestroyPipeline(VkDevice, VkPipeline, const VkAllocationCallbacks*);
void __wrap_vkDestroyPipeline(VkDevice device, VkPipeline pipeline, const VkAllocationCallbacks* allocator) {
  counts.destroy("Pipeline", pipeline != VK_NULL_HANDLE);
  __real_vkDestroyPipeline(device, pipeline, allocator);
}
void __real_vkCmdDraw(VkCommandBuffer, uint32_t, uint32_t, uint32_t, uint32_t);
void __wrap_vkCmdDraw(VkCommandBuffer commands, uint32_t vertices, uint32_t instances, uint32_t first, uint32_t base) {
  ++counts.draws;
  __real_vkCmdDraw(commands, vertices, instances, first, base);
}
void __real_vkCmdDrawIndexed(VkCommandBuffer, uint32_t, uint32_t, uint32_t, int32_t, uint32_t);
void __wrap_vkCmdDrawIndexed(VkCommandBuffer commands, uint32_t indices, uint32_t instances, uint32_t first,
                             int32_t offset, uint32_t base) {
  ++counts.draws;
  __real_vkCmdDrawIndexed(commands, indices, instances, first, offset, base);
}
}

namespace speculum {
namespace {

using namespace testing_support;

constexpr PictureSize size{48, 27};

// Two scenes with an effect: nothing visible needs it in `uncalled`, something does in `called`. That takes more Vulkan
// objects of these kinds.
struct Case {
  const char* effect;
  std::string uncalled;
  std::string called;
  std::vector<std::string> objects{"Buffer", "Pipeline"};

  bool needs(const std::string& kind) const { return std::ranges::find(objects, kind) != objects.end(); }
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.effect;
}

std::filesystem::path sceneWith(const std::string& name, const std::string& rest) {
  std::ofstream(sceneDirectory() / "pane.mtl") << "newmtl m\nd 0.5\n";
  std::ofstream(sceneDirectory() / "pane.obj")
      << "mtllib pane.mtl\nusemtl m\nv -1 0 0\nv 1 0 0\nv 1 2 0\nv -1 2 0\nf 1 2 3 4\n";
  return writeScene("ledger_" + name, R"(
[environment] background = [0.3, 0.4, 0.5], ambient = [0.1, 0.1, 0.1]
[camera] position = [0, 1, 3], target = [0, 0.5, 0]
[[object]] model = "MODELS/teapot.obj"
)" + rest);
}

Options optionsFor(const std::filesystem::path& file, const SettingList& more = {}) {
  Options options = headless(file, size);
  // Switches off the check for finite values, which has objects of its own.
  set(options, {{"debug.check_finite", "false"}});
  set(options, more);
  return options;
}

// Returns the options with the effect switched off.
Options without(Options options, const std::string& effect) {
  set(options, {{"effects." + effect, "false"}});
  return options;
}

// A session with a device of its own, which keeps nothing of other pictures.
struct OwnDevice {
  Device own;
};
struct FreshSession : OwnDevice, QuietSession {
  explicit FreshSession(const Options& options)
      : OwnDevice{Device(deviceOptions(options, nullptr))}, QuietSession(options, &own) {}
};

// Frames after which everything idle is released, and those after which targets are.
constexpr int untilIdle = 130;
constexpr int untilTargetsAreFreed = 40;

struct Drawn {
  std::map<std::string, int> alive;  // objects after the frames
  int draws = 0;                     // of the last frame
  std::vector<uint8_t> picture;

  // Shader modules and layouts stay, because they cost a frame nothing.
  std::map<std::string, int> released(const Drawn& before) const {
    std::map<std::string, int> kept = alive;
    for (const char* kind : {"ShaderModule", "DescriptorSetLayout"}) {
      kept[kind] = before.alive.at(kind);
    }
    return kept;
  }
};

Drawn drawFrames(Session& session, int frames) {
  for (int i = 1; i <= frames; ++i) {
    counts.draws = 0;
    session.draw(0.0, i + 1 >= frames);  // by both frames in flight
    session.finish();
  }
  return {counts.alive, counts.draws, session.picture().rgba};
}

Drawn drawWith(Session& session, const std::string& effect, bool on, int frames) {
  set(session, {{"effects." + effect, on ? "true" : "false"}});
  return drawFrames(session, frames);
}

nlohmann::ordered_json effectStats(Session& session, const std::string& effect) {
  const nlohmann::ordered_json stats = frameStats(session);
  for (const auto& line : stats.at("effects")) {
    if (line.at("name") == effect) {
      return line;
    }
  }
  ADD_FAILURE() << "no effect " << effect;
  return {};
}

// Draws one frame with and without the effect. Expects that nothing is made or drawn for it and the pictures are equal.
void expectFree(const Options& options, const std::string& effect) {
  const auto run = [](const Options& drawn) {
    counts = {};
    FreshSession session(drawn);
    std::vector<uint8_t> picture = drawFrames(session, 1).picture;
    return std::tuple(counts.created, counts.draws, picture);
  };
  EXPECT_EQ(run(options), run(without(options, effect)));
}

class Ledger : public testing::TestWithParam<Case> {
 protected:
  const std::string effect_ = GetParam().effect;
};

TEST_P(Ledger, UncalledEffectCostsNothing) {
  expectFree(optionsFor(sceneWith(effect_ + "_uncalled", GetParam().uncalled)), effect_);
}

TEST_P(Ledger, CalledEffectIsListedAndReleased) {
  counts = {};
  FreshSession session(without(optionsFor(sceneWith(effect_ + "_called", GetParam().called)), effect_));
  const Drawn before = drawWith(session, effect_, false, 3);
  const Drawn during = drawWith(session, effect_, true, 1);
  for (const std::string& kind : GetParam().objects) {
    EXPECT_GT(during.alive.at(kind), before.alive.at(kind)) << kind;
  }
  EXPECT_NE(during.picture, before.picture) << "the effect shows nothing";
  const nlohmann::ordered_json line = effectStats(session, effect_);
  EXPECT_EQ(line.at("called_for"), true) << line;
  EXPECT_EQ(line.at("bytes") > 0, GetParam().needs("Buffer") || GetParam().needs("Image")) << line;
  EXPECT_GT(line.at("draws"), 0) << line;
  EXPECT_EQ(line.at("pipelines") > 0, GetParam().needs("Pipeline")) << line;
  const Drawn after = drawWith(session, effect_, false, untilIdle);
  EXPECT_EQ(after.released(before), before.alive);
  EXPECT_EQ(after.draws, before.draws);
  EXPECT_EQ(after.picture, before.picture);
}

std::string effectName(const testing::TestParamInfo<Case>& info) {
  return info.param.effect;
}

const std::string away = "[[mirror]] position = [0, 1, 5], size = [2, 2], ";     // behind the eye
const std::string before = "[[mirror]] position = [0, 1, -1], size = [2, 2], ";  // in view

const std::vector<Case> cases = {
    Case{"shadows", "[[light]] position = [1, 2, 1], intensity = 0, casts_shadow = true\n",
         "[[light]] position = [1, 2, 1], intensity = 9, casts_shadow = true\n"},
    Case{"roughness", away + "roughness = 0.3\n", before + "roughness = 0.3\n"},
    Case{"ripple", away + "ripple = { amplitude = 0.02 }\n", before + "ripple = { amplitude = 0.02 }\n"},
    Case{"casts_light", "[[light]] position = [0, 2, -3], intensity = 9\n" + before + "casts_light = true\n",
         "[[light]] position = [0, 2, 1], intensity = 9\n" + before + "casts_light = true\n"},
    Case{"curved", "[[object]] model = 'MODELS/sphere.obj', position = [0, 1, 5], mirror = {}\n",
         "[[object]] model = 'MODELS/sphere.obj', position = [0.8, 1, 0], mirror = {}\n"},
    Case{"fresnel",
         away + "fresnel = 'schlick'\n",
         "[[mirror]] position = [0, 0.1, 0], rotation = [-90, 0, 0], size = [4, 4], fresnel = 'schlick', "
         "reflectance = [0.3, 0.3, 0.3]\n",
         {}},
    Case{"textures",
         "[[object]] model = 'MODELS/chequer.obj', position = [0, 0, 9]\n",
         "[[object]] model = 'MODELS/chequer.obj'\n",
         {"Image", "Pipeline"}},
    Case{"transparency",
         "[[object]] model = 'pane.obj', position = [0, 0, 9]\n",
         "[[object]] model = 'pane.obj', position = [0, 0, 1]\n",
         {"Pipeline"}},
    Case{"glyphs",
         "[[light]] position = [0, 1, 5], radius = 0.2, glow = 2\n",
         "[[light]] position = [0, 1, 1], radius = 0.2, glow = 2\n",
         {"Pipeline"}}};

INSTANTIATE_TEST_SUITE_P(Effects, Ledger, testing::ValuesIn(cases), effectName);

class UnseenLedger : public Ledger {};

TEST_P(UnseenLedger, EffectIsReleased) {
  counts = {};
  FreshSession session(without(optionsFor(sceneWith(effect_ + "_unseen", GetParam().called)), effect_));
  const Drawn before = drawFrames(session, 3);
  const CameraPose away = lookAt({0, 1, 3}, {0, 1, 9}, {0, 1, 0}, 60, 0.001);
  session.setCamera(away);
  const Drawn empty = drawFrames(session, untilTargetsAreFreed);
  session.setCamera(std::nullopt);
  EXPECT_NE(drawWith(session, effect_, true, 1).picture, before.picture);
  session.setCamera(away);
  const Drawn turned = drawFrames(session, untilIdle);
  EXPECT_EQ(turned.picture, empty.picture);
  const nlohmann::ordered_json unseen = effectStats(session, effect_);
  EXPECT_EQ(unseen.at("called_for"), false) << unseen;
  for (const char* cost : {"draws", "bytes", "pipelines"}) {
    EXPECT_EQ(unseen.at(cost), 0) << unseen;
  }
  EXPECT_EQ(turned.alive.at("Buffer"), empty.alive.at("Buffer"));
  EXPECT_EQ(turned.alive.at("Image"), empty.alive.at("Image"));
  EXPECT_LE(turned.alive.at("Pipeline"), empty.alive.at("Pipeline"));
}

INSTANTIATE_TEST_SUITE_P(Effects, UnseenLedger,
                         testing::ValuesIn(fullTests() ? cases : std::vector{cases[0], cases[2], cases[6]}),
                         effectName);

TEST(Ledger, EachEffectReleasesItsOwn) {
  const std::filesystem::path file =
      sceneWith("two_effects",
                "[[light]]\nposition = [1, 2, 1]\nintensity = 9\ncasts_shadow = true\n[[light]]\n"
                "position = [0, 2, 1]\nintensity = 9\n[[mirror]]\nposition = [0, 1, -1]\nsize = [2, 2]\n"
                "casts_light = true\n");
  counts = {};
  Drawn never;
  {
    FreshSession session(optionsFor(file));
    never = drawWith(session, "shadows", false, 3);
  }
  counts = {};
  FreshSession session(optionsFor(file));
  const EffectLedger& ledger = session.sceneRenderer().ledger();
  drawWith(session, "shadows", true, 3);
  EXPECT_GT(ledger[EffectKind::shadows].pipelines, 0u);
  const Drawn after = drawWith(session, "shadows", false, untilIdle);
  EXPECT_EQ(ledger[EffectKind::shadows].pipelines, 0u);
  EXPECT_GT(ledger[EffectKind::castsLight].pipelines, 0u);
  EXPECT_EQ(after.alive.at("Buffer"), never.alive.at("Buffer"));
  EXPECT_EQ(after.alive.at("Pipeline"), never.alive.at("Pipeline"));
}

TEST(Ledger, BackgroundAloneIsClearedNotToneMapped) {
  FreshSession session(optionsFor(sceneWith("cleared", ""), {{"view.tone_map", "aces"}}));
  const auto draws = [&] {
    session.draw(0.0, true);
    return session.sceneRenderer().ledger()[EffectKind::toneMap].draws;
  };
  EXPECT_EQ(draws(), 1u);
  session.setCamera(lookAt({0, 1, 3}, {0, 1, 9}, {0, 1, 0}, 60, 0.001));
  EXPECT_EQ(draws(), 0u);
}

// At the depth limit a rough mirror has no reflection that could be blurred.
TEST(Ledger, RoughnessWithoutReflectionCostsNothing) {
  expectFree(optionsFor(sceneWith("rough_deep",
                                  "[[mirror]]\nposition = [0, 1, -1]\nsize = [2, 2]\nroughness = 0.3\n"
                                  "base_color = [0.3, 0, 0]\n"),
                        {{"reflection.max_depth", "0"}}),
             "roughness");
}

// Draws a scene before, while and after the effect looks up a map of so many faces of 256 x 256 texels. Returns what
// its first frame cost. Afterwards a pipeline may stay if `keepsPipeline`.
EffectCost expectMapReleased(const Options& options, EffectKind kind, const std::string& effect, int faces, int buffers,
                             bool keepsPipeline) {
  constexpr int texelBytes = 8 + 4;
  counts = {};
  FreshSession session(without(options, effect));
  const Drawn before = drawWith(session, effect, false, 3);
  const Drawn during = drawWith(session, effect, true, 1);
  const EffectCost cost = session.sceneRenderer().ledger()[kind];
  EXPECT_EQ(during.alive.at("Image"), before.alive.at("Image") + 2) << "all faces side by side, and their depth";
  EXPECT_EQ(during.alive.at("Buffer"), before.alive.at("Buffer") + buffers) << "the map's own, but none to trace";
  EXPECT_GE(cost.bytes, static_cast<uint64_t>(faces * 256 * 256 * texelBytes));
  EXPECT_GT(during.draws, before.draws);
  EXPECT_NE(during.picture, before.picture);
  const Drawn still = drawWith(session, effect, true, 2);
  EXPECT_EQ(still.picture, during.picture);
  EXPECT_EQ(still.draws, before.draws) << "an unchanged map is not drawn again";
  const Drawn after = drawWith(session, effect, false, untilIdle);
  std::map<std::string, int> alive = after.released(before);
  if (keepsPipeline) {
    EXPECT_LE(alive.at("Pipeline"), before.alive.at("Pipeline") + 1);
    alive["Pipeline"] = before.alive.at("Pipeline");
  }
  EXPECT_EQ(alive, before.alive);
  EXPECT_EQ(after.picture, before.picture);
  EXPECT_EQ(session.sceneRenderer().ledger()[kind].bytes, 0u);
  return cost;
}

TEST(Ledger, EnvironmentMapsAreListedAndReleased) {
  const Options options = optionsFor(
      sceneWith("environment", "[[object]]\nmodel = \"MODELS/sphere.obj\"\nposition = [0.8, 1, 0]\nmirror = {}\n"),
      {{"effects.curved_lookup", "environment"}});
  // A pipeline of one sample that drew the faces stays.
  const EffectCost cost = expectMapReleased(options, EffectKind::curved, "curved", 6, 0, true);
  EXPECT_EQ(cost.pipelines, 1u);
  EXPECT_GT(static_cast<int>(cost.draws), 1) << "the faces' draws as well";
}

TEST(Ledger, ShadowMapsAreListedAndReleased) {
  const Options options =
      optionsFor(sceneWith("shadow_maps", "[[light]]\nposition = [1, 2, 1]\nintensity = 9\ncasts_shadow = true\n"),
                 {{"effects.shadow_lookup", "map"}, {"effects.shadow_map_size", "256"}});
  // The buffer holds the faces' windows.
  // Two of the map's faces show no caster.
  const EffectCost cost = expectMapReleased(options, EffectKind::shadows, "shadows", 4, 1, false);
  EXPECT_GE(cost.pipelines, 2u) << "of the faces and of the teapot";
}

TEST(Ledger, HybridShadowsAreReleased) {
  const Options options =
      optionsFor(sceneWith("hybrid_shadows", "[[light]]\nposition = [1, 2, 1]\nintensity = 9\ncasts_shadow = true\n"),
                 {{"effects.shadow_lookup", "hybrid"}, {"effects.shadow_map_size", "auto"}});
  counts = {};
  FreshSession session(without(options, "shadows"));
  const Drawn before = drawWith(session, "shadows", false, 3);
  const Drawn during = drawWith(session, "shadows", true, 1);
  EXPECT_NE(during.picture, before.picture);
  const EffectCost cost = session.sceneRenderer().ledger()[EffectKind::shadows];
  EXPECT_GE(cost.pipelines, 4u) << "of the faces, their edges, the teapot and deferred shading";
  const Drawn after = drawWith(session, "shadows", false, untilIdle);
  EXPECT_EQ(after.released(before), before.alive);
  EXPECT_EQ(after.picture, before.picture);
  EXPECT_EQ(session.sceneRenderer().ledger()[EffectKind::shadows].bytes, 0u);
}

// Drivers that compile shaders while they draw would stutter.
TEST(Ledger, VisibleLightsNeedNoPipelines) {
  std::string lights;
  for (const std::string x : {"-2", "0", "2"}) {
    lights += "[[light]]\nposition = [" + x +
              ", 0.5, 1]\nradius = 0.1\ncasts_shadow = " + (x == "0" ? "true" : "false") + "\n";
  }
  FreshSession session(optionsFor(sceneWith("visible_lights", lights),
                                  {{"effects.shadow_lookup", "map"}, {"effects.shadow_map_size", "256"}}));
  std::vector<int> pipelines;
  for (const double x : {-1.2, 0.0, 1.2}) {
    session.setCamera(lookAt({0.0, 1.0, 4.0}, {x, 0.5, 0.0}, {0.0, 1.0, 0.0}, 40.0, 0.1));
    drawFrames(session, 2);
    pipelines.push_back(counts.created["Pipeline"]);
  }
  EXPECT_EQ(pipelines, std::vector(3, pipelines.front()));
}

}  // namespace
}  // namespace speculum
