// Main views that are drawn into the display image have the bytes of the display pass, and nothing misses their
// radiance.
#include "cli/commands.hpp"
#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "picture_support.hpp"
#include "random.hpp"
#include "sampling.hpp"
#include "scene_text.hpp"
#include "studio.hpp"

namespace speculum::encoded_pictures {
namespace {

using namespace testing_support;

const SettingList oneSample{{"view.samples", "1"}, {"debug.check_finite", "false"}};

bool hasDisplayPass(const SceneRenderer& renderer) {
  return std::ranges::count(renderer.passes(), PassKind::display, &RecordedPass::kind) > 0;
}

// Draws the picture with and without the display pass, expects the same, and says whether there was a choice.
bool expectSameEncoded(Session& session, double time) {
  Settings settings = session.settings();
  settings.debug.encodeEarly = true;
  session.setSettings(settings);
  const Image8 early = draw(session, time);
  const bool encodes = session.lastFrame().plan.encodes;
  EXPECT_EQ(hasDisplayPass(session.sceneRenderer()), !encodes);
  settings.debug.encodeEarly = false;
  session.setSettings(settings);
  const Image8 late = draw(session, time);
  EXPECT_TRUE(hasDisplayPass(session.sceneRenderer()));
  EXPECT_TRUE(early.rgba == late.rgba) << difference(early, late, 0).over << " pixels";
  return encodes;
}

class EncodedScenes : public testing::TestWithParam<RenderPath> {};

TEST_P(EncodedScenes, HaveTheBytesOfTheDisplayPass) {
  Random random(5);
  int encoded = 0;
  std::vector<std::string> names = sceneNames();
  const std::vector<std::string> hard = sceneNames("hard/");
  names.insert(names.end(), hard.begin(), hard.end());
  // Unless all are drawn, each path draws scenes of its own.
  const size_t first = fullTests() || GetParam() == RenderPath::dynamic ? 0 : 3;
  for (size_t i = first; i < names.size(); i += fullTests() ? 1 : 6) {
    SCOPED_TRACE(names[i]);
    Options options = headless(sceneFile(names[i]), {96, 54}, oneSample);
    options.renderPath = GetParam();
    QuietSession session(options);
    session.showOnly();
    for (int picture = 0; picture < (fullTests() ? 3 : 2); ++picture) {
      Settings settings = session.settings();
      settings.view.exposure = random.chance(0.5) ? 1.0 : std::exp2(random.uniform(-14.0, 14.0));
      settings.view.toneMap = random.chance(0.5) ? ToneMap::aces : ToneMap::clamp;
      settings.view.wireframe = random.chance(0.2);
      settings.reflection.samples = random.chance(0.5) ? 4 : 1;
      settings.effects.shadowLookup = ShadowLookup::map;
      settings.effects.curvedLookup = CurvedLookup::environment;
      settings.effects.castsLight = false;
      if (random.chance(0.3)) {
        settings.view.clearColor = {random.uniform(0.0, 1.5), random.uniform(0.0, 0.01), random.uniform(0.0, 1.0)};
      }
      session.setSettings(settings);
      encoded += expectSameEncoded(session, picture);
    }
  }
  EXPECT_GT(encoded, static_cast<int>(names.size()) / (fullTests() ? 3 : 6));
}

// The shader rounds these colors otherwise than exact curves do, so the pass cannot be cleared with them.
TEST_P(EncodedScenes, DrawBackgroundsNearTies) {
  Options options = headless(writeScene("wall", wallScene), {64, 36}, oneSample);
  options.renderPath = GetParam();
  QuietSession session(options);
  session.showOnly();
  const Settings usual = session.settings();
  draw(session);
  const uint32_t draws = session.sceneRenderer().passes().back().draws;
  for (const auto& [toneMap, exposure, color] :
       {std::tuple(ToneMap::aces, 2.18, 0.046630859375), std::tuple(ToneMap::clamp, 0.84, 0.69921875),
        std::tuple(ToneMap::clamp, 2.31, 0.35791015625)}) {
    Settings settings = usual;
    settings.view.toneMap = toneMap;
    settings.view.exposure = exposure;
    settings.view.clearColor = {color, color, color};
    session.setSettings(settings);
    EXPECT_TRUE(expectSameEncoded(session, 0.0)) << exposure;
    session.setSettings(settings);
    draw(session);
    EXPECT_EQ(session.sceneRenderer().passes().back().draws, draws + 1) << exposure;
  }
}

INSTANTIATE_TEST_SUITE_P(Paths, EncodedScenes, testing::Values(RenderPath::dynamic, RenderPath::renderPass),
                         [](const auto& info) { return info.param == RenderPath::dynamic ? "Dynamic" : "RenderPass"; });

// Any sequence of movements and rests shows what drawing everything shows.
TEST(EncodedPictures, AreReusedOnceTheyStay) {
  const Options options = headless(writeScene("wall", wallScene), {64, 36}, oneSample);
  Studio studio(options);
  Studio whole(options);
  studio.settings.debug.checkFinite = false;
  studio.reusesMain = studio.shownOnly = true;
  whole.settings.debug.encodeEarly = false;
  Random random(9);
  int encoded = 0;
  int reused = 0;
  CameraPose pose = evaluate(studio.scene, 0.0).camera;
  for (int frame = 0; frame < (fullTests() ? 400 : 60); ++frame) {
    pose.eye.x += random.chance(0.4) ? 0.05 : 0.0;
    studio.camera = whole.camera = pose;
    studio.settings.view.exposure = whole.settings.view.exposure = random.chance(0.2) ? 2.0 : 1.0;
    EXPECT_TRUE(studio.draw().rgba == whole.draw().rgba) << frame;
    encoded += studio.plan.encodes;
    reused += studio.plan.mainReused();
  }
  EXPECT_GT(encoded, 10);
  EXPECT_GT(reused, 5);
}

// Each reader of radiance either asks for it before the picture is drawn, or finds that there is none.
TEST(EncodedPictures, HaveNoRadiance) {
  QuietSession session(headless(writeScene("wall", wallScene), {64, 36}, oneSample));
  set(session, {{"reflection.skip_unchanged", "false"}});  // other renderers have no images for these plans
  const Image8 whole = draw(session);
  const LinearImage radiance = session.radiance();
  const FramePlan late = session.lastFrame().plan;
  ASSERT_FALSE(late.encodes);
  session.showOnly();
  EXPECT_TRUE(draw(session).rgba == whole.rgba);
  EXPECT_THROW(session.radiance(), std::logic_error);
  EXPECT_TRUE(session.sceneRenderer().hasGaps());
  const DrawnFrame frame = session.lastFrame();
  ASSERT_TRUE(frame.plan.encodes);
  const TargetDisplay target{
      .pass = static_cast<int>(frame.plan.passes.size()) - 1, .area = {0, 0, 64, 36}, .zoom = 2.0};
  recordFrame(session, frame.state, frame.settings, frame.plan, target);
  EXPECT_TRUE(session.picture().rgba == whole.rgba) << "a target that was not drawn is not shown";
  recordFrame(session, frame.state, frame.settings, late, target);
  EXPECT_FALSE(session.picture().rgba == whole.rgba);

  // The other half of A | B was encoded before there were two.
  SceneRenderer other(session.renderer(), session.scene());
  Frame first = session.renderer().beginFrame().value();
  other.record(first, frame.state, frame.settings, frame.plan);
  session.renderer().endFrame(first);
  Frame second = session.renderer().beginFrame().value();
  second.capture = true;
  session.sceneRenderer().record(second, frame.state, frame.settings, late, {}, true, SplitDisplay{other, true, 20});
  session.renderer().endFrame(second);
  EXPECT_TRUE(session.picture().rgba == whole.rgba) << "this picture is shown on both sides";
  EXPECT_TRUE(session.radiance().pixels == radiance.pixels);
  session.renderer().waitIdle();
}

TEST(EncodedPictures, AreNotWrittenAsExr) {
  Options options = headless(writeScene("wall", wallScene), {64, 36}, oneSample);
  QuietSession session(options);
  const Image8 picture = draw(session);
  options.out = sceneDirectory() / "wall.exr";
  ASSERT_EQ(runRender(options), 0);
  EXPECT_TRUE(readExr(options.out).pixels == session.radiance().pixels);
  EXPECT_TRUE(toDisplay(readExr(options.out)).rgba == picture.rgba);
}

}  // namespace
}  // namespace speculum::encoded_pictures
