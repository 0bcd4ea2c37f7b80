// Pictures with reflection.skip_unchanged are the same bytes as without it while things move, stop or are edited.
#include <chrono>

#include "picture_support.hpp"
#include "plan/reuse_support.hpp"
#include "platform/files.hpp"
#include "sampling.hpp"
#include "studio.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr PictureSize size{48, 27};

Options optionsFor(const std::filesystem::path& file, bool skip, SettingList more) {
  Options options = headless(file, size, more);
  set(options, {{"reflection.skip_unchanged", skip ? "true" : "false"}});
  return options;
}

struct Case {
  const char* scene;
  SettingList settings;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.scene;
  for (const auto& [key, value] : c.settings) {
    *out << " " << key << "=" << value;
  }
}

const SettingList oneSample = {{"view.samples", "1"}, {"reflection.samples", "1"}};

class Sequence : public testing::TestWithParam<Case> {};

// Times with rest, motion, a cut, rest and a cut back.
TEST_P(Sequence, SkippingChangesNoByte) {
  const std::filesystem::path file = sceneFile(GetParam().scene);
  QuietSession session(optionsFor(file, false, GetParam().settings));
  struct Rendered {
    Image8 picture;
    int passes = 0;
  };
  std::map<double, Rendered> rendered;
  for (const double time : {1.0, 1.03, 9.0}) {
    rendered[time].picture = draw(session, time);
    rendered[time].passes = mirrorPasses(session.sceneRenderer());
  }
  set(session, {{"reflection.skip_unchanged", "true"}});
  session.restart();
  int skipped = 0;
  double before = -1.0;
  for (const double time : {1.0, 1.0, 1.03, 9.0, 9.0, 1.03}) {
    ASSERT_EQ(draw(session, time).rgba, rendered[time].picture.rgba) << "at " << time;
    const int passes = mirrorPasses(session.sceneRenderer());
    skipped += rendered[time].passes - passes;
    if (time == before) {
      EXPECT_EQ(passes, 0) << "at " << time;
      EXPECT_GT(rendered[time].passes, 0);
    }
    before = time;
  }
  EXPECT_GT(skipped, 0);
}

