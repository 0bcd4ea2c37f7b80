#include "systems/trace_frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include "geometry/reflection.hpp"
#include "systems/gpu_data.hpp"
#include "systems/trace_nodes.hpp"

namespace speculum {

namespace {

constexpr uint32_t sceneBindings = TraceScene::kindCount;
constexpr uint32_t frameDataBindings = 6;

void setMirror(const std::optional<ObjectMirror>& mirror, const EffectSettings& effects, TraceInstance& data) {
  CurvedMirror kind = CurvedMirror::none;
  if (mirror && effects.curved) {
    kind = isSchlick(mirror->fresnel, effects) ? CurvedMirror::schlick : CurvedMirror::constant;
    data.baseColor = glm::vec4(glm::vec3(mirror->baseColor), 0.0f);
  }
  const bool reflects = kind != CurvedMirror::none;
  data.reflectance = glm::vec4(reflects ? glm::vec3(mirror->reflectance) : glm::vec3(0.0f), static_cast<float>(kind));
}

TraceInstance instanceData(const InstanceState& instance, const Object& object, const glm::dvec3& eye) {
  const glm::dmat3& linear = instance.worldFromMesh.linear;
  const glm::dmat3 inverse = glm::inverse(linear);
  const glm::dvec3 offset = inverse * (eye - instance.worldFromMesh.translation);
  const glm::dmat3 normals = unitNormalMatrix(linear);
  TraceInstance data{};
  for (int r = 0; r < 3; ++r) {
    data.meshFromTrace[r] = row(inverse, r, offset[r]);
    data.normalFromMesh[r] = row(normals, r, 0.0);
  }
  data.diffuse = replacement(object.color);
  data.specular = replacement(object.specular);
  data.shininess = static_cast<float>(object.shininess.value_or(0.0));
  return data;
}

// Of a box about the mesh's centre, in trace space.
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

glm::vec4 rippleData(const Ripple& ripple, double time) {
  const double k = 2.0 * std::numbers::pi / ripple.wavelength;
  // The phase is reduced in double: a float of it would have lost its fraction after hours.
  const double phase = std::remainder(k * ripple.speed * time, 2.0 * std::numbers::pi);
  return glm::vec4(glm::dvec4(k, ripple.amplitude * k, phase, 1.0));
}

}  // namespace

void addConstants(const TraceVariant& variant, std::vector<uint32_t>& constants) {
  constants.resize(2, 0);
  constants.insert(constants.end(), {variant.stackSize, variant.shadows, variant.castsLight, variant.perSample});
}

TraceFrame::TraceFrame(Device& device, Uploader& uploader, const Scene& scene)
    : device_(device), uploader_(uploader), scene_(scene) {}

void TraceFrame::create() {
  static_assert(storageBuffers == frameDataBindings + sceneBindings + kindCount);
  nothing_ = Buffer(device_, 0, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferPlace::host, "no trace scene");
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
  for (auto& buffers : buffers_) {
    for (Buffer& buffer : buffers) {
      retired.retire(std::exchange(buffer, {}));
    }
  }
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
  variant_ = {.traced = !effects.shadows.empty() || !effects.castsLight.empty(),
              .shadows = !effects.shadows.empty(),
              .castsLight = !effects.castsLight.empty(),
              .perSample = settings.effects.perSample && effects.traces()};
  addMirrors(state, settings);
  addInstances(state, settings, effects.traces());
  upload(frame, topNodes, std::as_bytes(std::span(topNodes_)));
  upload(frame, items, std::as_bytes(std::span(items_)));
  upload(frame, instances, std::as_bytes(std::span(instances_)));
  upload(frame, mirrors, std::as_bytes(std::span(mirrors_)));
  upload(frame, mirrorVertices, std::as_bytes(std::span(mirrorVertices_)));
  upload(frame, lightPaths, lightPathBytes(state, settings, effects));
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
    writer.buffer(sceneBindings + i, storage, buffers_[frame.index][i].descriptor());
  }
  writer.update(device_, set_);
}

uint64_t TraceFrame::bytes() const {
  uint64_t sum = traceScene_ ? traceScene_->bytes() : 0;
  for (const auto& buffers : buffers_) {
    for (const Buffer& buffer : buffers) {
      sum += buffer.bytes();
    }
  }
  return sum;
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
    TraceInstance data = instanceData(instance, object, eye);
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
    found.push_back(static_cast<uint32_t>(i) | itemMirror);
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
    const bool ripples = settings.effects.ripple && mirror.ripple;
    const bool schlick = isSchlick(mirror.fresnel, settings.effects);
    mirrors_.push_back({.origin = glm::vec3(placed.origin - state.camera.eye),
                        .firstVertex = static_cast<uint32_t>(mirrorVertices_.size()),
                        .normal = glm::vec3(placed.normal),
                        .vertexCount = static_cast<uint32_t>(placed.polygon.size()),
                        .axisX = glm::vec3(placed.axisX),
                        .twoSided = mirror.twoSided,
                        .axisY = glm::vec3(placed.axisY),
                        .alpha = static_cast<float>(alpha),
                        .reflectance = glm::vec4(glm::vec3(mirror.reflectance), schlick ? 1.0f : 0.0f),
                        .baseColor = glm::vec4(glm::vec3(mirror.baseColor), 0.0f),
                        .backColor = glm::vec4(glm::vec3(mirror.backColor), 0.0f),
                        .ripple = ripples ? rippleData(*mirror.ripple, state.time) : glm::vec4(0.0f)});
    for (const glm::dvec3& p : placed.polygon) {
      const glm::dvec3 local = p - placed.origin;
      mirrorVertices_.emplace_back(glm::dvec2(glm::dot(local, placed.axisX), glm::dot(local, placed.axisY)));
    }
  }
}

std::vector<std::byte> TraceFrame::lightPathBytes(const SceneState& state, const Settings& settings,
                                                  const TracedEffects& effects) const {
  const LightPathHeader header{.count = static_cast<uint32_t>(effects.mirroredLights.size()),
                               .itemCount = static_cast<uint32_t>(items_.size()),
                               .roughSamples = static_cast<uint32_t>(settings.effects.roughSamples)};
  std::vector<LightPath> paths;
  for (const MirroredLight& mirrored : effects.mirroredLights) {
    const PointLight& light = scene_.lights[mirrored.light];
    const glm::dvec3& position = state.lights[mirrored.light].position;
    const MirrorState& mirror = state.mirrors[mirrored.mirror];
    const glm::dvec3 image = reflectPoint(position, {mirror.origin, mirror.normal});
    paths.push_back({.image = glm::vec3(image - state.camera.eye),
                     .radius = static_cast<float>(light.radius),
                     .irradiance = glm::vec3(light.color * light.intensity),
                     .castsShadow = light.castsShadow && settings.effects.shadows,
                     .light = glm::vec3(position - state.camera.eye),
                     .mirror = static_cast<uint32_t>(mirrored.mirror)});
  }
  std::vector<std::byte> bytes(sizeof header + paths.size() * sizeof(LightPath));
  std::memcpy(bytes.data(), &header, sizeof header);
  if (!paths.empty()) {
    std::memcpy(bytes.data() + sizeof header, paths.data(), paths.size() * sizeof(LightPath));
  }
  return bytes;
}

void TraceFrame::upload(Frame& frame, Kind kind, std::span<const std::byte> data) {
  static constexpr std::array<const char*, kindCount> names = {
      "trace boxes", "trace items", "trace instances", "trace mirrors", "trace mirror vertices", "light paths"};
  writeGrown(device_, buffers_[frame.index][kind], data, names[kind], "fewer copies of objects");
}

}  // namespace speculum
