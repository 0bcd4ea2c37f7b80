#pragma once

#include <vector>

#include "core/descriptors.hpp"
#include "core/uploader.hpp"
#include "scene/scene.hpp"
#include "systems/gpu_types.hpp"

namespace speculum {

// What a scene keeps on the GPU as long as it is shown: meshes, materials, textures. Finished on return.
class SceneResources {
 public:
  struct Part {
    uint32_t firstIndex = 0;
    uint32_t indexCount = 0;
    uint32_t material = 0;  // index into materials()
    VkDescriptorSet texture = VK_NULL_HANDLE;
    bool textured = false;
  };
  struct GpuMesh {
    Buffer vertices;
    Buffer indices;  // uint32
    std::vector<Part> parts;
  };

  SceneResources(Device& device, Uploader& uploader, const Scene& scene);

  const std::vector<GpuMesh>& meshes() const { return meshes_; }
  const Buffer& materials() const { return materials_; }
  uint64_t textureBytes() const;  // with all levels, as far as the scene has textures
  VkDescriptorSetLayout textureLayout() const { return textureLayout_.get(); }

 private:
  void createTextures(Uploader& uploader, const Scene& scene);
  void createMeshes(Uploader& uploader, const Scene& scene);
  VkDescriptorSet textureSet(int texture);

  Device& device_;
  DescriptorSetLayoutHandle textureLayout_;
  SamplerHandle sampler_;
  DescriptorAllocator descriptors_;
  std::vector<Image> textures_;  // the last one is a white texel, for materials without a texture
  std::vector<VkDescriptorSet> textureSets_;
  Buffer materials_;
  std::vector<GpuMesh> meshes_;
};

}  // namespace speculum
