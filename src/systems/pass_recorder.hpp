#pragma once

#include "plan/pass_mask.hpp"
#include "systems/deferred_shading.hpp"
#include "systems/mirror_system.hpp"
#include "systems/point_light_system.hpp"
#include "systems/render_system.hpp"
#include "systems/shadow_system.hpp"

namespace speculum {

// Owns the systems, and records with them what the passes of a plan draw: whole passes, or the tiles that the frame
// draws. Submits a part of the frame's commands before they take the GPU too long (tilesAtOnce()). Enters passes in the
// log and costs in the ledger.
class PassRecorder {
 public:
  PassRecorder(Renderer& renderer, VkDescriptorSetLayout frameLayout, VkDescriptorSetLayout textureLayout);

  const ShadowSystem& shadows() const { return shadowSystem_; }
  // Begins a frame: finds its tiles, and makes the targets of shadow maps.
  void beginFrame(Frame& frame, const Scene& scene, const Settings& settings, const FramePlan& plan);
  const TileRange& tiles(size_t pass) const { return tiles_[pass]; }  // that the frame draws of the pass

  // Each records pass `index` of the plan. A face of a shadow map is drawn after its layer, if that is drawn too.
  void recordShadow(const FrameInfo& info, size_t index);
  void recordEnvironment(const FrameInfo& info, size_t index, const PassDesc& desc);
  // Records the frame's tiles of a mirror pass or the main view.
  void recordTiles(const FrameInfo& info, size_t index, const PassDesc& desc);
  // Records `areaPx` texels that `desc` describes.
  void record(const FrameInfo& info, size_t index, const PassDesc& desc, double areaPx);

  void endFaces(const FrameInfo& info) { shadowSystem_.endFrame(info.plan, *info.frame.retired); }
  // Ends a picture: drops what no picture needed for a while, and enters the costs that are not entered with each draw.
  void endPicture(const FrameInfo& info);

 private:
  // Says whether surfaces of the pass are shaded by DeferredShading.
  static bool defers(const FrameInfo& info, size_t index);
  // Submits the frame's commands so far if they leave no room for so many tiles.
  void makeRoom(Frame& frame, size_t tiles);
  void enterCosts(const FrameInfo& info);

  Renderer& renderer_;
  MaskSystem maskSystem_;
  RenderSystem renderSystem_;
  PointLightSystem pointLightSystem_;
  MirrorSystem mirrorSystem_;
  ShadowSystem shadowSystem_;
  DeferredShading deferredShading_;
  std::vector<TileRange> tiles_;   // tilesOfPasses() of the frame
  size_t tilesAtOnce_ = SIZE_MAX;  // tilesAtOnce() of the frame
  size_t tilesLeft_ = SIZE_MAX;    // tiles for which the frame's commands still have room
};

}  // namespace speculum
