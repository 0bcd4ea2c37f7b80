#include "systems/trace_scene.hpp"

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <stdexcept>

#include "core/acceleration_structure.hpp"
#include "geometry/triangle_mesh.hpp"

namespace speculum {

struct TraceScene::Content {
  std::vector<gpu::TraceNode> nodes;
  std::vector<gpu::TraceTriangle> triangles;
  std::vector<gpu::TraceFace> faces;
  std::vector<gpu::TraceVertex> vertices;
  std::vector<gpu::TraceTexture> textures;
  std::vector<uint64_t> texels;
  uint32_t materials = 0;  // of the meshes before, as SceneResources counts them
};

namespace {

constexpr int trianglesPerLeaf = 4;

// Appends the texture and its levels down to one texel. Of an odd size the last row or column goes.
void appendLevels(const Texture& texture, std::vector<uint64_t>& texels) {
  std::vector<glm::vec3> level = texture.texels;
  auto width = static_cast<size_t>(texture.width);
  auto height = static_cast<size_t>(texture.height);
  for (;;) {
    for (const glm::vec3& texel : level) {
      texels.push_back(glm::packHalf4x16(glm::vec4(texel, 1.0f)));
    }
    if (level.size() <= 1) {
      return;
    }
    const size_t right = width > 1 ? 1 : 0;
    const size_t below = height > 1 ? width : 0;
    const size_t halfWidth = std::max<size_t>(width / 2, 1);
    const size_t halfHeight = std::max<size_t>(height / 2, 1);
    for (size_t i = 0; i < halfWidth * halfHeight; ++i) {
      const size_t from = 2 * (i / halfWidth) * width + 2 * (i % halfWidth);
      level[i] = 0.25f * (level[from] + level[from + right] + level[from + below] + level[from + right + below]);
    }
    level.resize(halfWidth * halfHeight);
    width = halfWidth;
    height = halfHeight;
  }
}

}  // namespace

TraceBufferBytes traceBufferLimits(const VkPhysicalDeviceLimits& limits) {
  return {.texels = uint64_t{16} * limits.maxTexelBufferElements, .storage = limits.maxStorageBufferRange};
}

TraceBufferBytes largestTraceBuffers(const Scene& scene, size_t instances) {
  uint64_t triangles = 0;
  uint64_t vertices = 0;
  uint64_t texels = 0;
  for (const Mesh& mesh : scene.meshes) {
    triangles += mesh.indices.size() / 3;
    vertices += mesh.vertices.size();
  }
  for (const Texture& texture : scene.textures) {
    texels += 2 * texture.texels.size();  // with the levels
  }
  // A binary tree has fewer than twice as many nodes as leaves, and a leaf holds at least one triangle. The frame's
  // buffers are read as texels and as storage, so both limits apply to them.
  const uint64_t ofFrame = std::max(instances * sizeof(gpu::TraceInstance),
                                    16 * (instances + scene.mirrors.size()) * sizeof(gpu::TraceTopNode));
  return {
      .texels = std::max({16 * triangles * sizeof(gpu::TraceNode), triangles * sizeof(gpu::TraceTriangle), ofFrame}),
      .storage = std::max({vertices * sizeof(gpu::TraceVertex), triangles * sizeof(gpu::TraceFace),
                           texels * sizeof(uint64_t), ofFrame})};
}

TraceScene::TraceScene(Device& device, Uploader& uploader, const Scene& scene) {
  Content content;
  for (const Mesh& mesh : scene.meshes) {
    add(mesh, content);
  }
  for (const Texture& texture : scene.textures) {
    content.textures.push_back({static_cast<uint32_t>(content.texels.size()), static_cast<uint32_t>(texture.width),
                                static_cast<uint32_t>(texture.height)});
    appendLevels(texture, content.texels);
  }
  const auto upload = [&](Kind kind, const auto& values, const char* name) {
    const std::span data = std::as_bytes(std::span(values));
    const bool asTexels = kind == nodes || kind == triangles;
    const TraceBufferBytes limits = traceBufferLimits(device.limits());
    const uint64_t limit = asTexels ? limits.texels : limits.storage;
    if (data.size() > limit) {
      throw std::runtime_error(std::string("the scene has ") + std::to_string(data.size() >> 20) + " MiB of " + name +
                               ", the device takes " + std::to_string(limit >> 20) +
                               " (smaller models, or effects.* = false for what needs rays)");
    }
    const bool built = kind == triangles && device.caps().rayQueries;
    const VkBufferUsageFlags usage =
        asTexels ? VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    buffers_[kind] = uploader.buffer(data, usage | (built ? structureInputUsage : 0), name);
  };
  upload(nodes, content.nodes, "trace nodes");
  upload(triangles, content.triangles, "trace triangles");
  upload(faces, content.faces, "trace faces");
  upload(vertices, content.vertices, "trace vertices");
  upload(textures, content.textures, "trace textures");
  upload(texels, content.texels, "trace texels");
}

uint64_t TraceScene::bytes() const {
  uint64_t sum = 0;
  for (const Buffer& buffer : buffers_) {
    sum += buffer.bytes();
  }
  return sum;
}

void TraceScene::add(const Mesh& mesh, Content& content) {
  const Bvh hierarchy(triangleBounds(mesh), trianglesPerLeaf);
  const auto firstSlot = static_cast<uint32_t>(content.triangles.size());
  meshes_.push_back({.grid = traceGrid(hierarchy.bounds()),
                     .root = static_cast<uint32_t>(content.nodes.size()),
                     .nodes = static_cast<uint32_t>(hierarchy.nodes().size()),
                     .firstTriangle = firstSlot,
                     .triangles = static_cast<uint32_t>(mesh.indices.size() / 3),
                     .firstVertex = static_cast<uint32_t>(content.vertices.size())});
  appendMeshNodes(hierarchy, meshes_.back().grid, firstSlot, content.nodes);
  for (const uint32_t triangle : hierarchy.order()) {
    const uint32_t* index = &mesh.indices[size_t{triangle} * 3];
    content.triangles.push_back({.a = glm::vec3(mesh.vertices[index[0]].position),
                                 .triangle = triangle,
                                 .b = glm::vec3(mesh.vertices[index[1]].position),
                                 .c = glm::vec3(mesh.vertices[index[2]].position)});
  }
  for (const Vertex& vertex : mesh.vertices) {
    content.vertices.push_back({.position = glm::vec3(vertex.position),
                                .u = static_cast<float>(vertex.uv.x),
                                .normal = glm::vec3(vertex.normal),
                                .v = static_cast<float>(vertex.uv.y)});
  }
  const uint32_t* index = mesh.indices.data();
  for (const uint32_t part : partsOfTriangles(mesh)) {
    content.faces.push_back({{index[0], index[1], index[2]}, content.materials + part});
    index += 3;
  }
  content.materials += static_cast<uint32_t>(mesh.parts.size());
}

}  // namespace speculum
