#include "systems/scene_resources.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "image/image.hpp"
#include "systems/gpu_conversion.hpp"
#include "systems/pass_log.hpp"
#include "systems/trace_scene.hpp"

namespace speculum {

namespace {

// Returns the largest relative error of values that a device decoded from sRGB codes of 8 bits. Light multiplies it, so
// dark texels count as much as others.
float decodingError(const std::array<float, 256>& decoded) {
  float error = 0.0f;
  for (size_t code = 1; code < decoded.size(); ++code) {
    error = std::max(error, std::abs(decoded[code] / srgbDecoded()[code] - 1.0f));
  }
  return error;
}

uint32_t nearestCode(const glm::vec4& texel) {
  const auto coded = [](double value) { return static_cast<uint32_t>(std::lround(255.0 * value)); };
  return coded(texel.a) << 24 | coded(srgbEncode(texel.b)) << 16 | coded(srgbEncode(texel.g)) << 8 |
         coded(srgbEncode(texel.r));
}

// Returns the nearest sRGB codes of all levels, with opacity; nothing unless they stand for the first level exactly.
std::optional<std::vector<uint32_t>> srgbLevels(const Texture& texture) {
  const auto isExact = [](const glm::vec3& texel) {
    return srgbCode(texel.r) && srgbCode(texel.g) && srgbCode(texel.b);
  };
  const auto isCode = [](float opacity) { return opacity == std::round(255.0f * opacity) / 255.0f; };
  if (!std::ranges::all_of(texture.texels, isExact) || !std::ranges::all_of(texture.opacity, isCode)) {
    return std::nullopt;
  }
  std::vector<uint32_t> codes;
  codes.reserve(texture.texels.size() * 4 / 3 + 32);
  forLevels(texture, [&](std::span<const glm::vec4> level) {
    std::ranges::transform(level, std::back_inserter(codes), nearestCode);
  });
  return codes;
}

gpu::MaterialData materialData(const Material& material, const EffectSettings& effects, double radianceScale,
                               uint32_t firstColor) {
  const auto textureOf = [&](int index, bool drawn) {
    return index >= 0 && drawn && effects.textures ? static_cast<uint32_t>(index) : gpu::noTexture;
  };
  return {.diffuse = glm::vec3(material.diffuse),
          .texture = textureOf(material.diffuseTexture, true),
          .specular = glm::vec3(material.specular),
          .shininess = static_cast<float>(material.shininess),
          .emission = radiance(radianceScale * material.emission),
          .clamps = material.clamps,
          .firstColor = firstColor,
          .opacity = effects.transparency ? static_cast<float>(material.opacity) : 1.0f,
          .cutoff = static_cast<float>(material.leastOpacity()),
          .opacityTexture = textureOf(material.opacityTexture, effects.transparency)};
}

// Meshes share buffers of up to this size, so that a pass binds few.
constexpr VkDeviceSize sharedBytes = VkDeviceSize{64} << 20;

size_t bytesOfColor(const Mesh& mesh) {
  return mesh.colors.empty() ? 0 : mesh.hasVertexAlpha() ? sizeof(glm::vec4) : sizeof(glm::vec3);
}

// Returns the bytes of vertices, indices and colors, rounded up to whole vertices.
VkDeviceSize bytesOf(const Mesh& mesh) {
  const VkDeviceSize colorsAndIndices =
      ShadedVertices::countOf(mesh) * bytesOfColor(mesh) + mesh.indices.size() * sizeof(uint32_t);
  const VkDeviceSize whole = (colorsAndIndices + sizeof(GpuVertex) - 1) / sizeof(GpuVertex);
  return (ShadedVertices::countOf(mesh) + whole) * sizeof(GpuVertex);
}

// Writes bytesOf() bytes. `offset` is that of the mesh in its buffer, a multiple of the size of a vertex.
SceneResources::GpuMesh writeMesh(BufferWriter& writer, const Mesh& mesh, VkDeviceSize offset) {
  const ShadedVertices vertices(mesh);
  const VkDeviceSize first = offset / sizeof(GpuVertex);
  const VkDeviceSize colors = offset + ShadedVertices::countOf(mesh) * sizeof(GpuVertex);
  const VkDeviceSize indices = colors + ShadedVertices::countOf(mesh) * bytesOfColor(mesh);
  vertices.forEach([&](const Vertex& vertex, uint32_t) {
    writer.add(GpuVertex{glm::vec3(vertex.position), glm::vec3(vertex.normal), glm::vec2(vertex.uv)});
  });
  for (const glm::vec4& color : vertices.colors()) {
    writer.write(std::as_bytes(std::span(&color, 1)).first(bytesOfColor(mesh)));
  }
  writer.write(std::as_bytes(vertices.indices()));
  constexpr std::array<std::byte, sizeof(GpuVertex)> padding{};
  writer.write(std::span(padding).first(offset + bytesOf(mesh) - indices - vertices.indices().size_bytes()));
  return {.firstVertex = static_cast<int32_t>(first),
          .firstIndex = static_cast<uint32_t>(indices / sizeof(uint32_t)),
          .colors = colors - first * bytesOfColor(mesh)};
}

}  // namespace

SceneResources::SceneResources(Device& device, Uploader& uploader, const Scene& scene)
    : device_(device), uploader_(uploader), scene_(scene), descriptors_(device) {
  textureLayout_ =
      descriptorSetLayout(device, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER}, VK_SHADER_STAGE_FRAGMENT_BIT, "texture");
  makeSampler(false);
  noTexture_ = upload(Texture{.width = 1, .height = 1, .texels = {glm::vec3(1.0f)}}, "no texture");
  noTextureSet_ = descriptors_.allocate(textureLayout_);
  writeTextureSets();
  createMeshes();
}

