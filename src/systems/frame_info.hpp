#pragma once

#include "core/renderer.hpp"
#include "plan/frame_plan.hpp"
#include "systems/effect_ledger.hpp"
#include "systems/frame_data.hpp"
#include "systems/scene_resources.hpp"
#include "systems/trace_frame.hpp"

namespace speculum {

class ShadowSystem;

// Inputs of the systems for one frame.
struct FrameInfo {
  Frame& frame;
  const Scene& scene;
  const Settings& settings;
  const Environment& environment;  // with view.clear_color applied
  const FramePlan& plan;
  const SceneResources& resources;
  const FrameData& data;
  const TraceFrame& trace;
  const ShadowSystem& shadows;
  EffectLedger& ledger;                 // systems enter their draws
  std::span<const MirrorImage> images;  // of plan.passes, by index; valid while their parent is recorded
  std::span<const MirrorImage> cached;  // parallel to FramePlan::cached; set where an earlier frame rendered the image
  std::span<const VkDescriptorSet> maps;  // of plan.cubes, by index; bound instead of an object's texture
};

}  // namespace speculum