std::vector<Case> sequences() {
  std::vector<Case> cases = {{"facing_mirrors", {{"reflection.samples", "1"}}},
                             {"mirror_ball", {{"effects.per_sample", "false"}}},
                             {"rough", {{"effects.rough_lookup", "image"}, {"effects.rough_samples", "4"}}},
                             {"gallery", {{"reflection.samples", "1"}}},
                             {"outdoors", {{"reflection.clip", "oblique"}, {"view.samples", "1"}}}};
  if (fullTests()) {
    cases.insert(cases.end(), {{"gallery", {}},
                               {"gallery", {{"reflection.scale", "0.5"}, {"view.samples", "1"}}},
                               {"shadows", oneSample},
                               {"many_mirrors", oneSample},
                               {"pool", oneSample},
                               {"bounced_light", oneSample}});
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Sequence, testing::ValuesIn(sequences()), [](const auto& info) {
  return std::string(info.param.scene) + "_" + std::to_string(info.index);
});

bool drawsMain(const Studio& studio) {
  return std::ranges::count(studio.sceneRenderer.passes(), PassKind::main, &RecordedPass::kind) > 0;
}

TEST(UnchangedPictures, EditsShowInTheFrameAfterThem) {
  const Options options = optionsFor(roomScene(false), true, {});
  Studio studio(options);
  const Scene original = studio.scene;
  const std::vector<std::function<void(Scene&)>> edits = {
      [](Scene&) {},
      [](Scene& s) { s.objects[0].position.x = 0.3; },
      [](Scene& s) { s.objects[1].color = glm::dvec3(0.9, 0.1, 0.1); },
      [](Scene& s) { s.objects[1].mirror.emplace(); },
      [](Scene& s) { s.objects[1].mirror.reset(); },
      [](Scene& s) { s.lights[0].intensity = 40.0; },
      [](Scene& s) { s.lights[0].castsShadow = true; },
      [](Scene& s) { s.mirrors[0].baseColor = glm::dvec3(0.1, 0.4, 0.1); },
      [](Scene& s) { s.mirrors[1].rotation.y = 10.0; },
      [](Scene& s) { s.mirrors[1].reflectance *= 0.7; },
      [](Scene& s) { s.mirrors.push_back(s.mirrors[1]), s.mirrors[2].position.x = 2.0; },
      [](Scene& s) { s.mirrors.erase(s.mirrors.begin()); },
      [](Scene& s) { s.objects.pop_back(); },
      [](Scene& s) { s.environment.background = glm::dvec3(0.8, 0.1, 0.1); },
      [](Scene& s) { s.camera.position.x = 0.9; },
      [](Scene& s) { s.mirrors.clear(); },
  };
  studio.settings.reflection.skipUnchanged = false;
  std::vector<std::vector<uint8_t>> expected;
  for (const auto& edit : edits) {
    expected.push_back(studio.draw().rgba);
    EXPECT_TRUE(drawsMain(studio));
    edit(studio.scene);
  }
  studio.show(original);
  studio.sceneRenderer.restart();
  studio.settings.reflection.skipUnchanged = studio.reusesMain = true;
  for (size_t i = 0; i < edits.size(); ++i) {
    for (int frame = 0; frame < 3; ++frame) {
      ASSERT_EQ(studio.draw().rgba, expected[i]) << "edit " << i << ", frame " << frame;
      // The first edit changes nothing.
      EXPECT_EQ(drawsMain(studio), frame < 2 && i != 1) << "edit " << i << ", frame " << frame;
    }
    edits[i](studio.scene);
  }
}

TEST(UnchangedPictures, MemoryComesBackWhenReflectionsGo) {
  QuietSession session(
      optionsFor(roomScene(false), true, {{"reflection.max_depth", "0"}, {"debug.check_finite", "false"}}));
  const auto bytesAfter = [&](int maxDepth, int frames) {
    set(session, {{"reflection.max_depth", std::to_string(maxDepth)}});
    runFrames(session, frames);
    return session.device().allocatedBytes();
  };
  bytesAfter(4, 2);  // buffers that grow stay, one for each frame in flight
  const uint64_t none = bytesAfter(0, 40);
  const uint64_t rendered = bytesAfter(4, 1);
  EXPECT_GT(rendered, none);
  EXPECT_LE(bytesAfter(4, 3), rendered) << "cached images would have been needed anyway";
  EXPECT_LT(bytesAfter(4, 40), rendered) << "images of mirrors in mirrors go";
  EXPECT_EQ(bytesAfter(0, 40), none);
}

// Sets a newer time, because files are compared by their times, which have whole seconds on some systems.
void replaceShader(const std::filesystem::path& file, const std::string& code) {
  std::string text = readText(file);
  text.insert(text.rfind('}'), code);
  std::ofstream(file) << text;
  std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
}

TEST(UnchangedPictures, ReloadedShadersShowInMirrors) {
  const std::filesystem::path shaders = sceneDirectory() / "shaders";
  std::filesystem::remove_all(shaders);
  std::filesystem::create_directories(shaders);
  writeShaders(shaders, "scene_shading.glsl", "");
  Options options = optionsFor(roomScene(false), true, {});
  options.shaderDir = shaders;
  QuietSession session(options);
  const std::vector<uint8_t> before = draw(session, 0.0).rgba;
  EXPECT_EQ(draw(session, 0.0).rgba, before);
  EXPECT_EQ(mirrorPasses(session.sceneRenderer()), 0);
  replaceShader(shaders / "scene_shading.glsl", "color.rgb = color.bgr;");
  const std::vector<uint8_t> after = draw(session, 0.0).rgba;
  EXPECT_GT(mirrorPasses(session.sceneRenderer()), 0);
  EXPECT_NE(after, before);
  Session fresh(options);
  EXPECT_EQ(after, draw(fresh, 0.0).rgba);
}

// Only a mirror image shows what calls for rays. Its pipelines must stay while the image is reused.
TEST(UnchangedPictures, PipelinesOfReusedImagesStay) {
  QuietSession session(optionsFor(writeScene("only_in_the_mirror", R"(
[environment] background = [0.3, 0.4, 0.5]
[camera] position = [0, 1, 3], target = [0, 1, 0]
[[object]] model = "MODELS/sphere.obj", position = [0, 1, 5], mirror = {}
[[object]] model = "MODELS/teapot.obj", position = [1, 0, 1]
[[light]] position = [1, 3, 3], intensity = 20
[[mirror]] position = [0, 1, -2], size = [3, 2]
)"),
                                  true, {{"debug.check_finite", "false"}}));
  const std::vector<uint8_t> first = draw(session, 0.0).rgba;
  ASSERT_EQ(session.sceneRenderer().ledger()[EffectKind::curved].pipelines, 1u);
  runFrames(session, 129);
  EXPECT_EQ(draw(session, 0.0).rgba, first);
  EXPECT_EQ(mirrorPasses(session.sceneRenderer()), 0);
  EXPECT_EQ(session.sceneRenderer().ledger()[EffectKind::curved].pipelines, 1u);
  set(session, {{"effects.curved", "false"}});
  runFrames(session, 130);
  EXPECT_EQ(session.sceneRenderer().ledger()[EffectKind::curved].pipelines, 0u);
}

}  // namespace
}  // namespace speculum