void SceneResources::upload(Frame& frame, const Settings& settings, bool drawn) {
  const bool textured = settings.effects.textures && !scene_.textures.empty();
  const double scale = settings.view.radianceScale();
  const bool changed =
      !materials_ || textured != textured_ || settings.effects.transparency != transparent_ || scale != radianceScale_;
  const bool anisotropic = settings.view.textureFilter == TextureFilter::anisotropic;
  if (changed || anisotropic != anisotropic_ || (drawn && textures_.empty())) {
    // Waits for frames in flight before the upload, which waits only for its own fence.
    check(vkQueueWaitIdle(device_.queue()), "wait for the queue");
  }
  if (changed) {
    frame.retired->take(materials_);
    createMaterials(settings.effects, scale);
  }
  if (anisotropic != anisotropic_) {
    makeSampler(anisotropic);
    writeTextureSets();
  }
  if (drawn && textures_.empty()) {
    createTextures();
  }
}

uint32_t SceneResources::textureLookup(TextureFilter filter) const {
  const uint32_t lookup = speculum::textureLookup(filter);
  return lookup == gpu::textureAnisotropic && device_.caps().anisotropy ? gpu::textureTrilinear : lookup;
}

void SceneResources::makeSampler(bool anisotropic) {
  sampler_ =
      createSampler(device_,
                    {.addressMode = VK_SAMPLER_ADDRESS_MODE_REPEAT,
                     .anisotropy = anisotropic ? device_.anisotropy(static_cast<float>(gpu::mostAnisotropy)) : 1.0f},
                    "texture");
  anisotropic_ = anisotropic;
}

void SceneResources::prepare(Frame& frame, const Settings& settings, bool drawn) {
  upload(frame, settings, drawn);
  idleFrames_ = drawn ? 0 : std::min(idleFrames_, idleFramesKept) + 1;
  if (idleFrames_ > idleFramesKept) {
    for (Image& texture : textures_) {
      frame.retired->retire(std::move(texture));
    }
    textures_.clear();
  }
}

Image SceneResources::upload(const Texture& texture, const std::string& name) {
  const auto largest = static_cast<int>(device_.limits().maxImageDimension2D);
  if (std::max(texture.width, texture.height) > largest) {
    const Texture small = shrunk(texture, std::min(texture.width, largest), std::min(texture.height, largest));
    spdlog::warn("{}: is drawn with {}x{} texels, the device's largest side is {}", texture.source.string(),
                 small.width, small.height, largest);
    return upload(small, name);
  }
  const VkExtent2D extent = extentOf(texture.width, texture.height);
  if (const auto codes = uploader_.exactSrgb.value_or(false) ? srgbLevels(texture) : std::nullopt) {
    return uploader_.image(std::as_bytes(std::span(*codes)), extent, VK_FORMAT_R8G8B8A8_SRGB, true, name);
  }
  std::vector<uint64_t> texels;
  appendLevels(texture, texels);
  return uploader_.image(std::as_bytes(std::span(texels)), extent, colorFormat, true, name);
}

