#pragma once

#include <vector>

#include "core/descriptors.hpp"
#include "core/renderer.hpp"
#include "core/uploader.hpp"
#include "scene/scene.hpp"
#include "settings/settings.hpp"
#include "shaders/gpu_data.h"

namespace speculum {

// A vertex of a mesh; locations 0, 1, 2 of scene.vert.
struct GpuVertex {
  glm::vec3 position;
  glm::vec3 normal;
  glm::vec2 uv;
};

// Resources of a scene on the GPU: meshes and materials for as long as it is shown, textures while something with a
// texture is drawn.
class SceneResources {
 public:
  // Place of a mesh in a buffer of vertices (GpuVertex), indices (uint32) and colors, which meshes share.
  struct GpuMesh {
    VkBuffer buffer = VK_NULL_HANDLE;
    int32_t firstVertex = 0;
    uint32_t firstIndex = 0;
    // Offset at which the colors are bound, bytes: that of a color of vertex 0 of the buffer. Colors are vec3 of each
    // vertex, vec4 if Mesh::hasVertexAlpha(), if the mesh has any.
    VkDeviceSize colors = 0;
  };

  SceneResources(Device& device, Uploader& uploader, const Scene& scene);

  // Begins a frame: calls upload(), and drops textures that have not been drawn for idleFramesKept frames. `drawn` is
  // drawsTextures(). Uploads are finished on return.
  void prepare(Frame& frame, const Settings& settings, bool drawn);
  // Uploads the materials and, if `drawn`, the textures. After an OutOfMemoryError it can be called again with other
  // arguments.
  void upload(Frame& frame, const Settings& settings, bool drawn);

  const std::vector<GpuMesh>& meshes() const { return meshes_; }
  const Buffer& materials() const { return materials_; }
  uint64_t textureBytes() const;  // of the uploaded textures, with all mip levels
  VkDescriptorSet texture(const Material& material) const { return texture(material.diffuseTexture); }
  // Returns the texture of an index into Scene::textures; a white, opaque one for -1 and while none is uploaded.
  VkDescriptorSet texture(int index) const;
  // Returns the constant of shaders/gpu_data.h for pictures that are drawn, where samplers of the device may do part of
  // the filter's work.
  uint32_t textureLookup(TextureFilter filter) const;
  // Returns the descriptor of such a texture.
  VkDescriptorImageInfo image(int texture) const;
  VkDescriptorSetLayout textureLayout() const { return textureLayout_; }

 private:
  Image upload(const Texture& texture, const std::string& name);
  void createTextures();
  void makeSampler(bool anisotropic);
  void writeTextureSets();
  void createMeshes();
  void createMaterials(const EffectSettings& effects, double radianceScale);

  Device& device_;
  Uploader& uploader_;
  const Scene& scene_;
  VkDescriptorSetLayout textureLayout_ = VK_NULL_HANDLE;
  SamplerHandle sampler_;
  DescriptorAllocator descriptors_;
  Image noTexture_;  // a white texel
  VkDescriptorSet noTextureSet_ = VK_NULL_HANDLE;
  std::vector<Image> textures_;               // all of the scene's, or empty
  std::vector<VkDescriptorSet> textureSets_;  // made with textures_, kept when textures_ are dropped
  int idleFrames_ = 0;                        // since textures_ were drawn
  Buffer materials_;
  bool anisotropic_ = false;    // sampler_ filters so
  bool textured_ = false;       // whether materials_ refer to textures
  bool transparent_ = false;    // whether materials_ have coverage
  double radianceScale_ = 1.0;  // of emission in materials_
  std::vector<Buffer> meshBuffers_;
  std::vector<GpuMesh> meshes_;
};

}  // namespace speculum
