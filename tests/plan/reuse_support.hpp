#pragma once

#include <nlohmann/json.hpp>

#include "cli/stats.hpp"
#include "picture_support.hpp"
#include "test_headers.hpp"

namespace speculum::testing_support {

// Writes a scene with a mirror that has a layer of its own, a second mirror that is seen in the first, and, if
// `turning`, a third one that turns while the camera orbits.
inline std::filesystem::path roomScene(bool turning = true) {
  const std::string room = R"(
[environment] background = [0.3, 0.4, 0.5], ambient = [0.2, 0.2, 0.2]
[[object]] model = "MODELS/torus_knot.obj", position = [0, 0.7, 0.5]
[[object]] model = "MODELS/queen.obj", position = [1.2, 0, -0.6]
[[light]] position = [1, 3, 3], intensity = 20
[[mirror]] name = "floor", polygon = [[-4, 0, 4], [4, 0, 4], [4, 0, -4], [-4, 0, -4]]
  reflectance = [0.4, 0.4, 0.4], base_color = [0.3, 0.2, 0.1], fresnel = "schlick"
[[mirror]] name = "wall", position = [0, 1, -2], size = [3, 2]
)";
  const std::string camera = "[camera]\nposition = [0.5, 1.4, 4]\ntarget = [0, 0.8, 0]\n";
  const std::string side =
      "[[mirror]]\nname = \"side\"\nposition = [-2, 1, 0]\nrotation = [0, 70, 0]\nspin = [0, 8, 0]\n"
      "size = [1.5, 1.5]\ntwo_sided = true\n";
  return writeScene("room", turning ? camera + "orbit_speed = 5\n" + room + side : camera + room);
}

inline int mirrorPasses(const SceneRenderer& renderer) {
  return static_cast<int>(
      std::ranges::count_if(renderer.passes(), [](const auto& pass) { return depthOf(pass.path) >= 0; }));
}

// Draws a frame and returns the names of its passes that begin with `beginning`. Expects that these passes belong to no
// mirror.
inline std::vector<std::string> drawnMaps(const std::string& beginning, Session& session, double time = 0.0) {
  draw(session, time);
  std::vector<std::string> names;
  const nlohmann::ordered_json stats = frameStats(session);
  for (const auto& pass : stats["passes"]) {
    const std::string name = pass["name"];
    if (name.rfind(beginning, 0) == 0) {
      EXPECT_TRUE(pass["mirror"].is_null() && pass["depth"].is_null() && pass["parent"].is_null()) << name;
      names.push_back(name);
    }
  }
  return names;
}

inline int unchangedMirrors(const nlohmann::ordered_json& stats) {
  return static_cast<int>(
      std::ranges::count_if(stats["skipped"], [](const auto& skip) { return skip["reason"] == "unchanged"; }));
}

// Draws the same frames on both render paths and expects the same bytes.
inline void expectSameOnBothPaths(Options options, const std::vector<double>& times) {
  options.renderPath = RenderPath::dynamic;
  QuietSession dynamic(options);
  options.renderPath = RenderPath::renderPass;
  QuietSession passes(options);
  ASSERT_NE(dynamic.device().renderPath(), passes.device().renderPath());
  for (const double time : times) {
    EXPECT_EQ(draw(dynamic, time).rgba, draw(passes, time).rgba) << "at " << time;
  }
}

}  // namespace speculum::testing_support
