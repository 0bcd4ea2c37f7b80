#pragma once

#include <vector>

#include "core/renderer.hpp"
#include "plan/frame_plan.hpp"
#include "shaders/gpu_data.h"
#include "systems/frame_buffers.hpp"
#include "systems/pass_log.hpp"
#include "systems/scene_resources.hpp"
#include "systems/trace_frame.hpp"

namespace speculum {

struct FrameInfo;

// A mirror image, for the pass that looks it up.
struct MirrorImage {
  VkDescriptorImageInfo descriptor{};
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

// Instances of one mesh that stand together in the instance buffer and share their colors.
struct Batch {
  int mesh = 0;
  int object = 0;           // index into Scene::objects, of the first instance
  float handedness = 1.0f;  // sign of the determinant of all instances' transforms
  uint32_t firstInstance = 0;
  uint32_t count = 0;
  bool cullsBacks = false;            // no back of a triangle can be seen
  bool curved = false;                // the object is a curved mirror
  bool environment = false;           // the curved mirror looks up an environment map; the batch has one instance
  bool colored = false;               // this curved mirror's base is not black
  int map = -1;                       // index into FramePlan::cubes of this map; -1: it shows the background
  RecycledVector<IndexRange> ranges;  // indices that are drawn; empty: all. Only a batch of one instance has ranges
};

// A mirror that a pass draws.
struct MirrorRange {
  uint32_t mirror = 0;  // index into the mirrors of the frame
  uint32_t firstVertex = 0;
  uint32_t vertexCount = 0;
  int pass = -1;    // index into FramePlan::passes of the pass that rendered its image in this frame; -1: none
  int cached = -1;  // index into FramePlan::cached; -1: none
  bool reprojected = false;
  // Values of specialisation constants of mirror_shading.glsl.
  uint32_t shows = gpu::showsBackground;
  uint32_t lookup = gpu::lookupFetch;  // of its image
  bool blurs = false;                  // it is rough and shown by blurring its image
  bool ripples = false;                // it is rippled and shown by displacing its image
  bool byRays = false;                 // its reflection is traced
  bool rippled = false;                // it shows ripples, by displacing its image or by rays
  bool rough = false;                  // it shows roughness, by blurring its image or by rays
  bool fresnel = false;                // its reflectance depends on the angle of incidence
  int map = -1;                        // index into Scene::textures of its reflectance map; -1: none
  bool base = false;                   // its base is not black
  bool colored = false;                // the base, or the back if that is seen, is not black
};

// Draws of one pass: indices into the buffers of FrameData.
struct DrawList {
  uint32_t pass = 0;        // index into the blocks of the passes that are drawn
  bool mirrorView = false;  // the view is that of a mirror
  float lineWidth = 1.0f;   // of wireframe, texels
  std::vector<Batch> batches;
  std::vector<IndexRange> glyphs;  // of the lights of the pass whose glyphs are drawn
  std::vector<MirrorRange> mirrors;
  uint32_t maskFirstVertex = 0;
  uint32_t maskVertexCount = 0;  // 0: the whole rectangle is drawn
  uint32_t outsideFirstVertex = 0;
  uint32_t outsideVertexCount = 0;  // polygons that cover the texels outside the mirror; 0: none is read
  bool maskOpens = false;           // the mask begins with the polygon that is drawn; else the whole rectangle is
};

// The buffers that the passes of a frame read. Everything is composed in double relative to the eye of its view and
// becomes float once. Each frame in flight has a set of buffers, which grow when a frame needs more.
class FrameData {
 public:
  FrameData(Device& device, bool roundsSumsDown);  // Renderer::roundsSumsDown()

  VkDescriptorSetLayout layout() const { return layout_; }
  // Throws std::runtime_error if the plan draws more instances than a buffer of the device takes. Call it before
  // targets are made.
  void requireFits(const FramePlan& plan) const;
  // Fills the buffers of this frame in flight, for a plan that passed requireFits(). Afterwards passes()[i] belongs to
  // plan.passes[i] and has draws if this pass is drawn. The buffers and their descriptor set are valid until the frame
  // has finished.
  void build(const FrameInfo& info);

