// What an effect costs when nothing calls for it: nothing. Objects and draws are counted where the program meets
// Vulkan, by linking its calls through functions of this file.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "app/stats.hpp"
#include "picture_support.hpp"

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

constexpr PictureSize size{160, 90};

// `uncalled` asks for the effect where nothing that is seen needs it, `called` where something does; what is seen of it
// takes more objects of these kinds.
struct Case {
  const char* effect;
  const char* uncalled;
  const char* called;
  std::vector<std::string> objects{"Buffer", "Pipeline"};

  bool needs(const std::string& kind) const { return std::find(objects.begin(), objects.end(), kind) != objects.end(); }
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.effect;
}

std::filesystem::path sceneWith(const std::string& name, const std::string& rest) {
  return writeScene("ledger_" + name, R"(
[environment]
background = [0.3, 0.4, 0.5]
ambient = [0.1, 0.1, 0.1]
[camera]
position = [0, 1, 3]
target = [0, 0.5, 0]
[[object]]
model = "MODELS/teapot.obj"
)" + rest);
}

Options optionsFor(const std::filesystem::path& file) {
  Options options = headless(file, size);
  // The watch has objects of its own.
  set(options, {{"debug.check_finite", "false"}});
  return options;
}

struct Outcome {
  Counts counts;
  Image8 picture;
};

Outcome run(const Options& options) {
  counts = {};
  Outcome result;
  {
    Session session(options);
    session.draw(0.0, true);
    session.finish();
    result.picture = session.picture();
    expectQuiet(session);
    result.counts = counts;
  }
  return result;
}

// As if the program did not have the effect at all.
Options without(Options options, const std::string& effect) {
  set(options, {{"effects." + effect, "false"}});
  return options;
}

class Ledger : public testing::TestWithParam<Case> {};

TEST_P(Ledger, WhatNothingCallsForCostsNothing) {
  const std::string effect = GetParam().effect;
  const Options options = optionsFor(sceneWith(effect + "_uncalled", GetParam().uncalled));
  const Outcome asked = run(options);
  const Outcome none = run(without(options, effect));
  EXPECT_EQ(asked.counts.created, none.counts.created);
  EXPECT_EQ(asked.counts.draws, none.counts.draws);
  EXPECT_EQ(asked.picture.rgba, none.picture.rgba);
}

TEST_P(Ledger, WhatIsCalledForIsThereAndGivenBack) {
  const std::string effect = GetParam().effect;
  const Options options = optionsFor(sceneWith(effect + "_called", GetParam().called));
  counts = {};
  Session session(without(options, effect));
  const Settings off = session.settings();
  Settings on = off;
  ASSERT_EQ(setSetting(on, "effects." + effect, "true"), std::nullopt);
  const auto drawn = [&](const Settings& settings, int frames) {
    session.setSettings(settings);
    for (int i = 0; i < frames; ++i) {
      counts.draws = 0;
      session.draw(0.0, true);
      session.finish();
    }
    return std::pair(counts.alive, session.picture().rgba);
  };
  const auto before = drawn(off, 3);
  const int drawsBefore = counts.draws;
  const auto during = drawn(on, 1);
  for (const std::string& kind : GetParam().objects) {
    EXPECT_GT(during.first.at(kind), before.first.at(kind)) << kind;
  }
  EXPECT_NE(during.second, before.second) << "the effect shows nothing";
  const nlohmann::ordered_json stats = frameStats(session, session.renderer().timings());
  const auto& lines = stats.at("effects");
  const auto line = std::find_if(lines.begin(), lines.end(), [&](const auto& l) { return l.at("name") == effect; });
  ASSERT_NE(line, lines.end());
  EXPECT_EQ(line->at("called_for"), true) << *line;
  EXPECT_EQ(line->at("bytes") > 0, GetParam().needs("Buffer") || GetParam().needs("Image")) << *line;
  EXPECT_GT(line->at("draws"), 0) << *line;
  EXPECT_EQ(line->at("pipelines") > 0, GetParam().needs("Pipeline")) << *line;
  const auto after = drawn(off, 130);
  std::map<std::string, int> kept = after.first;
  // Code and layouts stay: they are no cost of a frame, and hot reload knows them.
  for (const char* kind : {"ShaderModule", "DescriptorSetLayout"}) {
    kept[kind] = before.first.at(kind);
  }
  EXPECT_EQ(kept, before.first);
  EXPECT_EQ(counts.draws, drawsBefore);
  EXPECT_EQ(after.second, before.second);
  expectQuiet(session);
}

