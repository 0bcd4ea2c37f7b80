#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/uploader.hpp"
#include "geometry/bvh.hpp"
#include "scene/scene.hpp"
#include "shaders/gpu_data.h"

namespace speculum {

// Says which buffer for rays may be too large for a device; empty: none. `instances` counts all copies.
std::string traceRoomProblem(const Scene& scene, size_t instances, const VkPhysicalDeviceLimits& limits);

// Hierarchies of boxes as shaders follow them, without a stack: gpu_data.h says how nodes are linked. Each has its
// nodes once for each octant of directions; bit i of an octant: directions are negative along axis i.
constexpr int traceOctants = 8;

// Axis-aligned grid that holds the boxes of a mesh.
struct TraceGrid {
  glm::vec3 low{0.0f};    // mesh space
  glm::vec3 scale{1.0f};  // steps of the grid per metre of mesh space
};

// Appends the nodes of the hierarchy over instances and mirrors, for all octants. `links` has a link for each
// primitive, in the primitives' order before the hierarchy was built.
void appendTopNodes(const Bvh& hierarchy, std::span<const uint32_t> links, std::vector<gpu::TraceTopNode>& nodes);

// Buffers for rays that stay the same while a scene is shown: triangles under hierarchies of boxes, attributes of their
// vertices, texels. Uploads are finished when the constructor returns.
class TraceScene {
 public:
  // Offsets of a mesh in the buffers.
  struct MeshRange {
    TraceGrid grid;
    uint32_t root = 0;           // node
    uint32_t nodes = 0;          // of an octant
    uint32_t firstTriangle = 0;  // index of its first one in `faces`, and of its first slot in `triangles`
    uint32_t triangles = 0;
    uint32_t firstVertex = 0;
  };
  enum Kind { nodes, triangles, faces, vertices, textures, texels, kindCount };

  // Returns MaterialData::firstColor of each mesh.
  static std::vector<uint32_t> firstColorsOf(const Scene& scene);

  // Throws std::runtime_error if the device's buffers cannot hold the scene.
  TraceScene(Uploader& uploader, const Scene& scene);

  const std::vector<MeshRange>& meshes() const { return meshes_; }
  const Buffer& buffer(Kind kind) const { return buffers_[kind]; }
  uint64_t bytes() const { return bytesOf(buffers_); }

 private:
  // Uploads the bytes that `content` writes.
  void write(Uploader& uploader, Kind kind, uint64_t bytes, const char* name,
             const std::function<void(BufferWriter&)>& content);
  void writeTriangles(Uploader& uploader, const Scene& scene);  // and hierarchies, and sets `meshes_`
  void writeAttributes(Uploader& uploader, const Scene& scene);
  void writeTextures(Uploader& uploader, const Scene& scene);

  std::vector<MeshRange> meshes_;
  std::array<Buffer, kindCount> buffers_;
};

}  // namespace speculum
