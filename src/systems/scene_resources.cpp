#include "systems/scene_resources.hpp"

#include <glm/gtc/packing.hpp>

namespace speculum {

namespace {

std::vector<uint64_t> halfTexels(const Texture& texture) {
  std::vector<uint64_t> texels;
  texels.reserve(texture.texels.size());
  for (const glm::vec3& texel : texture.texels) {
    texels.push_back(glm::packHalf4x16(glm::vec4(texel, 1.0f)));
  }
  return texels;
}

MaterialData materialData(const Material& material) {
  return {.diffuse = glm::vec4(glm::vec3(material.diffuse), static_cast<float>(material.diffuseTexture + 1)),
          .specular = glm::vec4(glm::vec3(material.specular), static_cast<float>(material.shininess)),
          .emission = glm::vec4(glm::vec3(material.emission), 0.0f)};
}

}  // namespace

SceneResources::SceneResources(Device& device, Uploader& uploader, const Scene& scene)
    : device_(device), descriptors_(device) {
  const DescriptorBinding binding{.type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                  .stages = VK_SHADER_STAGE_FRAGMENT_BIT};
  textureLayout_ = createDescriptorSetLayout(device, {&binding, 1}, "texture");
  sampler_ = createSampler(device, {.addressMode = VK_SAMPLER_ADDRESS_MODE_REPEAT}, "texture");
  createTextures(uploader, scene);
  createMeshes(uploader, scene);
}

void SceneResources::createTextures(Uploader& uploader, const Scene& scene) {
  const auto add = [&](const Texture& texture, const std::string& name) {
    const std::vector<uint64_t> texels = halfTexels(texture);
    const VkExtent2D extent{static_cast<uint32_t>(texture.width), static_cast<uint32_t>(texture.height)};
    textures_.push_back(uploader.image(std::as_bytes(std::span(texels)), extent, colorFormat, true, name));
    const VkDescriptorSet set = descriptors_.allocate(textureLayout_.get());
    DescriptorWriter().image(0, textures_.back().descriptor(sampler_.get())).update(device_, set);
    textureSets_.push_back(set);
  };
  for (const Texture& texture : scene.textures) {
    add(texture, "texture " + texture.source.filename().string());
  }
  add(Texture{.width = 1, .height = 1, .texels = {glm::vec3(1.0f)}}, "no texture");
}

void SceneResources::createMeshes(Uploader& uploader, const Scene& scene) {
  std::vector<MaterialData> materials;
  for (const Mesh& mesh : scene.meshes) {
    const std::string name = mesh.source.filename().string();
    std::vector<GpuVertex> vertices;
    vertices.reserve(mesh.vertices.size());
    for (const Vertex& vertex : mesh.vertices) {
      vertices.push_back({glm::vec3(vertex.position), glm::vec3(vertex.normal), glm::vec2(vertex.uv)});
    }
    GpuMesh& gpu = meshes_.emplace_back();
    gpu.vertices =
        uploader.buffer(std::span<const GpuVertex>(vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, name + " vertices");
    gpu.indices =
        uploader.buffer(std::span<const uint32_t>(mesh.indices), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, name + " indices");
    for (const MeshPart& part : mesh.parts) {
      gpu.parts.push_back({part.firstIndex, part.indexCount, static_cast<uint32_t>(materials.size()),
                           textureSet(part.material.diffuseTexture), part.material.diffuseTexture >= 0});
      materials.push_back(materialData(part.material));
    }
  }
  materials.resize(std::max<size_t>(materials.size(), 1));
  materials_ =
      uploader.buffer(std::span<const MaterialData>(materials), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "materials");
}

uint64_t SceneResources::textureBytes() const {
  uint64_t bytes = 0;
  for (size_t i = 0; i + 1 < textures_.size(); ++i) {
    const VkExtent2D extent = textures_[i].extent();
    // RGBA16F; levels that halve both sides add a third.
    bytes += uint64_t{8} * extent.width * extent.height * 4 / 3;
  }
  return bytes;
}

VkDescriptorSet SceneResources::textureSet(int texture) {
  return texture < 0 ? textureSets_.back() : textureSets_[static_cast<size_t>(texture)];
}

}  // namespace speculum