  const std::vector<DrawList>& passes() const { return passes_; }
  // Value of `branches` in shading.glsl.
  bool branches() const { return !device_.info().isCpu(); }
  // Says whether vertex shaders of objects hand on values of the draw: on a CPU that saves time for each fragment, and
  // takes time and half a kilobyte for each triangle of a pass. All objects of a scene share the choice, since a
  // further pipeline takes some megabytes there.
  bool handsOn() const { return handsOn_; }
  // InstanceData::repeats of each instance of the scene; empty without repeating triangles.
  std::span<const uint32_t> repeats() const { return repeats_; }
  // Binds the pipeline, descriptor set 0 for draws of `pass`, and `others` as the sets from 1 on, up to the first that
  // is null. `mirror` is MirrorRange::mirror, for draws of mirrors.
  void bind(const Pipeline& pipeline, VkCommandBuffer commands, const DrawList& pass,
            const std::array<VkDescriptorSet, 3>& others = {}, uint32_t mirror = 0) const;
  // MirrorData by MirrorData::index, each at a multiple of 256 bytes.
  VkDescriptorBufferInfo mirrorBuffer(const Frame& frame) const { return buffers_.buffer(frame, mirrors).descriptor(); }
  // InstanceData by instance, as vertex attributes: the same buffer that the set has.
  VkBuffer instanceBuffer() const { return instanceBuffer_; }

 private:
  // Bindings of interface.glsl; the next one is that of SceneResources::materials().
  enum Kind { passBlocks, mirrors, lights, instances, curvedMirrors, mirrorVertices, repeating, kindCount };

  // A uniform block at a dynamic offset, as gpu::MirrorBlock is.
  struct alignas(256) DrawBlock {
    gpu::ViewData view;
    gpu::LightData lights[gpu::fixedLights];  // all lights, if there are no more than these
    gpu::LightGroup lightGroups[gpu::mostLightGroups];
  };

  static VkDescriptorType typeOf(uint32_t kind);
  static VkShaderStageFlags stagesOf(uint32_t kind);

  void addPass(const FrameInfo& info, const Pass& pass, DrawList& data);
  void addLights(const FrameInfo& info, const Pass& pass, DrawBlock& block, DrawList& data);
  void addInstances(const FrameInfo& info, const Pass& pass, const glm::dmat4& clipFromRelative, DrawList& data);
  // Makes the instance's batch look up its environment map.
  void addEnvironment(const FrameInfo& info, const Pass& pass, int instance, Batch& batch);
  void addMirrors(const FrameInfo& info, const Pass& pass, const glm::dmat4& projection, DrawList& data);
  void addRepeating(const FrameInfo& info);
  void addOutside(const FrameInfo& info, const Pass& pass, DrawList& data);
  // `converged`: parts of the pass that are not drawn.
  void addMask(const FrameInfo& info, const Pass& pass, double reach, std::span<const PixelRect> converged,
               DrawList& data);

  Device& device_;
  float lostInSums_;  // ViewData::zenith.w
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  FrameBuffers buffers_;
  std::vector<DrawBlock> passBlocks_;
  std::vector<gpu::MirrorBlock> mirrors_;
  std::vector<gpu::LightData> lights_;
  std::vector<int> lightOrder_;        // the scene's lights in the order in which each pass has them
  std::vector<glm::vec4> clearances_;  // LightData::clearance and height of each light of the scene
  bool handsOn_ = false;
  std::vector<uint32_t> shadowMaps_;  // LightData::shadowMap of each light of the scene
  std::vector<gpu::InstanceData> instances_;
  std::vector<gpu::CurvedMirrorData> curvedMirrors_;
  std::vector<glm::vec4> mirrorVertices_;
  std::vector<gpu::RepeatingTriangle> repeating_;
  std::vector<uint32_t> repeats_;  // InstanceData::repeats of each instance of the scene
  std::vector<DrawList> passes_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkBuffer instanceBuffer_ = VK_NULL_HANDLE;
};

// Says whether any mesh has gpu::RepeatingTriangles.
bool hasRepeatingTriangles(const Scene& scene);

// Returns the value of `lightCount` in shading.glsl for the scene's lights.
uint32_t fixedLightCount(const Scene& scene);

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
