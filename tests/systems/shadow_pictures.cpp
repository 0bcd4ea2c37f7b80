// Shadows that are looked up in maps, against traced ones. frame_shadow_maps.cpp tests which faces are rendered,
// effects_ledger.cpp their cost and its release.
#include <sstream>

#include "plan/reuse_support.hpp"
#include "random.hpp"
#include "sampling.hpp"

namespace speculum::shadow_pictures {
namespace {

using namespace testing_support;

// Pieces on a floor between two lamps, before a wall with a mirror; one lamp is far away.
std::filesystem::path room(const std::string& name, const std::string& rest = "") {
  return writeScene("shadow_maps_" + name, R"(
[environment] background = [0.2, 0.3, 0.4], ambient = [0.15, 0.15, 0.15]
[camera] position = [0.4, 1.8, 3.2], target = [0, 0.5, 0], vertical_fov = 46
[settings] "view.samples" = 1, "reflection.samples" = 1
[[object]] model = "MODELS/block.obj", position = [0, -0.2, 0], scale = [8, 0.2, 8], color = [0.8, 0.75, 0.7]
  specular = [0, 0, 0]
[[object]] model = "MODELS/king.obj", position = [-0.6, 0, 0]
[[object]] model = "MODELS/block.obj", position = [0.6, 0, -0.3], scale = [0.4, 0.9, 0.4], rotation = [0, 30, 0]
[[object]] model = "MODELS/sphere.obj", position = [0.1, 0.45, 0.7], scale = 0.6
[[mirror]] name = "wall", position = [0, 1.1, -1.5], size = [3, 1.8], base_color = [0.1, 0.1, 0.12]
[[light]] name = "lamp", position = [1.2, 2.2, 0.8], intensity = 9, glow = 0, casts_shadow = true
[[light]] name = "sun", position = [-60, 30, 20], intensity = 9000, glow = 0, casts_shadow = true
[[light]] name = "fill", position = [0, 3, 2], intensity = 3, glow = 0
)" + rest);
}

Options mapped(const std::filesystem::path& file, SettingList more = {}) {
  Options options = headless(file, {320, 240});
  set(options, {{"effects.shadow_lookup", "map"}});
  set(options, more);
  return options;
}

// Maps differ from traced shadows along the edges of shadows; more texels make the difference smaller.
TEST(ShadowMaps, LargerFacesReduceError) {
  const std::filesystem::path file = room("error");
  QuietSession session(mapped(file, {{"effects.shadow_lookup", "traced"}}));
  const auto drawn = [&](const char* key, const char* value) {
    set(session, {{key, value}});
    return draw(session);
  };
  const Image8 traced = draw(session);
  const int without = difference(drawn("effects.shadows", "false"), traced, 4).over;
  set(session, {{"effects.shadows", "true"}, {"effects.shadow_lookup", "map"}});
  EXPECT_GT(without, 5000);
  int before = without;
  for (const char* size : {"128", "512", "2048"}) {
    const PictureAgreement agreement = difference(drawn("effects.shadow_map_size", size), traced, 4);
    std::printf("faces of %4s texels: %d of %d pixels over, of %d without shadows\n", size, agreement.over,
                agreement.counted, without);
    EXPECT_LT(agreement.over, 0.7 * before);
    before = agreement.over;
  }
  EXPECT_LT(before, 0.05 * without);
}

// A lit surface has no shadow of its own, whatever its slope.
TEST(ShadowMaps, LitSurfacesAreNotShadowed) {
  const std::filesystem::path file = writeScene("shadow_maps_slopes", R"(
[environment] ambient = [0.1, 0.1, 0.1]
[camera] position = [0, 3, 4], target = [0, 0, 0]
[settings] "view.samples" = 1
[[object]] model = "MODELS/block.obj", position = [0, -0.2, 0], scale = [20, 0.2, 20]
[[object]] model = "MODELS/sphere.obj", position = [0, 20, 0]
[[light]] position = [0.3, 0.4, 0.2], intensity = 6, glow = 0, casts_shadow = true
)");
  for (const char* samples : {"1", "4"}) {
    QuietSession session(mapped(file, {{"effects.shadows", "false"}, {"view.samples", samples}}));
    const Image8 expected = draw(session);
    for (const char* size : {"64", "256", "1024"}) {
      set(session, {{"effects.shadows", "true"}, {"effects.shadow_map_size", size}});
      EXPECT_EQ(difference(draw(session), expected, 1).over, 0) << size << " texels, " << samples << " samples";
    }
  }
}

// Shaders know the face if the scene lies in a single one.
TEST(ShadowMaps, SingleFaceChangesNoByte) {
  const std::string sunny = R"(
[environment] ambient = [0.1, 0.1, 0.1]
[camera] position = [0, 2, 4], target = [0, 0.4, 0]
[[object]] model = "MODELS/block.obj", position = [0, -0.2, 0], scale = [20, 0.2, 20]
[[object]] model = "MODELS/king.obj"
[[mirror]] position = [0, 1, -2], size = [3, 2], base_color = [0.2, 0.2, 0.2]
[[light]] position = [-60, 30, 20], intensity = 9000, glow = 0, casts_shadow = true
)";
  const std::string behindTheSun = "[[object]]\nmodel = \"MODELS/king.obj\"\nposition = [-90, 30, 20]\n";
  const Image8 single = draw(mapped(writeScene("shadow_maps_single_face", sunny)));
  const Image8 several = draw(mapped(writeScene("shadow_maps_several_faces", sunny + behindTheSun)));
  EXPECT_EQ(difference(single, several, 0).over, 0);
}

TEST(ShadowMaps, ListTheirFaces) {
  QuietSession session(mapped(room("faces")));
  const std::vector<std::string> names = drawnMaps("shadow map of ", session);
  EXPECT_TRUE(std::ranges::count(names, "shadow map of light 'lamp' -y"));
  EXPECT_TRUE(std::ranges::count(names, "shadow map of light 'sun' +x"));
  EXPECT_FALSE(std::ranges::count(names, "shadow map of light 'lamp' +y"));
}

// Objects, a mirror and lights in a room, of which some move.
std::string randomRoom(Random& random) {
  std::ostringstream text;
  const auto spin = [&] { return random.chance(0.5) ? ", spin = " + random.vec(-90, 90) : ""; };
  text << "[environment] ambient = [0.1, 0.1, 0.1]\n[camera] position = [0.4, 1.8, 3.2], target = [0, 0.5, 0]\n"
       << "[settings] \"view.samples\" = 1, \"effects.shadow_lookup\" = \"map\"\n"
       << "[[object]] model = \"MODELS/block.obj\", position = [0, -1.4, 0], scale = [" << random.uniform(1, 8)
       << ", 0.2, 2]\n";
  const size_t objects = 3 + random.index(5);
  for (size_t i = 0; i < objects; ++i) {
    constexpr std::array models{"block", "sphere", "gem"};
    text << "[[object]] model = \"MODELS/" << random.pick(models) << ".obj\", position = " << random.vec(-1.2, 1.2)
         << ", rotation = " << random.vec(0, 360) << ", scale = " << random.vec(0.2, 0.8) << spin() << "\n";
  }
  text << "[[mirror]] position = " << random.vec(-1.5, 1.5) << ", rotation = " << random.vec(-60, 60)
       << ", size = [1.5, 1.2], base_color = [0.1, 0.1, 0.1]" << spin() << "\n";
  const size_t lights = 1 + random.index(2);
  for (size_t i = 0; i < lights; ++i) {
    text << "[[light]] casts_shadow = true, glow = 0, ";
    if (random.chance(0.4)) {
      text << "intensity = 9000, position = [-60, 30, 20]\n";
    } else {
      text << "intensity = 9, position = " << random.vec(1, 3)
           << (random.chance(0.3) ? ", orbit = { center = [0, 2, 0], axis = [0, 1, 0], speed = 40 }" : "") << "\n";
    }
  }
  return text.str();
}

// Draws random scenes that move and pause before a camera that jumps: with reuse on one render path, without on the
// other.
TEST(ShadowMaps, LayersChangeNoByteInRandomScenes) {
  int scenes = 0;
  int rendered = 0;
  int reused = 0;
  for (const unsigned seed : sampledSeeds(150, 40)) {
    ++scenes;
    Random random(seed);
    Options options = headless(writeScene("shadow_layers", randomRoom(random)), {96, 72});
    set(options, {{"effects.shadow_map_size", "128"}});
    QuietSession reusing(options);
    set(options, {{"reflection.skip_unchanged", "false"}});
    options.renderPath = RenderPath::renderPass;
    QuietSession rendering(options);
    double time = 0.0;
    for (int frame = 0; frame < 7; ++frame) {
      time += random.chance(0.3) ? 0.0 : random.uniform(0.02, 0.5);
      if (random.chance(0.3)) {
        const glm::dvec3 eye = random.uniform(0.7, 4.0) * glm::dvec3(0.4, 1.8, 3.2) + random.inBox(1.0);
        const CameraPose camera = lookAt(eye, {0, 0.5, 0}, {0, 1, 0}, 46, 0.1);
        reusing.setCamera(camera);
        rendering.setCamera(camera);
      }
      EXPECT_EQ(draw(reusing, time).rgba, draw(rendering, time).rgba) << "seed " << seed << ", frame " << frame;
      for (const Pass& pass : reusing.lastFrame().plan.passes) {
        rendered += pass.isLayer && pass.drawn();
        reused += pass.isLayer && !pass.drawn();
      }
    }
  }
  std::printf("layers rendered %d times, reused %d times\n", rendered, reused);
  EXPECT_GT(rendered, 2 * scenes);
  EXPECT_GT(reused, 3 * scenes);
}

// The picture is the same wherever the scene lies.
TEST(ShadowMaps, HoldFarFromTheOrigin) {
  const auto scene = [](const std::string& name, double x) {
    const auto at = [&](double dx, const char* yz) { return "[" + std::to_string(x + dx) + ", " + yz + "]\n"; };
    return writeScene("shadow_maps_" + name,
                      "[environment]\nambient = [0.1, 0.1, 0.1]\n[camera]\nposition = " + at(0.5, "2, 3") +
                          "target = " + at(0, "0, 0") +
                          "[[object]]\nmodel = \"MODELS/block.obj\"\nscale = [6, 0.2, 6]\n"
                          "position = " +
                          at(0, "-0.2, 0") + "[[object]]\nmodel = \"MODELS/king.obj\"\nposition = " + at(0, "0, 0") +
                          "[[light]]\nintensity = 9\ncasts_shadow = true\nglow = 0\n"
                          "position = " +
                          at(1, "2, 0.5"));
  };
  expectAlike(draw(mapped(scene("far", 1e7))), draw(mapped(scene("near", 0.0))), 2, "shadow_maps_far");
}

// Rays from rough mirrors trace shadows, while drawn surfaces look up maps.
TEST(ShadowMaps, StandBesideTracedEffects) {
  const std::filesystem::path file = room("rough", R"(
[[mirror]] position = [-1.8, 1, 0], rotation = [0, 90, 0], size = [2, 1.8], roughness = 0.2, base_color = [0.2, 0.1, 0.1]
[[object]] model = "MODELS/sphere.obj", position = [1.4, 0.4, 0.2], scale = 0.8, mirror = { base_color = [0.1, 0, 0] }
)");
  Options options = mapped(file, {{"effects.rough_samples", "4"}});
  options.size = {160, 120};
  QuietSession session(options);
  runFrames(session);
  set(session, {{"effects.curved_lookup", "environment"}, {"effects.environment_size", "64"}});
  runFrames(session);
}

}  // namespace
}  // namespace speculum::shadow_pictures
