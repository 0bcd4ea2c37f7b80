#pragma once

#include <optional>
#include <vector>

#include "core/renderer.hpp"
#include "plan/traced_effects.hpp"
#include "systems/frame_buffers.hpp"
#include "systems/pass_log.hpp"
#include "systems/ray_structures.hpp"
#include "systems/trace_scene.hpp"

namespace speculum {

struct FrameInfo;

// Traced effects of a frame, as specialisation constants of pipelines.
struct TraceVariant {
  bool traced = false;  // what is drawn traces shadow rays, or shows light that mirrors bounce
  bool shadows = false;
  bool asks = false;  // shadows are traced only where maps do not decide
  bool castsLight = false;
  bool perSample = false;
  bool hardware = false;      // rays are ray queries
  bool rough = false;         // rays may be reflected by rough mirrors
  bool repeating = false;     // there are RepeatingTriangles
  bool transparency = false;  // some mesh has coverage
  bool vertexColors = false;  // some mesh has them
  bool vertexAlpha = false;   // their alpha counts somewhere

  auto operator<=>(const TraceVariant&) const = default;
};

// Buffers that rays are traced in, with the positions of the present frame. They are made when a frame first has a
// traced effect, and released after some frames without one.
class TraceFrame {
 public:
  TraceFrame(Device& device, Uploader& uploader, const Scene& scene);

  // Number of storage buffers that the shader of deferred shading reads or writes: 4 of FrameData, 3 of
  // DeferredShading, 4 of TraceScene, 3 of TraceFrame.
  static constexpr uint32_t storageBuffers = 14;

  // Fills the buffers of this frame in flight. set() is valid until the frame has finished, and null if no effect is
  // called for.
  void build(const FrameInfo& info);

  VkDescriptorSetLayout layout() const { return layout_; }
  VkDescriptorSet set() const { return set_; }
  const TraceVariant& variant() const { return variant_; }
  uint64_t bytes() const;  // of all its buffers, and of acceleration structures
  RayUse rays() const;     // of the present frame

 private:
  enum Kind { topNodes, instances, mirrors, mirrorEdges, lightPaths, kindCount };

  void create();
  void release(RetireQueue& retired);
  RayUse chooseRays(const SceneState& state, RayMethod method);
  void warnOfManyRays(const Settings& settings, const TracedEffects& effects);
  void prepareStructures(Frame& frame, const SceneState& state, RayMethod method, bool traces);
  void allocateSet(Frame& frame);
  void addInstances(const SceneState& state, const Settings& settings);
  void addHierarchy(const SceneState& state);
  void addMirrors(const SceneState& state, const Settings& settings);
  std::vector<std::byte> lightPathBytes(const SceneState& state, const Settings& settings,
                                        const TracedEffects& effects) const;

  Device& device_;
  Uploader& uploader_;
  const Scene& scene_;
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  std::optional<TraceScene> traceScene_;
  std::optional<RayStructures> structures_;
  RayUse rays_;
  FrameBuffers buffers_;
  std::vector<gpu::TraceTopNode> topNodes_;
  std::vector<gpu::TraceInstance> instances_;
  std::vector<gpu::TraceMirror> mirrors_;
  std::vector<glm::vec4> mirrorEdges_;  // start x, y and end x, y of each edge, along MirrorState::axisX and axisY
  TraceVariant variant_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  int idleFrames_ = 0;           // without any effect
  int structureIdleFrames_ = 0;  // without ray queries
  bool refused_ = false;         // there was no memory for acceleration structures
  bool warned_ = false;          // the log says that effects.rays = hardware is not followed
  bool warnedOfRays_ = false;    // the log says that the driver may leave some rays out
};

}  // namespace speculum
