#include "systems/trace_scene.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <stdexcept>
#include <tuple>

#include "core/acceleration_structure.hpp"
#include "geometry/triangle_mesh.hpp"
#include "systems/gpu_conversion.hpp"

namespace speculum {

namespace {

constexpr int trianglesPerLeaf = 4;

// Sums over all meshes.
struct Totals {
  uint64_t triangles = 0;
  uint64_t vertices = 0;
  uint64_t colors = 0;  // pairs, each in the place of a vertex
};

Totals totalsOf(const Scene& scene) {
  Totals totals;
  for (const Mesh& mesh : scene.meshes) {
    totals.triangles += mesh.indices.size() / 3;
    const size_t vertices = ShadedVertices::countOf(mesh);
    totals.vertices += vertices;
    totals.colors += mesh.colors.empty() ? 0 : (vertices + 1) / 2;
  }
  return totals;
}

constexpr double steps = 65535.0;

// Says whether rays of the octant usually meet the first box later than the second.
bool isLater(const Bounds& first, const Bounds& second, int octant) {
  const glm::dvec3 apart = first.center() - second.center();
  const glm::dvec3 size = glm::abs(apart);
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  return (apart[axis] > 0.0) == ((octant >> axis & 1) == 0);
}

// Calls emit(node, next) depth first, the nearer child first. `next` is the index of the node after the subtree, among
// the nodes of the octant.
template <typename Emit>
void visitInOrder(const Bvh& hierarchy, int octant, Emit&& emit) {
  const std::span nodes = hierarchy.nodes();
  std::vector<uint32_t> sizes(nodes.size(), 1);
  for (size_t i = nodes.size(); i-- > 0;) {
    if (nodes[i].count == 0) {
      sizes[i] += sizes[nodes[i].first] + sizes[nodes[i].first + 1];
    }
  }
  std::vector<uint32_t> stack;
  if (!nodes.empty()) {
    stack.push_back(0);
  }
  for (uint32_t place = 0; !stack.empty(); ++place) {
    const uint32_t i = stack.back();
    stack.pop_back();
    emit(nodes[i], place + sizes[i]);
    if (nodes[i].count == 0) {
      const uint32_t left = nodes[i].first;
      const uint32_t later = isLater(nodes[left].box, nodes[left + 1].box, octant) ? left : left + 1;
      stack.push_back(later);
      stack.push_back(later == left ? left + 1 : left);
    }
  }
}

uint32_t sideOf(double low, double high, bool falls) {
  const auto near = static_cast<uint32_t>(std::clamp(std::floor(low), 0.0, steps));
  const auto far = static_cast<uint32_t>(std::clamp(std::ceil(high), 0.0, steps));
  return falls ? far | near << 16 : near | far << 16;
}

// The levels of a texture that rays read: those of at most `largest` texels a side.
struct TraceLevels {
  glm::uvec2 size{0};    // of the first one
  uint64_t skipped = 0;  // texels of the levels before it
  uint64_t texels = 0;   // of all that are read
};

TraceLevels traceLevels(const Texture& texture, uint32_t largest) {
  glm::uvec2 size(texture.width, texture.height);
  TraceLevels levels{size};
  while (true) {
    const bool isRead = glm::compMax(size) <= largest;
    const uint64_t texels = uint64_t{size.x} * size.y;
    (isRead ? levels.texels : levels.skipped) += texels;
    if (texels == 1) {
      return levels;
    }
    size = glm::max(size / 2u, 1u);
    levels.size = isRead ? levels.size : size;
  }
}

// Returns the largest power of two with which, as `largest`, all textures together have at most `most` texels.
uint32_t largestTraceTexture(const Scene& scene, uint64_t most) {
  uint32_t largest = 1u << 31;
  const auto texels = [&] {
    uint64_t sum = 0;
    for (const Texture& texture : scene.textures) {
      sum += traceLevels(texture, largest).texels;
    }
    return sum;
  };
  while (largest > 1 && texels() > most) {
    largest /= 2;
  }
  return largest;
}

uint64_t texelLimit(const VkPhysicalDeviceLimits& limits) {
  return uint64_t{16} * limits.maxTexelBufferElements;
}

std::string roomProblem(uint64_t bytes, const char* name, uint64_t limit) {
  return fmt::format("the scene has {} MiB of {}, the device takes {}", bytes >> 20, name, limit >> 20);
}

TraceGrid traceGrid(const Bounds& bounds) {
  TraceGrid grid;
  const glm::dvec3 size = bounds.high - bounds.low;
  const double largest = std::max(glm::compMax(size), 1e-30);
  for (int axis = 0; axis < 3; ++axis) {
    // A margin for rounding to float; axes along which a mesh is flat get steps no finer than floats.
    const double width = std::max(size[axis], 1e-3 * largest);
    grid.low[axis] = static_cast<float>(bounds.low[axis] - 1e-3 * width);
    grid.scale[axis] = static_cast<float>(steps / (1.002 * width));
  }
  return grid;
}

// Calls `visit` with the nodes of a mesh for all octants in the order of the buffer, `hierarchy.nodes().size()` for
// each octant. The first one has index `firstNode` in the buffer. Boxes only grow by rounding.
void visitMeshNodes(const Bvh& hierarchy, const TraceGrid& grid, uint32_t firstTriangle, uint32_t firstNode,
                    const std::function<void(const gpu::TraceNode&)>& visit) {
  for (int octant = 0; octant < traceOctants; ++octant) {
    const uint32_t first = firstNode + static_cast<uint32_t>(static_cast<size_t>(octant) * hierarchy.nodes().size());
    visitInOrder(hierarchy, octant, [&](const Bvh::Node& node, uint32_t next) {
      const glm::dvec3 low = (node.box.low - glm::dvec3(grid.low)) * glm::dvec3(grid.scale);
      const glm::dvec3 high = (node.box.high - glm::dvec3(grid.low)) * glm::dvec3(grid.scale);
      gpu::TraceNode made;
      for (int axis = 0; axis < 3; ++axis) {
        made.sides[axis] = sideOf(low[axis], high[axis], (octant >> axis & 1) != 0);
      }
      made.link = node.count > 0 ? gpu::traceLeaf | (firstTriangle + node.first) << 3 | node.count : first + next;
      visit(made);
    });
  }
}

}  // namespace

std::string traceRoomProblem(const Scene& scene, size_t instances, const VkPhysicalDeviceLimits& limits) {
  const auto [triangles, vertices, colors] = totalsOf(scene);
  // A binary tree has fewer than twice as many nodes as leaves, and a leaf holds at least one triangle. The frame's
  // buffers are read as texels and as storage, so both limits apply to them.
  size_t pieces = scene.mirrors.size();
  for (const MaterialMirror& made : scene.materialMirrors) {
    pieces += scene.meshes[scene.objects[made.object].mesh].mirrorParts->flat[made.flat].pieces.size();
  }
  const uint64_t ofFrame =
      std::max(instances * sizeof(gpu::TraceInstance), 16 * (instances + pieces) * sizeof(gpu::TraceTopNode));
  const uint64_t asTexels = texelLimit(limits);
  const uint64_t storage = limits.maxStorageBufferRange;
  for (const auto& [bytes, name, limit] : std::initializer_list<std::tuple<uint64_t, const char*, uint64_t>>{
           {16 * triangles * sizeof(gpu::TraceNode), "trace nodes", asTexels},
           {triangles * sizeof(gpu::TraceTriangle), "trace triangles", asTexels},
           {(vertices + colors) * sizeof(gpu::TraceVertex), "trace vertices", storage},
           {triangles * sizeof(gpu::TraceFace), "trace faces", storage},
           {ofFrame, "trace instances", std::min(asTexels, storage)}}) {
    if (bytes > limit) {
      return roomProblem(bytes, name, limit);
    }
  }
  return {};
}

TraceScene::TraceScene(Uploader& uploader, const Scene& scene) {
  writeTriangles(uploader, scene);
  writeAttributes(uploader, scene);
  writeTextures(uploader, scene);
}

void TraceScene::write(Uploader& uploader, Kind kind, uint64_t bytes, const char* name,
                       const std::function<void(BufferWriter&)>& content) {
  const Device& device = uploader.device();
  const bool asTexels = kind == nodes || kind == triangles;
  const uint64_t limit = asTexels ? texelLimit(device.limits()) : device.limits().maxStorageBufferRange;
  if (bytes > limit) {
    throw std::runtime_error(roomProblem(bytes, name, limit) +
                             " (smaller models, or effects.* = false for what needs rays)");
  }
  const bool built = kind == triangles && device.caps().rayQueries;
  const VkBufferUsageFlags usage =
      asTexels ? VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  BufferWriter writer(uploader, bytes, usage | (built ? structureInputUsage : 0), name);
  content(writer);
  buffers_[kind] = writer.finish();
}

void TraceScene::writeTriangles(Uploader& uploader, const Scene& scene) {
  std::vector<Bvh> hierarchies;
  size_t nodeCount = 0;
  size_t triangleCount = 0;
  size_t vertexCount = 0;
  for (const Mesh& mesh : scene.meshes) {
    const Bvh& hierarchy = hierarchies.emplace_back(triangleBounds(mesh), trianglesPerLeaf);
    const MeshRange& range = meshes_.emplace_back(MeshRange{.grid = traceGrid(hierarchy.bounds()),
                                                            .root = static_cast<uint32_t>(nodeCount),
                                                            .nodes = static_cast<uint32_t>(hierarchy.nodes().size()),
                                                            .firstTriangle = static_cast<uint32_t>(triangleCount),
                                                            .triangles = static_cast<uint32_t>(mesh.indices.size() / 3),
                                                            .firstVertex = static_cast<uint32_t>(vertexCount)});
    nodeCount += size_t{traceOctants} * range.nodes;
    triangleCount += range.triangles;
    vertexCount += ShadedVertices::countOf(mesh);
  }
  write(uploader, nodes, nodeCount * sizeof(gpu::TraceNode), "trace nodes", [&](BufferWriter& writer) {
    for (size_t i = 0; i < hierarchies.size(); ++i) {
      visitMeshNodes(hierarchies[i], meshes_[i].grid, meshes_[i].firstTriangle, meshes_[i].root,
                     [&](const gpu::TraceNode& node) { writer.add(node); });
    }
  });
  write(uploader, triangles, triangleCount * sizeof(gpu::TraceTriangle), "trace triangles", [&](BufferWriter& writer) {
    uint32_t materials = 0;  // of the meshes before, as SceneResources counts them
    for (size_t i = 0; i < hierarchies.size(); ++i) {
      const Mesh& mesh = scene.meshes[i];
      const std::vector<uint32_t> parts = mesh.isTransparent() ? partsOfTriangles(mesh) : std::vector<uint32_t>();
      const auto coverageOf = [&](uint32_t triangle) {
        const bool transparent = !parts.empty() && mesh.parts[parts[triangle]].material.isTransparent();
        return transparent ? 1 + materials + parts[triangle] : 0;
      };
      for (const uint32_t triangle : hierarchies[i].order()) {
        const uint32_t* index = &mesh.indices[size_t{triangle} * 3];
        writer.add(gpu::TraceTriangle{.a = glm::vec3(mesh.vertices[index[0]].position),
                                      .triangle = triangle,
                                      .b = glm::vec3(mesh.vertices[index[1]].position),
                                      .coverage = coverageOf(triangle),
                                      .c = glm::vec3(mesh.vertices[index[2]].position)});
      }
      materials += static_cast<uint32_t>(mesh.parts.size());
    }
  });
}

std::vector<uint32_t> TraceScene::firstColorsOf(const Scene& scene) {
  uint64_t next = 2 * totalsOf(scene).vertices;
  std::vector<uint32_t> first;
  for (const Mesh& mesh : scene.meshes) {
    first.push_back(mesh.colors.empty() ? gpu::noColors : static_cast<uint32_t>(next));
    next += mesh.colors.empty() ? 0 : (ShadedVertices::countOf(mesh) + 1) / 2 * 2;
  }
  return first;
}

void TraceScene::writeAttributes(Uploader& uploader, const Scene& scene) {
  const Totals totals = totalsOf(scene);
  write(uploader, faces, totals.triangles * sizeof(gpu::TraceFace), "trace faces", [&](BufferWriter& writer) {
    uint32_t materials = 0;  // of the meshes before, as SceneResources counts them
    for (const Mesh& mesh : scene.meshes) {
      const ShadedVertices vertices(mesh);
      const uint32_t* index = vertices.indices().data();
      for (const uint32_t part : partsOfTriangles(mesh)) {
        writer.add(gpu::TraceFace{{index[0], index[1], index[2]}, materials + part});
        index += 3;
      }
      materials += static_cast<uint32_t>(mesh.parts.size());
    }
  });
  const uint64_t vertexBytes = (totals.vertices + totals.colors) * sizeof(gpu::TraceVertex);
  write(uploader, vertices, vertexBytes, "trace vertices", [&](BufferWriter& writer) {
    for (const Mesh& mesh : scene.meshes) {
      ShadedVertices(mesh).forEach([&](const Vertex& vertex, uint32_t) {
        writer.add(gpu::TraceVertex{.position = glm::vec3(vertex.position),
                                    .u = static_cast<float>(vertex.uv.x),
                                    .normal = glm::vec3(vertex.normal),
                                    .v = static_cast<float>(vertex.uv.y)});
      });
    }
    for (const Mesh& mesh : scene.meshes) {
      const std::vector<glm::vec4> colors = ShadedVertices(mesh).colors();
      for (size_t i = 0; i < colors.size(); i += 2) {
        const glm::vec4& next = colors[std::min(i + 1, colors.size() - 1)];
        writer.add(gpu::TraceVertex{
            .position = glm::vec3(colors[i]), .u = colors[i].a, .normal = glm::vec3(next), .v = next.a});
      }
    }
  });
}

void TraceScene::writeTextures(Uploader& uploader, const Scene& scene) {
  const uint64_t most = uploader.device().limits().maxStorageBufferRange / sizeof(uint64_t);
  const uint32_t largest = largestTraceTexture(scene, most);
  std::vector<gpu::TraceTexture> first;
  std::vector<uint64_t> levels;
  uint64_t skipped = 0;
  for (const Texture& texture : scene.textures) {
    const TraceLevels read = traceLevels(texture, largest);
    first.push_back({static_cast<uint32_t>(levels.size()), read.size.x, read.size.y});
    appendLevels(texture, levels, read.skipped);
    skipped += read.skipped;
  }
  if (skipped > 0) {
    spdlog::warn("rays see textures of at most {} texels a side: {}", largest,
                 roomProblem((levels.size() + skipped) * sizeof(uint64_t), "trace texels", most * sizeof(uint64_t)));
  }
  write(uploader, textures, first.size() * sizeof(gpu::TraceTexture), "trace textures",
        [&](BufferWriter& writer) { writer.write(std::as_bytes(std::span(first))); });
  write(uploader, texels, levels.size() * sizeof(uint64_t), "trace texels",
        [&](BufferWriter& writer) { writer.write(std::as_bytes(std::span(levels))); });
}

void appendTopNodes(const Bvh& hierarchy, std::span<const uint32_t> links, std::vector<gpu::TraceTopNode>& nodes) {
  for (int octant = 0; octant < traceOctants; ++octant) {
    const auto first = static_cast<uint32_t>(nodes.size());
    visitInOrder(hierarchy, octant, [&](const Bvh::Node& node, uint32_t next) {
      const Bounds box = node.box.widened(1e-6);
      const glm::vec3 low(box.low);
      const glm::vec3 high(box.high);
      gpu::TraceTopNode& added = nodes.emplace_back();
      for (int axis = 0; axis < 3; ++axis) {
        const bool falls = (octant >> axis & 1) != 0;
        added.near[axis] = falls ? high[axis] : low[axis];
        added.far[axis] = falls ? low[axis] : high[axis];
      }
      added.link = node.count > 0 ? gpu::traceLeaf | links[hierarchy.order()[node.first]] : first + next;
    });
  }
}

}  // namespace speculum
