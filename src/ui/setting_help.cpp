#include "ui/setting_help.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace speculum {

namespace {

using Cost = std::pair<std::string_view, std::string_view>;

constexpr std::array<Cost, 38> costs{{
    {"reflection.scale",
     "Pixels of mirror images grow with its square. Below 1 reflections blur, above 1 edges smooth."},
    {"reflection.samples",
     "Shading of mirror images grows with it. NVIDIA H200, gallery, with those of the main view:\n"
     "3.46 ms with 1, 5.68 ms with 4, 9.46 ms with 8."},
    {"reflection.max_depth",
     "Each depth adds passes. facing_mirrors at depth 16 over depth 1, 4 samples: 1.40 times the frame on an H200,\n"
     "3.86 times on a CPU, 1.78 with mesh_error 0.5."},
    {"reflection.min_pixels",
     "Saves the passes of small mirrors: each costs some 0.02 ms of the CPU on the H200's host, whatever it covers."},
    {"reflection.min_throughput", "Saves the passes of bounces that can hardly be seen. 0 draws them all."},
    {"reflection.max_passes",
     "The bound of the price: a pass costs some 0.02 ms of the CPU beside an H200 before it draws anything.\n"
     "mirror_maze needs 55 for all four depths."},
    {"reflection.update_interval",
     "Saves the passes of mirrors seen directly in the frames between; what moves in them moves in steps."},
    {"reflection.skip_unchanged",
     "Saves the passes of mirrors in which nothing changed, and the main view's where nothing at all did; their "
     "images\n"
     "keep their memory."},
    {"reflection.mesh_error",
     "Saves vertices of what is small in mirrors; shading shifts a little with the triangles. Without effect while\n"
     "anything in the picture calls for rays. Simplifying takes a moment when it is first set."},
    {"reflection.clip",
     "oblique loses precision of depth where the eye is near the mirror; none shows what is behind it."},
    {"view.samples",
     "Shading of the main view grows with it. NVIDIA H200, single_plane, with those of mirror images:\n"
     "1.11 ms with 1, 3.18 ms with 4, 5.75 ms with 8."},
    {"view.exposure", "One factor a pixel in the display pass."},
    {"view.tone_map", "A few operations a pixel in the display pass."},
    {"view.clear_color", "Costs nothing: it is drawn where nothing else is, in the place of background and sky."},
    {"view.texture_filter", "trilinear reads eight texels where bilinear reads four; far textures grow calmer."},
    {"view.wireframe", "To see triangles; a device without wireframe fills them."},
    {"view.continuous", "Costs the energy of drawing all the time; without it a still picture costs nothing."},
    {"effects.shadows", "Rays. On an H200 at every sample: 76.9 ms of 80.0 in shadows, 40.2 of 102.5 in pool."},
    {"effects.roughness", "Rays. On an H200: 344.2 ms of 350.4 in rough with 64 rays a pixel."},
    {"effects.rough_samples", "Time grows with it, noise falls with its square root."},
    {"effects.rough_lookup", "image blurs the image of the smooth mirror, for a fraction of the time of rays."},
    {"effects.per_sample", "On an H200, mirror_ball: 130.0 ms at every sample, 54.7 ms once a pixel."},
    {"effects.ripple", "Rays where water is seen. On an H200: 0.7 ms of 102.5 in pool."},
    {"effects.casts_light",
     "Rays. On an H200 at every sample: 66.2 ms of 102.5 in pool, 13.1 of 74.6 in bounced_light."},
    {"effects.curved_lookup",
     "An environment map takes no rays for curved mirrors, and is rendered only when what it shows has changed."},
    {"effects.environment_size",
     "Time and memory grow with its square; the error falls up to the size at which the mirror shows a texel a pixel."},
    {"effects.environment_interval",
     "A map that has changed is rendered in one of so many frames; what moves in it moves in steps."},
    {"effects.environment_box",
     "Nothing measurable; without it the mirror shows everything as if it were infinitely far."},
    {"effects.curved", "Rays. On an H200 at every sample: 70.5 ms of 130.0 in mirror_ball."},
    {"effects.fresnel", "One power of five for each pixel of a mirror that asks for it."},
    {"effects.textures",
     "Four texels read for each pixel of what has one, and the memory of them all while one is in view."},
    {"effects.glyphs", "One draw in each pass that sees a light: a sphere at every sample of the boxes around them."},
    {"quality.budget_ms", "It chooses among what was measured and costs nothing itself."},
    {"quality.max_error", "It chooses among what was measured and costs nothing itself."},
    {"debug.check_finite", "Reads every sample of every target once more on the GPU, each frame."},
    {"debug.skip_hidden", "Saves: in mirror_maze 55 passes show all four depths where 2 613 were needed."},
    {"debug.cull_clusters", "Saves the vertices of what a view cannot see of an object; costs a few draw calls."},
    {"debug.mask_passes",
     "Saves: drawn for each sample seen, 1.32 instead of 1.50 in the gallery, 1.33 instead of 2.26 in many_mirrors."},
}};

}  // namespace

std::string_view settingCost(std::string_view key) {
  const auto* found = std::find_if(costs.begin(), costs.end(), [&](const Cost& cost) { return cost.first == key; });
  return found == costs.end() ? std::string_view() : found->second;
}

std::string settingHelp(std::string_view key) {
  for (const SettingInfo& info : settingInfos()) {
    if (info.key == key) {
      const std::string_view cost = settingCost(key);
      return std::string(key) + "\n" + std::string(info.help) + " (" + std::string(info.range) + ")" +
             (cost.empty() ? "" : "\n\n" + std::string(cost));
    }
  }
  return "";
}

bool differs(const Settings& a, const Settings& b, std::string_view key) {
  return settingValue(a, key) != settingValue(b, key);
}

void resetSetting(Settings& settings, const Settings& from, std::string_view key) {
  if (key == "view.clear_color") {
    settings.view.clearColor = from.view.clearColor;  // none has no text
  } else {
    setSetting(settings, key, settingValue(from, key));
  }
}

}  // namespace speculum
