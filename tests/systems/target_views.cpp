// The debug view and the texel probe: right values at the right pixels, and released afterwards.
#include "log_capture.hpp"
#include "picture_support.hpp"
#include "plan/pass_mask.hpp"
#include "scene_text.hpp"
#include "test_headers.hpp"

namespace speculum::target_views {
namespace {

using namespace testing_support;

constexpr PictureSize hallSize{160, 120};

// The eye 4 m in front of the sphere's middle and 6 m in front of the mirror, in which the sphere is 8 m away.
Options hallOptions(const std::string& samples = "1") {
  return headless(writeScene("hall", replaced(wallScene, "0.9, 1, 0", "0, 1, 0")), hallSize,
                  {{"view.samples", samples},
                   {"reflection.samples", samples},
                   {"debug.check_finite", "false"},
                   {"reflection.skip_unchanged", "false"}});
}

const DrawnFrame& drawWith(Session& session, const std::optional<TargetDisplay>& debug) {
  const DrawnFrame& drawn = session.draw(0.0, false);
  recordFrame(session, drawn.state, drawn.settings, drawn.plan, debug);
  return drawn;
}

// Shows the target over the whole picture, each texel at its own pixel.
TargetDisplay inPlace(const FramePlan& plan, int pass, TargetKind kind) {
  const PixelRect& rect = plan.passes[static_cast<size_t>(pass)].view.rect;
  return {.pass = pass,
          .area = {0, 0, hallSize.width, hallSize.height},
          .kind = kind,
          .zoom = 1.0,
          .origin = {-rect.x, -rect.y},
          .halfDistance = 5.0};
}

class ShownTarget : public testing::TestWithParam<std::pair<RenderPath, const char*>> {};

TEST_P(ShownTarget, DepthIsShownByDistance) {
  Options options = hallOptions(GetParam().second);
  options.renderPath = GetParam().first;
  QuietSession session(options);
  const FramePlan plan = session.draw(0.0, false).plan;
  ASSERT_EQ(plan.drawnMirrors().size(), 1u);
  // The sphere's radius is 0.5 m.
  for (const auto& [pass, metres] : {std::pair(0, 7.5), std::pair(1, 3.5)}) {
    for (int frame = 0; frame < 3; ++frame) {
      drawWith(session, inPlace(plan, pass, TargetKind::depth));
    }
    const Image8 picture = session.picture();
    const uint8_t* middle = picture.at(hallSize.width / 2, hallSize.height / 2);
    EXPECT_NEAR(middle[0], 255.0 / (1.0 + metres / 5.0), 1.5) << "pass " << pass;
    EXPECT_EQ(middle[0], middle[2]);
    if (pass == 1) {
      EXPECT_EQ(picture.at(2, 2)[0], 0) << "the background is infinitely far";
      EXPECT_NEAR(picture.at(hallSize.width / 2, hallSize.height / 2 + 25)[0], 255.0 / (1.0 + 6.0 / 5.0), 1.5)
          << "the mirror";
    }
  }
}

// Draws until the frame with the probe has finished, and returns the value.
TexelValue probed(Session& session, const TargetDisplay& debug) {
  for (int frame = 0; frame < 4; ++frame) {
    drawWith(session, debug);
  }
  return session.sceneRenderer().probed().value();
}

TEST_P(ShownTarget, ProbeReadsATexelExactly) {
  Options options = hallOptions(GetParam().second);
  options.renderPath = GetParam().first;
  QuietSession session(options);
  const FramePlan plan = session.draw(0.0, false).plan;
  for (const glm::ivec2& texel : {glm::ivec2(80, 60), glm::ivec2(3, 5), glm::ivec2(96, 61)}) {
    TargetDisplay debug = inPlace(plan, 1, TargetKind::color);
    debug.probe = texel;
    const TexelValue color = probed(session, debug);
    EXPECT_EQ(color.texel, texel);
    EXPECT_FALSE(color.depth);
    const auto radiance =
        session.sceneRenderer().radiance().pixels[static_cast<size_t>(texel.y) * hallSize.width + texel.x];
    EXPECT_EQ(glm::vec3(color.value), glm::vec3(radiance[0], radiance[1], radiance[2]));
  }
  // The sphere's radius is 0.5 m.
  for (const auto& [pass, metres] : {std::pair(0, 7.5), std::pair(1, 3.5)}) {
    TargetDisplay debug = inPlace(plan, pass, TargetKind::depth);
    const PixelRect rect = pass == 0 ? plan.drawnMirrors()[0].view.rect : PixelRect{};
    debug.probe = glm::ivec2(hallSize.width / 2 - rect.x, hallSize.height / 2 - rect.y);
    const TexelValue depth = probed(session, debug);
    EXPECT_TRUE(depth.depth);
    // The pixel's centre is beside the axis, and the sphere has facets.
    EXPECT_GE(plan.projection.near / depth.storedDepth, metres) << "pass " << pass;
    EXPECT_LE(plan.projection.near / depth.storedDepth, metres + 0.008) << "pass " << pass;
    debug.kind = TargetKind::color;
    const TexelValue color = probed(session, debug);
    EXPECT_GT(color.value.r, 0.0f);
    EXPECT_NEAR(1.0 / color.value.a, metres, 0.02) << "disparity, of half precision";
  }
  TargetDisplay wall = inPlace(plan, 1, TargetKind::depth);
  wall.probe = glm::ivec2(hallSize.width / 2, hallSize.height / 2 + 25);
  EXPECT_NEAR(plan.projection.near / probed(session, wall).storedDepth, 6.0, 2e-6) << "at right angles to the view";
  TargetDisplay sky = inPlace(plan, 1, TargetKind::depth);
  sky.probe = glm::ivec2(2, 2);
  EXPECT_EQ(probed(session, sky).storedDepth, 0.0f) << "infinitely far";
}

INSTANTIATE_TEST_SUITE_P(Paths, ShownTarget,
                         testing::Values(std::pair(RenderPath::dynamic, "4"), std::pair(RenderPath::renderPass, "1")),
                         [](const auto& info) {
                           return std::string(renderPathName(info.param.first)) + info.param.second;
                         });

TEST(TargetViews, ColorIsThePictureMagnified) {
  QuietSession session(hallOptions());
  const FramePlan plan = session.draw(0.0, false).plan;
  drawWith(session, std::nullopt);
  const Image8 plain = session.picture();
  drawWith(session, inPlace(plan, 1, TargetKind::color));
  EXPECT_EQ(session.picture().rgba, plain.rgba);
  TargetDisplay magnified = inPlace(plan, 1, TargetKind::color);
  magnified.zoom = 4.0;
  magnified.origin = {60.0, 50.0};
  magnified.area = {20, 10, 64, 48};
  drawWith(session, magnified);
  const Image8 picture = session.picture();
  for (int y = 0; y < hallSize.height; ++y) {
    for (int x = 0; x < hallSize.width; ++x) {
      const bool within = magnified.area.contains(x, y);
      const uint8_t* expected = within ? plain.at(60 + (x - 20) / 4, 50 + (y - 10) / 4) : plain.at(x, y);
      ASSERT_TRUE(std::equal(expected, expected + 3, picture.at(x, y))) << x << " " << y;
    }
  }
  // The debug view leaves the picture unchanged beyond the image's border.
  magnified.origin = {-8.0, -6.0};
  drawWith(session, magnified);
  EXPECT_TRUE(std::equal(plain.at(22, 12), plain.at(22, 12) + 3, session.picture().at(22, 12)));
}

TEST(TargetViews, ShrunkColorIsTheMeanOfItsTexels) {
  for (const char* samples : {"1", "4"}) {
    QuietSession session(hallOptions(samples));
    const FramePlan plan = session.draw(0.0, false).plan;
    constexpr int texels = 4;  // across, in a pixel
    TargetDisplay debug = inPlace(plan, 1, TargetKind::color);
    debug.zoom = 1.0 / texels;
    drawWith(session, debug);
    const Image8 shown = session.picture();
    const LinearImage radiance = session.sceneRenderer().radiance();
    LinearImage means(hallSize.width / texels, hallSize.height / texels);
    for (int y = 0; y < means.height * texels; ++y) {
      for (int x = 0; x < means.width * texels; ++x) {
        means.at(x / texels, y / texels) += radiance.at(x, y) / static_cast<float>(texels * texels);
      }
    }
    const Image8 expected = toDisplay(means, session.settings().view.displayCurve());
    for (int y = 0; y < means.height; ++y) {
      for (int x = 0; x < means.width; ++x) {
        for (int channel = 0; channel < 3; ++channel) {
          ASSERT_NEAR(shown.at(x, y)[channel], expected.at(x, y)[channel], 1) << x << " " << y;
        }
      }
    }
  }
}

// A draft of a picture, whose targets stay while the picture's tiles are drawn.
TEST(TargetViews, StayUntilTheNextPictureIsComplete) {
  QuietSession session(hallOptions());
  const SceneState state = evaluate(session.scene(), 0.0);
  const auto planOf = [&](const Settings& settings) {
    return planFrame({session.scene(), state, settings, {hallSize.width, hallSize.height}});
  };
  Settings draft = session.settings();
  draft.view.scale = 0.5;
  Settings full = session.settings();
  full.view.samples = full.reflection.samples = 4;
  FramePlan plan = planOf(full);
  const size_t count = tileCount(plan);
  ASSERT_EQ(plan.drawnMirrors().size(), 1u);
  for (const TargetKind kind : {TargetKind::color, TargetKind::depth}) {
    for (const int pass : {0, 1}) {
      const TargetDisplay debug{.pass = pass, .area = {20, 10, 100, 80}, .kind = kind, .halfDistance = 5.0};
      const auto draw = [&](const Settings& settings, const FramePlan& drawn, const TargetDisplay& shown) {
        recordFrame(session, state, settings, drawn, shown);
        return session.picture().rgba;
      };
      plan.tiles.reset();
      const auto whole = draw(full, plan, debug);
      const auto before = draw(draft, planOf(draft), debug);
      EXPECT_NE(before, whole);
      TargetDisplay other = debug;
      other.pass = 1 - pass;
      for (size_t first = 0; first < count; first += 20) {
        plan.tiles = {first, std::min(first + 20, count)};
        const auto now = draw(full, plan, debug);
        EXPECT_EQ(now == before, !endsPicture(plan)) << pass << " at " << first;
        EXPECT_EQ(now == whole, endsPicture(plan)) << pass << " at " << first;
      }
      plan.tiles = {0, 20};
      EXPECT_EQ(draw(full, plan, debug), whole) << "of the picture before";
      plan.tiles = {20, 40};
      EXPECT_NE(draw(full, plan, other), whole) << "another target was not drawn";
    }
  }
}

// The last picture of a mean is drawn again for a target.
TEST(TargetViews, KeepTheMean) {
  QuietSession session(hallOptions());
  const SceneState state = evaluate(session.scene(), 0.0);
  Settings mean = session.settings();
  mean.view.accumulate = 3;
  const auto draw = [&](int picture, const std::optional<TargetDisplay>& debug) {
    const FramePlan plan = planFrame({session.scene(),
                                      state,
                                      mean,
                                      {hallSize.width, hallSize.height},
                                      session.sceneRenderer().cache(state),
                                      picture});
    recordFrame(session, state, mean, plan, debug);
    return session.picture();
  };
  for (int picture = 0; picture < 3; ++picture) {
    draw(picture, std::nullopt);
  }
  const Image8 plain = draw(3, std::nullopt);
  for (const TargetKind kind : {TargetKind::depth, TargetKind::color}) {
    for (const int pass : {0, 1}) {
      const TargetDisplay debug{.pass = pass, .area = {0, 0, 100, 120}, .kind = kind, .halfDistance = 5.0};
      const MirrorPath path = pass == 0 ? MirrorPath{0} : MirrorPath{};
      EXPECT_FALSE(session.sceneRenderer().keepsTarget(path, kind));
      const Image8 shown = draw(2, debug);
      EXPECT_EQ(session.sceneRenderer().accumulated(), 3);
      EXPECT_TRUE(session.sceneRenderer().keepsTarget(path, kind));
      for (int frame = 0; frame < 3; ++frame) {
        EXPECT_TRUE(draw(3, debug).rgba == shown.rgba) << "nothing has to be drawn for it any more";
      }
      int differences = 0;
      for (int y = 0; y < hallSize.height; ++y) {
        for (int x = 0; x < hallSize.width; ++x) {
          const bool same = std::equal(plain.at(x, y), plain.at(x, y) + 3, shown.at(x, y));
          EXPECT_TRUE(same || debug.area.contains(x, y)) << x << " " << y;
          differences += same ? 0 : 1;
        }
      }
      EXPECT_GT(differences, 1000);
      EXPECT_TRUE(draw(3, std::nullopt).rgba == plain.rgba);
    }
  }
  const TargetDisplay main{.pass = 1, .area = {0, 0, 100, 120}};
  EXPECT_FALSE(draw(3, main).rgba == plain.rgba) << "colors of the main view are always there";
}

TEST(TargetViews, CostNothingWhenOff) {
  QuietSession session(hallOptions("4"));
  const FramePlan plan = session.draw(0.0, false).plan;
  drawWith(session, std::nullopt);
  session.renderer().waitIdle();
  const size_t pipelines = session.renderer().pipelines().count();
  const uint64_t bytes = session.device().allocatedBytes();
  for (const int pass : {0, 1}) {
    for (const TargetKind kind : {TargetKind::color, TargetKind::depth}) {
      drawWith(session, inPlace(plan, pass, kind));
    }
  }
  EXPECT_GT(session.renderer().pipelines().count(), pipelines);
  session.renderer().waitIdle();
  EXPECT_GT(session.device().allocatedBytes(), bytes);
  for (int frame = 0; frame < 3; ++frame) {
    drawWith(session, std::nullopt);
  }
  session.renderer().waitIdle();
  EXPECT_EQ(session.renderer().pipelines().count(), pipelines);
  EXPECT_EQ(session.device().allocatedBytes(), bytes);
}

TEST(TargetViews, MissTheBarrierOfDepth) {
  for (const char* omitted : {"depthToSample", ""}) {
    Options options = hallOptions();
    options.renderPath = RenderPath::renderPass;
    set(options, {{"debug.omit_barrier", omitted}});
    const LogCapture log;
    Session session(options);
    const FramePlan plan = session.draw(0.0, false).plan;
    for (int frame = 0; frame < 3; ++frame) {
      drawWith(session, inPlace(plan, frame % 2, TargetKind::depth));
    }
    session.finish();
    const std::string message = log.validationMessage();
    EXPECT_EQ(contains(message, "SYNC-HAZARD"), *omitted != '\0') << message;
    EXPECT_EQ(message.empty(), *omitted == '\0') << message;
  }
}

}  // namespace
}  // namespace speculum::target_views
