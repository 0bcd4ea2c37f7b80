// reflection.mesh_error: how many triangles simplified objects in mirrors save, and how much the picture changes.
#include "accuracy/image_metrics.hpp"
#include "reuse_support.hpp"
#include "scene_text.hpp"

namespace speculum::level_pictures {
namespace {

using namespace testing_support;

constexpr PictureSize size{320, 180};
constexpr PictureSize small{160, 90};

// Objects before a mirror wall and a second mirror at its side: knots, objects of several parts, and hard edges.
std::filesystem::path objectsScene() {
  return writeScene("levels", R"(
[environment] background = [0.3, 0.4, 0.5], ambient = [0.1, 0.1, 0.1]
[camera] position = [0.4, 1.4, 4], target = [0, 0.9, 0], orbit_speed = 20
[[object]] model = "MODELS/torus_knot.obj", position = [-0.8, 0.8, 0.5], spin = [0, 40, 0]
  copies = { count = 4, step = [0.6, 0, 0.5] }
[[object]] model = "MODELS/queen.obj", position = [1.2, 0, -0.6]
[[object]] model = "MODELS/lamp.obj", position = [-1.3, 1.9, 0]
[[object]] model = "MODELS/chequer.obj", position = [0, 0, 0]
[[light]] position = [1, 3, 3], intensity = 20
[[mirror]] name = "wall", position = [0, 1, -2], size = [3, 2]
[[mirror]] name = "side", position = [-2, 1, 0], rotation = [0, 90, 0], size = [3, 2]
)");
}

Options optionsFor(const std::filesystem::path& file, const std::string& meshError, const SettingList& more = {}) {
  Options options = headless(file, small, {{"reflection.mesh_error", meshError}});
  set(options, more);
  return options;
}

struct Drawn {
  Image8 picture;
  int64_t mirrorTriangles = 0;
  int64_t mainTriangles = 0;
};

Drawn drawn(Session& session, const std::string& meshError) {
  set(session, {{"reflection.mesh_error", meshError}});
  Drawn result{.picture = draw(session)};
  const nlohmann::ordered_json stats = frameStats(session);
  for (const auto& pass : stats["passes"]) {
    if (pass["triangles"].is_number()) {
      (pass["depth"].is_null() ? result.mainTriangles : result.mirrorTriangles) += pass["triangles"].get<int64_t>();
    }
  }
  return result;
}

TEST(LevelPictures, SettingTradesTrianglesForError) {
  QuietSession session(headless(objectsScene(), size));
  EXPECT_EQ(session.settings().reflection.meshError, 0.0) << "the default";
  const Drawn exact = drawn(session, "0");
  ASSERT_GT(exact.mirrorTriangles, 10000);
  double error = 0.0;
  int64_t triangles = exact.mirrorTriangles;
  struct Bound {
    const char* meshError;
    double share;  // of the triangles in mirrors
    double rmse;   // of the whole picture
  };
  for (const Bound& bound : {Bound{"0.25", 0.6, 0.006}, {"0.5", 0.42, 0.011}, {"1", 0.3, 0.015}, {"4", 0.2, 0.03}}) {
    const Drawn simplified = drawn(session, bound.meshError);
    const double rmse = compareImages(comparedImage(exact.picture), comparedImage(simplified.picture)).whole.rmse;
    EXPECT_EQ(simplified.mainTriangles, exact.mainTriangles);
    EXPECT_LE(static_cast<double>(simplified.mirrorTriangles), bound.share * static_cast<double>(exact.mirrorTriangles))
        << bound.meshError;
    EXPECT_LE(simplified.mirrorTriangles, triangles) << bound.meshError;
    EXPECT_GT(rmse, 0.9 * error) << bound.meshError;
    EXPECT_LE(rmse, bound.rmse) << bound.meshError;
    error = rmse;
    triangles = simplified.mirrorTriangles;
  }
}

TEST(LevelPictures, CachedImagesOfSimplifiedObjectsAreQuiet) {
  QuietSession session(optionsFor(objectsScene(), "2", {{"reflection.update_interval", "3"}}));
  for (int frame = 0; frame < 8; ++frame) {
    runFrames(session, 1, 1.0 + 0.02 * frame);
  }
}

TEST(LevelPictures, MemoryFollowsTheSetting) {
  const std::string knot = replaced(wallScene, "sphere", "torus_knot");
  Options options = optionsFor(writeScene("knot", knot), "0", {{"debug.check_finite", "false"}});
  options.size = {32, 18};
  options.validation = false;  // takes longer than the 300 frames themselves
  QuietSession session(options);
  const auto bytesAfter = [&](const char* meshError, int frames) {
    set(session, {{"reflection.mesh_error", meshError}});
    runFrames(session, frames);
    return session.device().allocatedBytes();
  };
  bytesAfter("1", 3);  // buffers that grow stay, one for each frame in flight
  const uint64_t none = bytesAfter("0", 150);
  EXPECT_GT(bytesAfter("1", 3), none);
  EXPECT_EQ(bytesAfter("0", 150), none);
}

}  // namespace
}  // namespace speculum::level_pictures
