#include "systems/ray_structures.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/uploader.hpp"
#include "shaders/gpu_data.h"

namespace speculum {

namespace {

// Updates in a row before a new build: they keep the hierarchy, whose boxes overlap more and more while things move.
constexpr int mostUpdates = 60;
constexpr VkBuildAccelerationStructureFlagsKHR bottomFlags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR |
                                                             VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_COMPACTION_BIT_KHR;

StructureInput trianglesInput(const TraceScene& trace, const TraceScene::MeshRange& mesh) {
  static_assert(offsetof(gpu::TraceTriangle, b) == 16 && offsetof(gpu::TraceTriangle, c) == 32 &&
                sizeof(gpu::TraceTriangle) == 48);
  StructureInput input{.flags = bottomFlags, .count = mesh.triangles};
  input.geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
  input.geometry.geometry.triangles = {
      .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR,
      .vertexFormat = VK_FORMAT_R32G32B32_SFLOAT,
      .vertexData = {trace.buffer(TraceScene::triangles).address() + mesh.firstTriangle * sizeof(gpu::TraceTriangle)},
      .vertexStride = sizeof(gpu::TraceTriangle) / 3,
      .maxVertex = 3 * mesh.triangles - 1,
      .indexType = VK_INDEX_TYPE_NONE_KHR};
  return input;
}

StructureInput boxInput(const Buffer& box) {
  StructureInput input{.flags = bottomFlags, .count = 1};
  input.geometry.geometryType = VK_GEOMETRY_TYPE_AABBS_KHR;
  input.geometry.geometry.aabbs = {.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_AABBS_DATA_KHR,
                                   .data = {box.address()},
                                   .stride = sizeof(VkAabbPositionsKHR)};
  return input;
}

VkTransformMatrixKHR transformOf(const glm::dmat3& linear, const glm::dvec3& translation) {
  VkTransformMatrixKHR matrix{};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      matrix.matrix[r][c] = static_cast<float>(linear[c][r]);
    }
    matrix.matrix[r][3] = static_cast<float>(translation[r]);
  }
  return matrix;
}

VkAccelerationStructureInstanceKHR instanceOf(const glm::dmat3& linear, const glm::dvec3& translation, size_t index,
                                              VkDeviceAddress structure, bool reflected = true) {
  return {.transform = transformOf(linear, translation),
          .instanceCustomIndex = static_cast<uint32_t>(index) & 0xffffffu,
          .mask = reflected ? gpu::maskReflected | gpu::maskShadows : gpu::maskShadows,
          .accelerationStructureReference = structure};
}

// Places the box from -1 to 1 about a polygon of the mirror, `pad` wider on each side.
VkAccelerationStructureInstanceKHR mirrorInstance(const MirrorState& mirror, std::span<const glm::dvec3> polygon,
                                                  const glm::dvec3& eye, double pad, size_t index,
                                                  VkDeviceAddress structure) {
  const MirrorBox box = boxOf(mirror, polygon);
  const glm::dvec2 middle = box.low + 0.5 * box.size;
  const glm::dvec2 half = 0.5 * box.size + pad;
  return instanceOf({half.x * mirror.axisX, half.y * mirror.axisY, pad * mirror.normal},
                    mirror.origin - eye + middle.x * mirror.axisX + middle.y * mirror.axisY, index, structure);
}

// Returns an upper bound of the distance between the eye and anything that rays meet.
double reachOf(const SceneState& state) {
  double reach = 0.0;
  for (const InstanceState& instance : state.instances) {
    reach = std::max(reach, glm::distance(instance.center, state.camera.eye) + instance.radius);
  }
  for (const MirrorState& mirror : state.mirrors) {
    for (const glm::dvec3& p : mirror.polygon) {
      reach = std::max(reach, glm::distance(p, state.camera.eye));
    }
  }
  return reach;
}

bool sameStructures(const std::vector<VkAccelerationStructureInstanceKHR>& a,
                    const std::vector<VkAccelerationStructureInstanceKHR>& b) {
  constexpr auto reference = &VkAccelerationStructureInstanceKHR::accelerationStructureReference;
  return std::ranges::equal(a, b, {}, reference, reference);
}

bool sameBytes(const std::vector<VkAccelerationStructureInstanceKHR>& a,
               const std::vector<VkAccelerationStructureInstanceKHR>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

}  // namespace

