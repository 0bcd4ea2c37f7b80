#include "systems/trace_frame.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "geometry/affine.hpp"
#include "geometry/polygon.hpp"
#include "plan/cube_face.hpp"
#include "scene/material_mirrors.hpp"
#include "scene/scene_state.hpp"
#include "systems/frame_data.hpp"
#include "systems/gpu_conversion.hpp"

namespace speculum {

namespace {

constexpr std::array traceBufferNames = {"trace boxes", "trace instances", "trace mirrors", "trace mirror edges",
                                         "light paths"};
constexpr uint32_t sceneBindings = TraceScene::kindCount;
constexpr uint32_t structureBinding = 13;  // in trace_ray_query.glsl
// Bindings of trace.glsl that are texel buffers: the scene's nodes and triangles; the frame's nodes, edges, instances
// and mirrors.
constexpr std::array<bool, structureBinding> readsTexels = {true,  true,  false, false, false, false, true,
                                                            false, false, true,  false, true,  true};

void setMirror(const std::optional<ObjectMirror>& mirror, const EffectSettings& effects, gpu::TraceInstance& data) {
  if (mirror && effects.curved) {
    const MirrorOptics optics = opticsOf(*mirror, effects);
    data.curved = optics.fresnel == Fresnel::schlick ? gpu::curvedSchlick : gpu::curvedConstant;
    data.reflectance = glm::vec3(optics.reflectance);
    data.baseColor = glm::vec3(optics.baseColor);
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
    data.normalFromMesh[r] = row(normals, r, reachOf(instance, eye));
  }
  data.change = materialChange(object);
  data.shininess = static_cast<float>(object.shininess.value_or(0.0));
  return data;
}

uint32_t layersOf(const MirrorState& mirror) {
  const auto half = [](int layer) { return static_cast<uint32_t>(std::min(layer, 0xffff)); };
  return half(mirror.frontLayer) | half(mirror.backLayer) << 16;
}

}  // namespace

TraceFrame::TraceFrame(Device& device, Uploader& uploader, const Scene& scene)
    : device_(device),
      uploader_(uploader),
      scene_(scene),
      buffers_(device, traceBufferNames, "fewer copies of objects", true) {}

void TraceFrame::create() {
  // Waits for frames in flight before the upload, which waits only for its own fence.
  check(vkQueueWaitIdle(device_.queue()), "wait for the queue");
  traceScene_.emplace(uploader_, scene_);
  if (layout_) {
    return;
  }
  std::vector<DescriptorBinding> bindings;
  for (uint32_t i = 0; i < structureBinding; ++i) {
    bindings.push_back(
        {.binding = i,
         .type = readsTexels[i] ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
         .stages = VK_SHADER_STAGE_COMPUTE_BIT});
  }
  if (device_.caps().rayQueries) {
    bindings.push_back({.binding = structureBinding,
                        .type = VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR,
                        .stages = VK_SHADER_STAGE_COMPUTE_BIT});
  }
  layout_ = descriptorSetLayout(device_, bindings, "trace");
}

void TraceFrame::release(RetireQueue& retired) {
  retired.take(structures_);
  retired.take(traceScene_);
  buffers_.retire(retired);
}

void TraceFrame::build(const FrameInfo& info) {
  Frame& frame = info.frame;
  const SceneState& state = info.state;
  const Settings& settings = info.settings;
  const TracedEffects& effects = info.plan.effects;
  set_ = VK_NULL_HANDLE;
  variant_ = {};
  rays_ = {};
  if (!effects.any()) {
    if (traceScene_ && ++idleFrames_ > idleFramesKept) {
      release(*frame.retired);
    }
    return;
  }
  idleFrames_ = 0;
  if (!traceScene_) {
    create();
  }
  variant_ = {
      .traced = (effects.shadowRays && !effects.shadowMaps) || effects.hybridShadows || effects.castsLight,
      .shadows = effects.shadowRays,
      .asks = effects.hybridShadows,
      .castsLight = effects.castsLight.has_value(),
      .perSample = settings.effects.perSample && effects.traces(),
      .repeating = hasRepeatingTriangles(scene_),
      .transparency =
          std::ranges::any_of(scene_.meshes, [&](const Mesh& m) { return isTransparent(m, settings.effects); }),
      .vertexColors = std::ranges::any_of(scene_.meshes, [](const Mesh& m) { return !m.colors.empty(); }),
      .vertexAlpha = settings.effects.transparency && std::ranges::any_of(scene_.meshes, &Mesh::hasVertexAlpha)};
  addMirrors(state, settings);
  prepareStructures(frame, state, settings.effects.rays, effects.traces());
  variant_.hardware = rays_.hardware;
  variant_.rough = effects.reflects() && std::ranges::any_of(mirrors_, [](const auto& m) { return m.alpha > 0.0f; });
  instances_.clear();
  topNodes_.clear();
  addInstances(state, settings);
  if (effects.traces() && !rays_.hardware) {
    addHierarchy(state);
  }
  warnOfManyRays(settings, effects);
  buffers_.write(frame, topNodes, topNodes_);
  buffers_.write(frame, instances, instances_);
  buffers_.write(frame, mirrors, mirrors_);
  buffers_.write(frame, mirrorEdges, mirrorEdges_);
  buffers_.write(frame, lightPaths, lightPathBytes(state, settings, effects));
  allocateSet(frame);
}

// lavapipe ends all loops of an invocation after 65 535 iterations, of which a ray takes some 40. Each sample of a
// rough mirror is an invocation of its own.
void TraceFrame::warnOfManyRays(const Settings& settings, const TracedEffects& effects) {
  constexpr size_t most = 1000;
  int samples = std::min(settings.view.samples, settings.reflection.samples);  // the fewest send the most rays
  for (const Mirror& mirror : scene_.mirrors) {
    samples = std::min(samples, reflectionOf(mirror.quality, settings).samples);
  }
  const int rough = effects.roughRays ? roughRays(settings.effects, samples) / samples : 1;
  const size_t rays = static_cast<size_t>(rough) * (1 + effects.raysToLights(scene_));
  if (device_.info().isCpu() && rays > most && !std::exchange(warnedOfRays_, true)) {
    spdlog::warn(
        "{} rays a sample: this driver may end a shader before it has followed all of them, so that light is "
        "missing (fewer lights that cast shadows, a lower effects.rough_samples, or another GPU)",
        rays);
  }
}

RayUse TraceFrame::chooseRays(const SceneState& state, RayMethod method) {
  const bool cpu = device_.info().isCpu();
  RayUse use{.traced = true};
  if (method == RayMethod::software) {
    use.why = "effects.rays = software";
  } else if (!device_.caps().rayQueries) {
    use.why = "the device has no ray queries";
  } else if (method == RayMethod::automatic && cpu) {
    use.why = "the driver runs on the CPU";
  } else if (!RayStructures::canHold(state)) {
    use.why = "an object's scale is beyond single precision";
  } else if (refused_) {
    use.why = "there is no memory for acceleration structures";
  } else {
    use.hardware = true;
    use.why = method == RayMethod::hardware ? "effects.rays = hardware" : "the device has ray queries";
  }
  if (method == RayMethod::hardware && !use.hardware && !std::exchange(warned_, true)) {
    spdlog::warn("effects.rays = hardware: shaders trace the rays, because {}", use.why);
  }
  return use;
}

void TraceFrame::prepareStructures(Frame& frame, const SceneState& state, RayMethod method, bool traces) {
  rays_ = traces ? chooseRays(state, method) : RayUse{};
  if (!rays_.hardware) {
    if (traces || ++structureIdleFrames_ > idleFramesKept) {
      frame.retired->take(structures_);
    }
    return;
  }
  structureIdleFrames_ = 0;
  try {
    if (!structures_) {
      check(vkQueueWaitIdle(device_.queue()), "wait for the queue");
      structures_.emplace(device_, uploader_, *traceScene_);
    }
    structures_->build(frame, scene_, state);
  } catch (const OutOfMemoryError&) {
    refused_ = true;
    frame.retired->take(structures_);
    rays_ = chooseRays(state, method);
  }
}

void TraceFrame::allocateSet(Frame& frame) {
  set_ = frame.descriptors->allocate(layout_);
  DescriptorWriter writer;
  std::array<const Buffer*, structureBinding> bound{};
  for (uint32_t i = 0; i < sceneBindings; ++i) {
    bound[i] = &traceScene_->buffer(static_cast<TraceScene::Kind>(i));
  }
  for (uint32_t i = 0; i < kindCount; ++i) {
    bound[sceneBindings + i] = &buffers_.buffer(frame, i);
  }
  bound[sceneBindings + kindCount] = &buffers_.buffer(frame, instances);
  bound[sceneBindings + kindCount + 1] = &buffers_.buffer(frame, mirrors);
  for (uint32_t i = 0; i < structureBinding; ++i) {
    if (readsTexels[i]) {
      writer.texels(i, bound[i]->texels());
    } else {
      writer.buffer(i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, bound[i]->descriptor());
    }
  }
  if (rays_.hardware) {
    writer.structure(structureBinding, structures_->top(frame));
  }
  writer.update(device_, set_);
}

uint64_t TraceFrame::bytes() const {
  return buffers_.bytes() + (traceScene_ ? traceScene_->bytes() : 0) + (structures_ ? structures_->bytes() : 0);
}

RayUse TraceFrame::rays() const {
  RayUse use = rays_;
  use.structures = structures_ ? structures_->count() : 0;
  use.structureBytes = structures_ ? structures_->bytes() : 0;
  return use;
}

void TraceFrame::addInstances(const SceneState& state, const Settings& settings) {
  uint32_t repeating = 0;
  for (const InstanceState& instance : state.instances) {
    const Object& object = scene_.objects[instance.object];
    const TraceScene::MeshRange& mesh = traceScene_->meshes()[instance.mesh];
    gpu::TraceInstance data = instanceData(instance, object, state.camera.eye);
    data.gridLow = mesh.grid.low;
    data.root = mesh.root;
    data.gridScale = mesh.grid.scale;
    data.nodes = mesh.nodes;
    data.firstTriangle = mesh.firstTriangle;
    data.firstVertex = mesh.firstVertex;
    data.firstRepeating = mesh.triangles - scene_.meshes[instance.mesh].repeats;
    data.repeats = repeating - data.firstRepeating;
    repeating += scene_.meshes[instance.mesh].repeats;
    data.change.emission *= settings.view.radianceScale();
    setMirror(curvedMirrorOf(scene_, instance), settings.effects, data);
    instances_.push_back(data);
  }
}

void TraceFrame::addHierarchy(const SceneState& state) {
  const glm::dvec3& eye = state.camera.eye;
  const auto all = boxesOf(scene_, state, eye);
  std::vector<Bounds> boxes;
  std::vector<uint32_t> found;
  for (size_t i = 0; i < state.instances.size(); ++i) {
    const InstanceState& instance = state.instances[i];
    if (!scene_.meshes[instance.mesh].indices.empty()) {
      const bool reflected = sees(Onlooker::mirror, scene_.objects[instance.object].visible);
      boxes.push_back(all[i]);
      found.push_back(static_cast<uint32_t>(i) | (reflected ? 0 : gpu::itemUnreflected));
    }
  }
  uint32_t piece = 0;
  for (const MirrorState& mirror : state.mirrors) {
    for (size_t k = 0; k < mirror.pieceCount(); ++k) {
      Bounds& box = boxes.emplace_back();
      std::ranges::for_each(mirror.piece(k), [&](const glm::dvec3& p) { box.add(p - eye); });
      found.push_back(piece++ | gpu::itemMirror);
    }
  }
  appendTopNodes(Bvh(boxes, 1), found, topNodes_);
}

void TraceFrame::addMirrors(const SceneState& state, const Settings& settings) {
  mirrors_.clear();
  mirrorEdges_.clear();
  for (size_t i = 0; i < scene_.mirrorCount(); ++i) {
    const MirrorOptics optics = opticsOf(scene_.mirror(i), settings.effects);
    const MirrorState& placed = state.mirrors[i];
    const glm::dvec2 near = localNear(placed, state.camera.eye);
    gpu::TraceMirror data{.origin = glm::vec3(placed.at(near) - state.camera.eye),
                          .normal = glm::vec3(placed.normal),
                          .axisX = glm::vec3(placed.axisX),
                          .axisY = glm::vec3(placed.axisY),
                          .reflectance = glm::vec3(optics.reflectance),
                          .schlick = optics.fresnel == Fresnel::schlick,
                          .baseColor = glm::vec3(optics.baseColor),
                          .twoSided = optics.twoSided,
                          .backColor = glm::vec3(optics.backColor),
                          .alpha = static_cast<float>(optics.alpha),
                          .plane = static_cast<uint32_t>(placed.plane),
                          .layers = layersOf(placed)};
    data.map = optics.map < 0 ? gpu::noMap : static_cast<uint32_t>(optics.map);
    if (optics.map >= 0) {
      const MirrorBox box = boxOf(placed, placed.polygon);
      data.mapBox = glm::vec4(glm::dvec4(1.0 / box.size, (near - box.low) / box.size));
    }
    if (optics.ripple) {
      const RippleConstants ripple = rippleConstants(*optics.ripple, state.time, near);
      data.hasRipple = 1;
      data.waveNumber = ripple.waveNumber;
      data.rippleSlope = ripple.slope;
      data.firstPhase = ripple.phases.x;
      data.secondPhase = ripple.phases.y;
    }
    for (size_t k = 0; k < placed.pieceCount(); ++k) {
      const std::vector<glm::dvec3>& polygon = placed.piece(k);
      data.firstVertex = static_cast<uint32_t>(mirrorEdges_.size());
      data.vertexCount = static_cast<uint32_t>(polygon.size());
      mirrors_.push_back(data);
      glm::vec2 from(placed.local(polygon.back()) - near);
      for (const glm::dvec3& p : polygon) {
        const glm::vec2 to(placed.local(p) - near);
        mirrorEdges_.emplace_back(from, to);
        from = to;
      }
    }
  }
}

std::vector<std::byte> TraceFrame::lightPathBytes(const SceneState& state, const Settings& settings,
                                                  const TracedEffects& effects) const {
  const gpu::TraceCounts header{.lightPaths = static_cast<uint32_t>(effects.bouncedLights.size()),
                                .topNodes = static_cast<uint32_t>(topNodes_.size() / 8),
                                .roughSamples = static_cast<uint32_t>(settings.effects.roughSamples)};
  std::vector<gpu::LightPath> paths;
  for (const BouncedLight& bounced : effects.bouncedLights) {
    const PointLight& light = scene_.lights[bounced.light];
    const glm::dvec3 position = besideMirrors(state.lights[bounced.light].position, state.mirrors, state.camera.eye);
    const MirrorState& mirror = state.mirrors[bounced.mirror];
    const glm::dvec3 image = reflectPoint(position, {mirror.origin, mirror.normal});
    paths.push_back({.image = glm::vec3(image - state.camera.eye),
                     .radius = static_cast<float>(light.radius),
                     .irradiance = radiance(settings.view.radianceScale() * light.color * light.intensity),
                     .height = light.castsShadow && settings.effects.shadows
                                   ? static_cast<float>(heightOverMirrors(position, state.mirrors))
                                   : -1.0f,
                     .light = glm::vec3(position - state.camera.eye),
                     .mirror = static_cast<uint32_t>(mirror.firstPiece),
                     .side = glm::dot(mirror.normal, position - mirror.origin) > 0.0 ? 1.0f : -1.0f});
  }
  std::vector<std::byte> bytes(sizeof header + paths.size() * sizeof(gpu::LightPath));
  std::memcpy(bytes.data(), &header, sizeof header);
  if (!paths.empty()) {
    std::memcpy(bytes.data() + sizeof header, paths.data(), paths.size() * sizeof(gpu::LightPath));
  }
  return bytes;
}

}  // namespace speculum