// The camera looks away, at what calls for the effect, and away again. Afterwards the effect has no draws, bytes or
// pipelines, and there are no more objects than if it had been left out all the time.
TEST_P(Ledger, TurningAwayGivesTheCostBack) {
  const std::string effect = GetParam().effect;
  const std::filesystem::path file = sceneWith(effect + "_turned_away", GetParam().called);
  const CameraPose away = lookAt({0, 1, 3}, {0, 1, 9}, {0, 1, 0}, 60, 0.001);
  const auto alive = [&](const Options& options) {
    counts = {};
    Session session(options);
    const auto picture = [&](const std::optional<CameraPose>& camera, int frames) {
      session.setCamera(camera);
      for (int i = 0; i < frames; ++i) {
        session.draw(0.0, true);
        session.finish();
      }
      return session.picture().rgba;
    };
    const std::vector<uint8_t> empty = picture(away, 3);
    EXPECT_NE(picture(std::nullopt, 1), empty);
    EXPECT_EQ(picture(away, 130), empty);
    const nlohmann::ordered_json stats = frameStats(session, session.renderer().timings());
    for (const auto& line : stats.at("effects")) {
      if (line.at("name") == effect) {
        EXPECT_EQ(line.at("called_for"), false) << line;
        EXPECT_EQ(line.at("draws"), 0) << line;
        EXPECT_EQ(line.at("bytes"), 0) << line;
        EXPECT_EQ(line.at("pipelines"), 0) << line;
      }
    }
    expectQuiet(session);
    return counts.alive;
  };
  const std::map<std::string, int> with = alive(optionsFor(file));
  const std::map<std::string, int> never = alive(without(optionsFor(file), effect));
  EXPECT_EQ(with.at("Buffer"), never.at("Buffer"));
  EXPECT_EQ(with.at("Image"), never.at("Image"));
  EXPECT_LE(with.at("Pipeline"), never.at("Pipeline"));
}

INSTANTIATE_TEST_SUITE_P(
    Effects, Ledger,
    testing::Values(
        Case{"shadows", "[[light]]\nposition = [1, 2, 1]\nintensity = 0\ncasts_shadow = true\n",
             "[[light]]\nposition = [1, 2, 1]\nintensity = 9\ncasts_shadow = true\n"},
        Case{"roughness", "[[mirror]]\nposition = [0, 1, 5]\nsize = [2, 2]\nroughness = 0.3\n",
             "[[mirror]]\nposition = [0, 1, -1]\nsize = [2, 2]\nroughness = 0.3\n"},
        Case{"ripple", "[[mirror]]\nposition = [0, 1, 5]\nsize = [2, 2]\nripple = { amplitude = 0.02 }\n",
             "[[mirror]]\nposition = [0, 1, -1]\nsize = [2, 2]\nripple = { amplitude = 0.02 }\n"},
        Case{"casts_light",
             "[[light]]\nposition = [0, 2, -3]\nintensity = 9\n[[mirror]]\nposition = [0, 1, -1]\nsize = [2, 2]\n"
             "casts_light = true\n",
             "[[light]]\nposition = [0, 2, 1]\nintensity = 9\n[[mirror]]\nposition = [0, 1, -1]\nsize = [2, 2]\n"
             "casts_light = true\n"},
        Case{"curved", "[[object]]\nmodel = \"MODELS/sphere.obj\"\nposition = [0, 1, 5]\nmirror = {}\n",
             "[[object]]\nmodel = \"MODELS/sphere.obj\"\nposition = [0.8, 1, 0]\nmirror = {}\n"},
        Case{"fresnel",
             "[[mirror]]\nposition = [0, 1, 5]\nsize = [2, 2]\nfresnel = \"schlick\"\n",
             "[[mirror]]\nposition = [0, 0.1, 0]\nrotation = [-90, 0, 0]\nsize = [4, 4]\nfresnel = \"schlick\"\n"
             "reflectance = [0.3, 0.3, 0.3]\n",
             {}},
        Case{"textures",
             "[[object]]\nmodel = \"MODELS/chequer.obj\"\nposition = [0, 0, 9]\n",
             "[[object]]\nmodel = \"MODELS/chequer.obj\"\n",
             {"Image"}},
        Case{"glyphs",
             "[[light]]\nposition = [0, 1, 5]\nradius = 0.2\nglow = 2\n",
             "[[light]]\nposition = [0, 1, 1]\nradius = 0.2\nglow = 2\n",
             {"Pipeline"}}),
    [](const auto& info) { return std::string(info.param.effect); });