RayStructures::RayStructures(Device& device, Uploader& uploader, const TraceScene& trace) : device_(&device) {
  const VkAabbPositionsKHR box{-1.0f, -1.0f, -1.0f, 1.0f, 1.0f, 1.0f};
  box_ = uploader.buffer(std::span(&box, 1), structureInputUsage, "box of mirrors");
  std::vector<StructureInput> inputs;
  for (const TraceScene::MeshRange& mesh : trace.meshes()) {
    if (mesh.triangles > 0) {
      inputs.push_back(trianglesInput(trace, mesh));
    }
  }
  inputs.push_back(boxInput(box_));
  bottom_ = buildCompacted(device, uploader, inputs, bottomStorage_, "acceleration structures");
  auto next = bottom_.begin();
  for (const TraceScene::MeshRange& mesh : trace.meshes()) {
    meshes_.push_back(mesh.triangles > 0 ? addressOf(device, *next++) : 0);
  }
  mirror_ = addressOf(device, *next);
}

bool RayStructures::canHold(const SceneState& state) {
  constexpr size_t mostIndices = 1 << 24;
  return state.instances.size() < mostIndices && state.mirrors.size() < mostIndices &&
         std::ranges::all_of(state.instances, [](const InstanceState& instance) {
           const double volume = std::abs(glm::determinant(instance.worldFromMesh.linear));
           return volume > 1e-30 && volume < 1e30;
         });
}

std::vector<VkAccelerationStructureInstanceKHR> RayStructures::instances(const Scene& scene,
                                                                         const SceneState& state) const {
  const glm::dvec3& eye = state.camera.eye;
  std::vector<VkAccelerationStructureInstanceKHR> all;
  for (size_t i = 0; i < state.instances.size(); ++i) {
    const InstanceState& instance = state.instances[i];
    if (meshes_[instance.mesh] != 0) {
      all.push_back(instanceOf(instance.worldFromMesh.linear, instance.worldFromMesh.translation - eye, i,
                               meshes_[instance.mesh], sees(Onlooker::mirror, scene.objects[instance.object].visible)));
    }
  }
  // Allows for rounding, which moves a ray by some 1e-7 of the largest coordinate. The shader tests the polygon itself.
  const double pad = 1e-5 * reachOf(state);
  for (const MirrorState& mirror : state.mirrors) {
    for (size_t k = 0; k < mirror.pieceCount(); ++k) {
      all.push_back(mirrorInstance(mirror, mirror.piece(k), eye, pad, mirror.firstPiece + k, mirror_));
    }
  }
  return all;
}

StructureInput RayStructures::inputOf(const Top& top, uint32_t count) const {
  StructureInput input{.type = VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR,
                       .flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR |
                                VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_UPDATE_BIT_KHR,
                       .count = count};
  input.geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
  input.geometry.geometry.instances = {.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR,
                                       .data = {top.instances.address()}};
  return input;
}

void RayStructures::grow(Top& top, uint32_t count) const {
  Top larger;
  larger.capacity = count + count / 2;
  larger.instances = Buffer(*device_, larger.capacity * sizeof(VkAccelerationStructureInstanceKHR), structureInputUsage,
                            BufferMemory::host, "traced instances");
  const StructureSizes sizes = structureSizes(*device_, inputOf(larger, larger.capacity));
  larger.storage = Buffer(*device_, sizes.structure, structureUsage, BufferMemory::device, "traced scene");
  larger.scratch = Buffer(*device_, sizes.scratch, scratchUsage, BufferMemory::device, "scratch of the traced scene");
  larger.structure = createStructure(*device_, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, larger.storage, 0,
                                     sizes.structure, "traced scene");
  top.structure.reset();
  top = std::move(larger);
}

void RayStructures::build(const Frame& frame, const Scene& scene, const SceneState& state) {
  Top& top = tops_[frame.index];
  std::vector<VkAccelerationStructureInstanceKHR> wanted = instances(scene, state);
  if (top.structure && sameBytes(top.built, wanted)) {
    return;
  }
  const auto count = static_cast<uint32_t>(wanted.size());
  if (!top.structure || count > top.capacity) {
    grow(top, std::max(count, 1u));
  }
  top.instances.write(std::as_bytes(std::span(wanted)));
  const bool updates = top.updates < mostUpdates && !top.built.empty() && sameStructures(top.built, wanted);
  Barriers::buildToBuild(frame.commands);
  recordBuild(*device_, frame.commands, inputOf(top, count), top.structure, top.scratch, updates);
  Barriers::buildToTrace(frame.commands);
  top.updates = updates ? top.updates + 1 : 0;
  top.built = std::move(wanted);
}

uint32_t RayStructures::count() const {
  return static_cast<uint32_t>(bottom_.size()) +
         static_cast<uint32_t>(std::ranges::count_if(tops_, [](const Top& top) { return top.capacity > 0; }));
}

uint64_t RayStructures::bytes() const {
  uint64_t sum = box_.bytes() + bottomStorage_.bytes();
  for (const Top& top : tops_) {
    sum += top.instances.bytes() + top.storage.bytes() + top.scratch.bytes();
  }
  return sum;
}

}  // namespace speculum