void SceneResources::createTextures() {
  if (!uploader_.exactSrgb) {
    const float error = decodingError(uploader_.decodedSrgb());
    uploader_.exactSrgb = error <= 0x1p-10f;
    spdlog::info("textures are {}: the device decodes sRGB with an error of {:.3g} %",
                 *uploader_.exactSrgb ? "sRGB of 8 bits" : "half floats", 100.0f * error);
  }
  std::vector<Image> uploaded;  // moved into textures_ once all are there
  uploader_.together([&] {
    for (const Texture& texture : scene_.textures) {
      uploaded.push_back(upload(texture, "texture " + texture.source.filename().string()));
    }
  });
  textures_ = std::move(uploaded);
  writeTextureSets();
}

void SceneResources::writeTextureSets() {
  DescriptorWriter().image(0, noTexture_.descriptor(sampler_.get())).update(device_, noTextureSet_);
  for (size_t i = 0; i < textures_.size(); ++i) {
    if (i == textureSets_.size()) {
      textureSets_.push_back(descriptors_.allocate(textureLayout_));
    }
    DescriptorWriter().image(0, textures_[i].descriptor(sampler_.get())).update(device_, textureSets_[i]);
  }
}

void SceneResources::createMeshes() {
  uploader_.together([&] {
    while (meshes_.size() < scene_.meshes.size()) {
      const std::span<const Mesh> left = std::span(scene_.meshes).subspan(meshes_.size());
      VkDeviceSize bytes = bytesOf(left[0]);
      size_t count = 1;
      while (count < left.size() && bytes + bytesOf(left[count]) <= sharedBytes) {
        bytes += bytesOf(left[count++]);
      }
      BufferWriter writer(uploader_, bytes, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                          left[0].source.filename().string() + (count > 1 ? " and others" : ""));
      VkDeviceSize offset = 0;
      for (const Mesh& mesh : left.first(count)) {
        meshes_.push_back(writeMesh(writer, mesh, offset));
        offset += bytesOf(mesh);
      }
      meshBuffers_.push_back(writer.finish());
      const auto written = std::span(meshes_).last(count);
      std::ranges::for_each(written, [&](GpuMesh& mesh) { mesh.buffer = meshBuffers_.back().get(); });
    }
  });
}

// Makes the materials of all parts, in the order of the meshes.
void SceneResources::createMaterials(const EffectSettings& effects, double radianceScale) {
  std::vector<gpu::MaterialData> materials;
  const std::vector<uint32_t> firstColors = TraceScene::firstColorsOf(scene_);
  for (size_t i = 0; i < scene_.meshes.size(); ++i) {
    for (const MeshPart& part : scene_.meshes[i].parts) {
      materials.push_back(materialData(part.material, effects, radianceScale, firstColors[i]));
    }
  }
  materials.resize(std::max<size_t>(materials.size(), 1));
  materials_ = uploader_.buffer(materials, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "materials");
  textured_ = effects.textures && !scene_.textures.empty();
  transparent_ = effects.transparency;
  radianceScale_ = radianceScale;
}

uint64_t SceneResources::textureBytes() const {
  uint64_t bytes = 0;
  for (const Image& texture : textures_) {
    bytes += bytesOfTexel(texture.format()) * areaOf(texture.extent()) * 4 / 3;  // mip levels add a third
  }
  return bytes;
}

VkDescriptorImageInfo SceneResources::image(int texture) const {
  return (texture < 0 || textures_.empty() ? noTexture_ : textures_[texture]).descriptor(sampler_.get());
}

VkDescriptorSet SceneResources::texture(int index) const {
  return index < 0 || textures_.empty() ? noTextureSet_ : textureSets_[index];
}

}  // namespace speculum
