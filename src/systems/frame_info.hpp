#pragma once

#include "core/renderer.hpp"
#include "plan/frame_plan.hpp"
#include "systems/frame_data.hpp"
#include "systems/pass_log.hpp"
#include "systems/scene_resources.hpp"
#include "systems/trace_frame.hpp"

namespace speculum {

class ShadowSystem;

// Inputs of the systems for one frame.
struct FrameInfo {
  Frame& frame;
  const Scene& scene;
  const SceneState& state;
  const Settings& settings;
  const FramePlan& plan;
  Environment environment;  // with view.clear_color applied, times ViewSettings::radianceScale()
  bool textured = false;    // drawsTextures()
  const SceneResources& resources;
  const FrameData& data;
  const TraceFrame& trace;
  const ShadowSystem& shadows;
  PassLog& log;
  EffectLedger& ledger;  // in which systems enter their draws
  // By index into plan.passes; valid while the passes that show these images are recorded.
  std::span<const MirrorImage> images;
  std::span<const MirrorImage> cached;  // parallel to FramePlan::cached; set where an earlier frame rendered the image
  // Environment maps by index into plan.cubes, bound in the place of an object's texture; null for shadow maps.
  std::span<const VkDescriptorSet> maps;
  // The color that an encoded main view is cleared with. None: the background is drawn, or the plan does not encode.
  std::optional<VkClearColorValue> encodedBackground;
};

}  // namespace speculum