// One of two effects goes: what only it needed goes with it.
TEST(Ledger, EachEffectGivesBackItsOwn) {
  const std::filesystem::path file =
      sceneWith("two_effects",
                "[[light]]\nposition = [1, 2, 1]\nintensity = 9\ncasts_shadow = true\n[[light]]\n"
                "position = [0, 2, 1]\nintensity = 9\n[[mirror]]\nposition = [0, 1, -1]\nsize = [2, 2]\n"
                "casts_light = true\n");
  const auto run = [&](Session& session, const char* shadows, int frames) {
    Settings settings = session.settings();
    EXPECT_EQ(setSetting(settings, "effects.shadows", shadows), std::nullopt);
    session.setSettings(settings);
    for (int i = 0; i < frames; ++i) {
      session.draw(0.0, true);
      session.finish();
    }
  };
  counts = {};
  int buffers = 0;
  int pipelines = 0;
  {
    Session never(without(optionsFor(file), "shadows"));
    run(never, "false", 3);
    buffers = counts.alive.at("Buffer");
    pipelines = counts.alive.at("Pipeline");
  }
  counts = {};
  Session session(optionsFor(file));
  run(session, "true", 3);
  EXPECT_GT(session.sceneRenderer().ledger()[EffectKind::shadows].pipelines, 0u);
  EXPECT_GT(counts.alive.at("Buffer"), buffers);
  run(session, "false", 130);
  EXPECT_EQ(session.sceneRenderer().ledger()[EffectKind::shadows].pipelines, 0u);
  EXPECT_GT(session.sceneRenderer().ledger()[EffectKind::castsLight].pipelines, 0u);
  EXPECT_EQ(counts.alive.at("Buffer"), buffers);
  EXPECT_EQ(counts.alive.at("Pipeline"), pipelines);
}

// At a limit of depth a rough mirror reflects nothing that could be blurred.
TEST(Ledger, RoughnessWithoutReflectionCostsNothing) {
  Options options = optionsFor(sceneWith(
      "rough_deep", "[[mirror]]\nposition = [0, 1, -1]\nsize = [2, 2]\nroughness = 0.3\nbase_color = [0.3, 0, 0]\n"));
  set(options, {{"reflection.max_depth", "0"}});
  const Outcome asked = run(options);
  const Outcome none = run(without(options, "roughness"));
  EXPECT_EQ(asked.counts.created, none.counts.created);
  EXPECT_EQ(asked.picture.rgba, none.picture.rgba);
}

// Targets, draws and a pipeline while a curved mirror is drawn, all given back when it is not; rays never.
TEST(Ledger, EnvironmentMapsAreThereAndGivenBack) {
  Options options = optionsFor(
      sceneWith("environment", "[[object]]\nmodel = \"MODELS/sphere.obj\"\nposition = [0.8, 1, 0]\nmirror = {}\n"));
  set(options, {{"effects.curved_lookup", "environment"}});
  counts = {};
  Session session(without(options, "curved"));
  const auto drawn = [&](const char* curved, int frames) {
    Settings settings = session.settings();
    EXPECT_EQ(setSetting(settings, "effects.curved", curved), std::nullopt);
    session.setSettings(settings);
    for (int i = 0; i < frames; ++i) {
      counts.draws = 0;
      session.draw(0.0, true);
      session.finish();
    }
    return std::pair(counts.alive, session.picture().rgba);
  };
  const auto before = drawn("false", 3);
  const int drawsBefore = counts.draws;
  const auto during = drawn("true", 1);
  const EffectCost cost = session.sceneRenderer().ledger()[EffectKind::curved];
  EXPECT_EQ(during.first.at("Image"), before.first.at("Image") + 2) << "the faces side by side, and their depth";
  EXPECT_EQ(during.first.at("Buffer"), before.first.at("Buffer")) << "nothing to trace";
  EXPECT_EQ(cost.pipelines, 1u);
  EXPECT_GE(cost.bytes, 6ull * 256 * 256 * (8 + 4));
  EXPECT_GT(static_cast<int>(cost.draws), 1) << "the faces' draws as well";
  EXPECT_GT(counts.draws, drawsBefore);
  EXPECT_NE(during.second, before.second);
  const auto still = drawn("true", 2);
  EXPECT_EQ(still.second, during.second);
  EXPECT_EQ(counts.draws, drawsBefore) << "an unchanged map is not drawn again";
  const auto after = drawn("false", 130);
  std::map<std::string, int> kept = after.first;
  for (const char* kind : {"ShaderModule", "DescriptorSetLayout"}) {
    kept[kind] = before.first.at(kind);
  }
  // The faces' own pipelines, of one sample, are no cost of the effect's.
  EXPECT_LE(kept.at("Pipeline"), before.first.at("Pipeline") + 1);
  kept["Pipeline"] = before.first.at("Pipeline");
  EXPECT_EQ(kept, before.first);
  EXPECT_EQ(after.second, before.second);
  EXPECT_EQ(session.sceneRenderer().ledger()[EffectKind::curved].bytes, 0u);
  expectQuiet(session);
}

}  // namespace
}  // namespace speculum
