#pragma once

#include <memory>
#include <string>
#include <vector>

#include "systems/frame_info.hpp"
#include "systems/image_pool.hpp"
#include "systems/mirror_system.hpp"
#include "systems/point_light_system.hpp"
#include "systems/render_system.hpp"

namespace speculum {

// What was recorded for one pass; its GPU figures follow under the same index in FrameTimings::passes.
struct RecordedPass {
  std::string name;
  std::string mirror;             // empty for the main view and the display pass
  std::vector<std::string> path;  // mirrors from the eye
  int depth = -1;                 // -1: the main view or the display pass
  uint32_t draws = 0;
  double areaPx = 0.0;
};

// The name of a mirror as people see it: its `name`, or its index.
std::string mirrorName(const Scene& scene, int mirror);

// Draws one scene: mirror passes, main view, display pass. Owns the systems, the targets and the scene's resources.
class SceneRenderer {
 public:
  SceneRenderer(Renderer& renderer, const Scene& scene);
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  // Records everything up to and with the display pass.
  void record(Frame& frame, const SceneState& state, const Settings& settings, const FramePlan& plan);

  const std::vector<RecordedPass>& passes() const { return recorded_; }
  size_t pipelineCount() const;
  // The main view's linear radiance of the last recorded frame; and a mirror image for the debug view, which shows
  // what its target held when the frame ended.
  OffScreen& mainTarget() { return *main_; }

 private:
  void prepareTargets(const Settings& settings, const FramePlan& plan, RetireQueue& retired);
  void recordMirrorPass(Frame& frame, const FrameInfo& info, size_t index);
  void recordMainPass(Frame& frame, const FrameInfo& info);
  void recordDisplayPass(Frame& frame, const Settings& settings);
  uint32_t recordSystems(const PassScope& scope, const FrameInfo& info, size_t pass, const PassFormat& format);
  const Pipeline& displayPipeline(ToneMap toneMap);

  Renderer& renderer_;
  Device& device_;
  const Scene& scene_;
  SceneResources resources_;
  FrameData data_;
  RenderSystem renderSystem_;
  PointLightSystem pointLightSystem_;
  MirrorSystem mirrorSystem_;
  DescriptorSetLayoutHandle displayLayout_;
  std::map<std::pair<ToneMap, VkFormat>, std::unique_ptr<Pipeline>> displayPipelines_;
  std::unique_ptr<SharedAttachments> shared_;
  std::unique_ptr<ImagePool> pool_;
  std::unique_ptr<OffScreen> main_;
  std::vector<OffScreen*> targets_;  // of the plan's passes while they are alive
  std::vector<MirrorImage> images_;  // likewise
  std::vector<RecordedPass> recorded_;
};

}  // namespace speculum
