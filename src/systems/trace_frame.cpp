#include "systems/trace_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "geometry/affine.hpp"
#include "geometry/reflection.hpp"
#include "systems/gpu_conversion.hpp"

namespace speculum {

namespace {

constexpr std::array bufferNames = {"trace boxes",   "trace items",           "trace instances",
                                    "trace mirrors", "trace mirror vertices", "light paths"};
constexpr uint32_t sceneBindings = TraceScene::kindCount;
constexpr uint32_t frameDataBindings = 4;

void setMirror(const std::optional<ObjectMirror>& mirror, const EffectSettings& effects, gpu::TraceInstance& data) {
  if (mirror && effects.curved) {
    data.curved = isSchlick(mirror->fresnel, effects) ? gpu::curvedSchlick : gpu::curvedConstant;
    data.reflectance = glm::vec3(mirror->reflectance);
    data.baseColor = glm::vec3(mirror->baseColor);
  }
}

gpu::TraceInstance instanceData(const InstanceState& instance, const Object& object, const glm::dvec3& eye) {
  const glm::dmat3& linear = instance.worldFromMesh.linear;
  const glm::dmat3 inverse = glm::inverse(linear);
  const glm::dvec3 offset = inverse * (eye - instance.worldFromMesh.translation);
  const glm::dmat3 normals = unitNormalMatrix(linear);
  gpu::TraceInstance data{};
  for (int r = 0; r < 3; ++r) {
    data.meshFromTrace[r] = row(inverse, r, offset[r]);
    data.normalFromMesh[r] = row(normals, r, 0.0);
  }
  data.change = materialChange(object);
  data.shininess = static_cast<float>(object.shininess.value_or(0.0));
  return data;
}

// Bounds of a box about the mesh's centre, in trace space.
Bounds boundsOf(const InstanceState& instance, const Mesh& mesh, const glm::dvec3& eye) {
  const glm::dvec3 center = instance.worldFromMesh.translation - eye;
  glm::dvec3 reach(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    reach += glm::abs(instance.worldFromMesh.linear[axis]) * mesh.halfExtent[axis];
  }
  Bounds bounds;
  bounds.add(center - reach);
  bounds.add(center + reach);
  return bounds;
}

Bounds boundsOf(const MirrorState& mirror, const glm::dvec3& eye) {
  Bounds bounds;
  for (const glm::dvec3& p : mirror.polygon) {
    bounds.add(p - eye);
  }
  return bounds;
}

}  // namespace

void addConstants(const TraceVariant& variant, std::vector<uint32_t>& constants) {
  constants.resize(2, 0);
  constants.insert(constants.end(), {variant.stackSize, variant.shadows, variant.castsLight, variant.perSample});
}

TraceFrame::TraceFrame(Device& device, Uploader& uploader, const Scene& scene)
    : device_(device), uploader_(uploader), scene_(scene), buffers_(device, bufferNames, "fewer copies of objects") {}

void TraceFrame::create() {
  static_assert(storageBuffers == frameDataBindings + sceneBindings + kindCount);
  nothing_ = Buffer(device_, 0, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferMemory::host, "no trace scene");
  if (layout_) {
    return;
  }
  std::array<DescriptorBinding, sceneBindings + kindCount> bindings{};
  for (uint32_t i = 0; i < bindings.size(); ++i) {
    bindings[i] = {.binding = i, .type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, .stages = VK_SHADER_STAGE_FRAGMENT_BIT};
  }
  layout_ = createDescriptorSetLayout(device_, bindings, "trace");
}

void TraceFrame::release(RetireQueue& retired) {
  if (traceScene_) {
    retired.retire(std::move(*traceScene_));
    traceScene_.reset();
  }
  stackSize_ = 1;
  retired.retire(std::exchange(nothing_, {}));
  buffers_.retire(retired);
}

void TraceFrame::build(Frame& frame, const SceneState& state, const Settings& settings, const TracedEffects& effects) {
  set_ = VK_NULL_HANDLE;
  variant_ = {};
  if (!effects.any()) {
    if (nothing_ && ++idleFrames_ > idleFramesKept) {
      release(*frame.retired);
    }
    return;
  }
  idleFrames_ = 0;
  if (!nothing_) {
    create();
  }
  prepareScene(frame, effects.traces());
  variant_ = {.traced = (effects.shadowRays && !effects.shadowMaps) || effects.castsLight,
              .shadows = effects.shadowRays,
              .castsLight = effects.castsLight.has_value(),
              .perSample = settings.effects.perSample && effects.traces()};
  addMirrors(state, settings);
  addInstances(state, settings, effects.traces());
  buffers_.write(frame, topNodes, topNodes_);
  buffers_.write(frame, items, items_);
  buffers_.write(frame, instances, instances_);
  buffers_.write(frame, mirrors, mirrors_);
  buffers_.write(frame, mirrorVertices, mirrorVertices_);
  buffers_.write(frame, lightPaths, lightPathBytes(state, settings, effects));
  allocateSet(frame);
}

void TraceFrame::prepareScene(Frame& frame, bool traces) {
  if (traces) {
    sceneIdleFrames_ = 0;
    if (!traceScene_) {
      // An upload waits for its own fence; frames in flight are waited for first, as in SceneRenderer::setCover.
      check(vkQueueWaitIdle(device_.queue()), "wait for the queue");
      traceScene_.emplace(device_, uploader_, scene_);
    }
  } else if (traceScene_ && ++sceneIdleFrames_ > idleFramesKept) {
    frame.retired->retire(std::move(*traceScene_));
    traceScene_.reset();
  }
}

void TraceFrame::allocateSet(Frame& frame) {
  set_ = frame.descriptors->allocate(layout_.get());
  DescriptorWriter writer;
  constexpr VkDescriptorType storage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  for (uint32_t i = 0; i < sceneBindings; ++i) {
    const Buffer& buffer = traceScene_ ? traceScene_->buffer(static_cast<TraceScene::Kind>(i)) : nothing_;
    writer.buffer(i, storage, buffer.descriptor());
  }
  for (uint32_t i = 0; i < kindCount; ++i) {
    writer.buffer(sceneBindings + i, storage, buffers_.buffer(frame, i).descriptor());
  }
  writer.update(device_, set_);
}

uint64_t TraceFrame::bytes() const {
  return buffers_.bytes() + (traceScene_ ? traceScene_->bytes() : 0);
}

void TraceFrame::addInstances(const SceneState& state, const Settings& settings, bool meetsObjects) {
  std::vector<Bounds> boxes;
  std::vector<uint32_t> found;
  instances_.clear();
  topNodes_.clear();
  items_.clear();
  const glm::dvec3& eye = state.camera.eye;
  for (size_t i = 0; meetsObjects && i < state.instances.size(); ++i) {
    const InstanceState& instance = state.instances[i];
    const Object& object = scene_.objects[instance.object];
    const TraceScene::MeshRange& mesh = traceScene_->meshes()[instance.mesh];
    gpu::TraceInstance data = instanceData(instance, object, eye);
    data.root = mesh.root;
    data.firstTriangle = mesh.firstTriangle;
    data.firstVertex = mesh.firstVertex;
    setMirror(object.mirror, settings.effects, data);
    instances_.push_back(data);
    if (!scene_.meshes[instance.mesh].indices.empty()) {
      boxes.push_back(boundsOf(instance, scene_.meshes[instance.mesh], eye));
      found.push_back(static_cast<uint32_t>(i));
    }
  }
  for (size_t i = 0; meetsObjects && i < state.mirrors.size(); ++i) {
    boxes.push_back(boundsOf(state.mirrors[i], eye));
    found.push_back(static_cast<uint32_t>(i) | gpu::itemMirror);
  }
  const Bvh top(boxes, 1);
  appendNodes(top, 0, topNodes_);
  for (const uint32_t i : top.order()) {
    items_.push_back(found[i]);
  }
  // One entry for each level, of the top and of the deepest mesh; rounded up, for fewer pipelines.
  const int depth = top.depth() + (traceScene_ ? traceScene_->depth() : 0);
  stackSize_ = std::max(stackSize_, static_cast<uint32_t>(depth + 8) / 8 * 8);
  variant_.stackSize = stackSize_;
}

void TraceFrame::addMirrors(const SceneState& state, const Settings& settings) {
  mirrors_.clear();
  mirrorVertices_.clear();
  for (size_t i = 0; i < scene_.mirrors.size(); ++i) {
    const Mirror& mirror = scene_.mirrors[i];
    const MirrorState& placed = state.mirrors[i];
    const double alpha = settings.effects.roughness ? mirror.roughness * mirror.roughness : 0.0;
    mirrors_.push_back({.origin = glm::vec3(placed.origin - state.camera.eye),
                        .firstVertex = static_cast<uint32_t>(mirrorVertices_.size()),
                        .normal = glm::vec3(placed.normal),
                        .vertexCount = static_cast<uint32_t>(placed.polygon.size()),
                        .axisX = glm::vec3(placed.axisX),
                        .axisY = glm::vec3(placed.axisY),
                        .reflectance = glm::vec3(mirror.reflectance),
                        .schlick = isSchlick(mirror.fresnel, settings.effects),
                        .baseColor = glm::vec3(mirror.baseColor),
                        .twoSided = mirror.twoSided,
                        .backColor = glm::vec3(mirror.backColor),
                        .alpha = static_cast<float>(alpha)});
    if (settings.effects.ripple && mirror.ripple) {
      const RippleConstants ripple = rippleConstants(*mirror.ripple, state.time);
      mirrors_.back().hasRipple = 1;
      mirrors_.back().waveNumber = ripple.waveNumber;
      mirrors_.back().rippleSlope = ripple.slope;
      mirrors_.back().ripplePhase = ripple.phase;
    }
    for (const glm::dvec3& p : placed.polygon) {
      const glm::dvec3 local = p - placed.origin;
      mirrorVertices_.emplace_back(glm::dvec2(glm::dot(local, placed.axisX), glm::dot(local, placed.axisY)));
    }
  }
}

std::vector<std::byte> TraceFrame::lightPathBytes(const SceneState& state, const Settings& settings,
                                                  const TracedEffects& effects) const {
  const gpu::TraceCounts header{.lightPaths = static_cast<uint32_t>(effects.mirroredLights.size()),
                                .items = static_cast<uint32_t>(items_.size()),
                                .roughSamples = static_cast<uint32_t>(settings.effects.roughSamples)};
  std::vector<gpu::LightPath> paths;
  for (const MirroredLight& mirrored : effects.mirroredLights) {
    const PointLight& light = scene_.lights[mirrored.light];
    const glm::dvec3& position = state.lights[mirrored.light].position;
    const MirrorState& mirror = state.mirrors[mirrored.mirror];
    const glm::dvec3 image = reflectPoint(position, {mirror.origin, mirror.normal});
    paths.push_back({.image = glm::vec3(image - state.camera.eye),
                     .radius = static_cast<float>(light.radius),
                     .irradiance = radiance(light.color * light.intensity),
                     .castsShadow = light.castsShadow && settings.effects.shadows,
                     .light = glm::vec3(position - state.camera.eye),
                     .mirror = static_cast<uint32_t>(mirrored.mirror)});
  }
  std::vector<std::byte> bytes(sizeof header + paths.size() * sizeof(gpu::LightPath));
  std::memcpy(bytes.data(), &header, sizeof header);
  if (!paths.empty()) {
    std::memcpy(bytes.data() + sizeof header, paths.data(), paths.size() * sizeof(gpu::LightPath));
  }
  return bytes;
}

}  // namespace speculum
