#include "systems/frame_data.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "geometry/bvh.hpp"
#include "plan/pass_mask.hpp"
#include "scene/material_mirrors.hpp"
#include "scene/scene_state.hpp"
#include "systems/gpu_conversion.hpp"

namespace speculum {

namespace {

constexpr std::array frameBufferNames = {
    "passes", "mirrors", "lights", "instances", "curved mirrors", "mirror vertices", "repeating triangles"};

uint32_t lookupFor(const glm::dvec2& ratio) {
  return ratio == glm::dvec2(1.0) ? gpu::lookupFetch : ratio.x < 1.0 ? gpu::lookupBilinear : gpu::lookupBox;
}

// Returns the view that the cached or rendered image was drawn with; null without an image.
const View* imageView(const MirrorDraw& draw, const FramePlan& plan) {
  return draw.pass >= 0 ? &plan.passes[draw.pass].view : draw.cached ? &plan.cached[draw.cached->image].view : nullptr;
}

// Returns a polygon of the picture's device coordinates at one depth. `drawn` is the view's overscan().
ClipPolygon clipPolygonAt(double depth, std::span<const glm::dvec2> polygon, const glm::dvec2& drawn) {
  ClipPolygon clip;
  for (const glm::dvec2& p : polygon) {
    clip.emplace_back(p / drawn, depth, 1.0);
  }
  return clip;
}

bool hasFewTriangles(const FrameInfo& info) {
  constexpr size_t fewIndices = 3 * 8192;
  size_t indices = 0;
  return std::ranges::all_of(info.state.instances, [&](const InstanceState& instance) {
    indices += info.scene.meshes[instance.mesh].indices.size();
    return indices <= fewIndices;
  });
}

std::vector<glm::vec4> clearancesOf(const Scene& scene, const SceneState& state) {
  std::vector<glm::vec4> clearances(scene.lights.size(), glm::vec4(0.0f, 0.0f, 0.0f, -1.0f));
  for (size_t i = 0; i < clearances.size(); ++i) {
    const glm::dvec3& light = state.lights[i].position;
    if (scene.lights[i].castsShadow) {
      const glm::dvec3 end = besideMirrors(light, state.mirrors, state.camera.eye);
      clearances[i] = glm::vec4(end - light, heightOverMirrors(end, state.mirrors));
    }
  }
  return clearances;
}

// A surface asks each group, then the lights of groups that it faces. With about as many groups as lights in each this
// takes the least questions. Shaders ask no groups if there are at most fixedLights lights.
size_t lightsPerGroup(size_t lights) {
  const auto root = static_cast<size_t>(std::ceil(std::sqrt(static_cast<double>(lights))));
  return std::max({size_t{1}, root, (lights + gpu::mostLightGroups - 1) / gpu::mostLightGroups});
}

constexpr gpu::LightGroup everywhere{.center = {}, .padding = 0, .halfExtent = glm::vec3(1e30f), .padding2 = 0};

// Returns a box that holds the lights, with room for the rounding of its own sums.
gpu::LightGroup boxAround(std::span<const gpu::LightData> lights) {
  Bounds box;
  for (const gpu::LightData& light : lights) {
    box.add(light.position);
  }
  const glm::vec3 center(box.center());
  const glm::dvec3 halfExtent = glm::max(box.high - glm::dvec3(center), glm::dvec3(center) - box.low);
  return {.center = center, .padding = 0, .halfExtent = 1.000002 * halfExtent, .padding2 = 0};
}

// Returns the indices of the lights, those with a shadow map first, so that passes share pipelines. Those of a group
// lie close together, so that fewer surfaces face some of them.
std::vector<int> lightOrder(const SceneState& state, std::span<const uint32_t> shadowMaps) {
  std::vector<int> order(state.lights.size());
  std::iota(order.begin(), order.end(), 0);
  const auto unmapped =
      std::stable_partition(order.begin(), order.end(), [&](int i) { return shadowMaps[i] != gpu::noShadowMap; });
  if (order.size() > gpu::fixedLights) {
    std::vector<glm::dvec3> positions(order.size());
    std::ranges::transform(state.lights, positions.begin(), &LightState::position);
    const size_t perGroup = lightsPerGroup(order.size());
    sortIntoRuns({order.begin(), unmapped}, positions, perGroup);
    // The nearest lights without a map fill the last group of those with one.
    const auto mapped = static_cast<size_t>(unmapped - order.begin());
    const size_t aligned = std::min((mapped + perGroup - 1) / perGroup * perGroup, order.size());
    const auto others = order.begin() + static_cast<std::ptrdiff_t>(aligned);
    if (mapped > 0) {
      const glm::dvec3& last = positions[order[mapped - 1]];
      std::nth_element(unmapped, others, order.end(), [&](int a, int b) {
        return glm::distance(positions[a], last) < glm::distance(positions[b], last);
      });
    }
    sortIntoRuns({others, order.end()}, positions, perGroup);
  }
  return order;
}

bool sameColors(const Object& a, const Object& b) {
  return a.color == b.color && a.specular == b.specular && a.shininess == b.shininess && a.emission == b.emission;
}

// Says whether the backs of triangles need not be drawn. Wireframes show backs, and so does a near plane that cuts
// fronts, which happens without depth clamping.
bool cullsBacks(const Device& device, const Settings& settings, const View& view, const InstanceState& instance,
                const Mesh& mesh) {
  return device.caps().depthClamp && settings.debug.cullClusters && !settings.view.wireframe && mesh.solid &&
         !isTransparent(mesh, settings.effects) && seesOnlyFronts(view, instance, mesh.halfExtent);
}

}  // namespace

bool hasRepeatingTriangles(const Scene& scene) {
  return std::ranges::any_of(scene.meshes, [](const Mesh& mesh) { return mesh.repeats > 0; });
}

uint32_t fixedLightCount(const Scene& scene) {
  return scene.lights.size() <= gpu::fixedLights ? static_cast<uint32_t>(scene.lights.size()) : gpu::manyLights;
}

VkDescriptorType FrameData::typeOf(uint32_t kind) {
  return kind == passBlocks || kind == mirrors ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC
                                               : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

// Gives no stage more than the four storage buffers that every device supports. Deferred shading computes.
VkShaderStageFlags FrameData::stagesOf(uint32_t kind) {
  constexpr VkShaderStageFlags vertex = VK_SHADER_STAGE_VERTEX_BIT;
  constexpr VkShaderStageFlags fragment = VK_SHADER_STAGE_FRAGMENT_BIT;
  constexpr VkShaderStageFlags compute = VK_SHADER_STAGE_COMPUTE_BIT;
  switch (kind) {
    case passBlocks:
    case lights:
      return vertex | fragment | compute;
    case mirrors:
      return vertex | fragment;
    case mirrorVertices:
      return vertex;
    case curvedMirrors:
      return fragment;
    case kindCount:
      return compute;
    default:
      return fragment | compute;
  }
}

FrameData::FrameData(Device& device, bool roundsSumsDown)
    : device_(device),
      // A step is 2^-10 of the power of two below a number, which on the mean over logarithms is 1/1.44 of the number,
      // and rounding down takes half a step.
      lostInSums_(roundsSumsDown ? std::exp2(-10.0f) * std::numbers::ln2_v<float> : 0.0f),
      buffers_(device, frameBufferNames, "fewer copies of objects, fewer lights, or a lower reflection.max_passes") {
  std::array<DescriptorBinding, kindCount + 1> bindings{};  // the last for the materials
  for (uint32_t i = 0; i < bindings.size(); ++i) {
    bindings[i] = {.binding = i, .type = typeOf(i), .stages = stagesOf(i)};
  }
  layout_ = descriptorSetLayout(device, bindings, "frame");
}

void FrameData::requireFits(const FramePlan& plan) const {
  size_t instanceCount = 0;
  for (const Pass& pass : plan.passes) {
    instanceCount += pass.drawn() ? pass.instances.size() : 0;
  }
  buffers_.checkSize(instances, instanceCount * sizeof(gpu::InstanceData));
}

void FrameData::build(const FrameInfo& info) {
  const FramePlan& plan = info.plan;
  Frame& frame = info.frame;
  passBlocks_.clear();
  mirrors_.clear();
  lights_.clear();
  instances_.clear();
  curvedMirrors_.clear();
  mirrorVertices_.clear();
  passes_.resize(plan.passes.size());
  for (DrawList& list : passes_) {  // keeps the memory of its lists
    list.batches.clear();
    list.glyphs.clear();
    list.mirrors.clear();
    list = {.batches = std::move(list.batches), .glyphs = std::move(list.glyphs), .mirrors = std::move(list.mirrors)};
  }
  addRepeating(info);
  handsOn_ = !branches() && hasFewTriangles(info);
  clearances_ = clearancesOf(info.scene, info.state);
  shadowMaps_.assign(info.scene.lights.size(), gpu::noShadowMap);
  const std::span<const Cube> maps = cubesOf(plan.cubes, PassKind::shadow);
  for (size_t map = 0; map < maps.size(); ++map) {
    shadowMaps_[maps[map].light] = static_cast<uint32_t>(map);
  }
  lightOrder_ = lightOrder(info.state, shadowMaps_);
  const std::vector<double> reaches = lookupReaches(plan, info.settings, device_.limits().standardSampleLocations);
  const std::vector<std::vector<PixelRect>> converged = convergedParts(plan);
  for (size_t i = 0; i < plan.passes.size(); ++i) {
    if (plan.passes[i].drawn()) {
      addPass(info, plan.passes[i], passes_[i]);
      addOutside(info, plan.passes[i], passes_[i]);
      addMask(info, plan.passes[i], reaches[i], converged.empty() ? std::span<const PixelRect>() : converged[i],
              passes_[i]);
    }
  }

  // Both buffers are bound in every draw, so they need an element even in a frame without mirrors or draws.
  mirrors_.resize(std::max<size_t>(mirrors_.size(), 1));
  passBlocks_.resize(std::max<size_t>(passBlocks_.size(), 1));
  buffers_.write(frame, passBlocks, passBlocks_);
  buffers_.write(frame, mirrors, mirrors_);
  buffers_.write(frame, lights, lights_);
  buffers_.write(frame, instances, instances_);
  buffers_.write(frame, curvedMirrors, curvedMirrors_);
  buffers_.write(frame, mirrorVertices, mirrorVertices_);
  buffers_.write(frame, repeating, repeating_);
  instanceBuffer_ = buffers_.buffer(frame, instances).get();
  set_ = frame.descriptors->allocate(layout_);
  DescriptorWriter writer;
  for (uint32_t kind = 0; kind < kindCount; ++kind) {
    VkDescriptorBufferInfo buffer = buffers_.buffer(frame, kind).descriptor();
    buffer.range = kind == passBlocks ? sizeof(DrawBlock) : kind == mirrors ? sizeof(gpu::MirrorBlock) : buffer.range;
    writer.buffer(kind, typeOf(kind), buffer);
  }
  writer.buffer(kindCount, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, info.resources.materials().descriptor());
  writer.update(device_, set_);
}

void FrameData::bind(const Pipeline& pipeline, VkCommandBuffer commands, const DrawList& pass,
                     const std::array<VkDescriptorSet, 3>& others, uint32_t mirror) const {
  const std::array offsets{pass.pass * static_cast<uint32_t>(sizeof(DrawBlock)),
                           mirror * static_cast<uint32_t>(sizeof(gpu::MirrorBlock))};
  const std::array sets{set_, others[0], others[1], others[2]};
  const auto end = std::ranges::find(sets, VkDescriptorSet{VK_NULL_HANDLE});
  pipeline.bind(commands);
  pipeline.bindSets(commands, 0, {sets.begin(), end}, offsets);
}

void FrameData::addPass(const FrameInfo& info, const Pass& pass, DrawList& data) {
  const Settings& settings = info.settings;
  const FramePlan& plan = info.plan;
  const glm::dmat4 projection = viewProjection(pass.projection, pass.view, settings.reflection.clip);
  data.pass = static_cast<uint32_t>(passBlocks_.size());
  data.mirrorView = !pass.view.path.empty();
  data.lineWidth = static_cast<float>(plan.lineWidth(pass.view, settings.view));
  gpu::ViewData& view = passBlocks_.emplace_back().view;
  view = viewData(pass.view, pass.projection, pass.corner, info.environment);
  view.inMap = pass.id.kind == PassKind::environment;
  const glm::dmat4 clipFromRelative = projection * glm::dmat4(pass.view.worldToView);
  view.clipFromRelative = glm::mat4(clipFromRelative);
  if (settings.reflection.clip == ClipMethod::none) {
    view.clipPlane = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
  }
  view.checksFinite = settings.debug.checkFinite;
  view.picture = static_cast<uint32_t>(plan.picture);
  view.traceOffset = glm::vec3(pass.view.eye - plan.main().view.eye);
  view.throughput = glm::vec3(pass.channels);
  view.minThroughput = static_cast<float>(settings.reflection.minThroughput);
  view.depth = static_cast<uint32_t>(pass.view.path.size());
  view.zenith.w = lostInSums_;
  view.horizon.w = static_cast<float>(settings.view.exposure / settings.view.radianceScale());
  view.rayY.w = halfTurn(view.depth, plan.picture);
  view.rayOrigin.w = plan.picture > 0 ? 1.0f : 0.0f;
  view.maxDepth = static_cast<uint32_t>(settings.reflection.maxDepth);
  addLights(info, pass, passBlocks_.back(), data);
  addInstances(info, pass, clipFromRelative, data);
  addMirrors(info, pass, projection, data);
}

void FrameData::addLights(const FrameInfo& info, const Pass& pass, DrawBlock& block, DrawList& data) {
  const Scene& scene = info.scene;
  const double scale = info.settings.view.radianceScale();
  block.view.firstLight = static_cast<uint32_t>(lights_.size());
  block.view.lightCount = static_cast<uint32_t>(scene.lights.size());
  for (const int i : lightOrder_) {
    const PointLight& light = scene.lights[i];
    if (std::binary_search(pass.lights.begin(), pass.lights.end(), i)) {
      const auto index = static_cast<uint32_t>(lights_.size()) - block.view.firstLight;
      if (data.glyphs.empty() || data.glyphs.back().first + data.glyphs.back().count < index) {
        data.glyphs.push_back({index, 0});
      }
      ++data.glyphs.back().count;
    }
    lights_.push_back({.position = glm::vec3(info.state.lights[i].position - pass.view.eye),
                       .radius = static_cast<float>(light.radius),
                       .irradiance = radiance(scale * light.color * light.intensity),
                       .height = clearances_[i].w,
                       .glow = radiance(scale * light.color * light.glow),
                       .hasGlyph = hasGlyph(light, info.settings.effects) && sees(Onlooker::mirror, light.visible),
                       .clearance = glm::vec3(clearances_[i]),
                       .shadowMap = shadowMaps_[i]});
  }
  const std::span<const gpu::LightData> ordered = std::span(lights_).last(lightOrder_.size());
  std::ranges::copy(ordered.first(std::min<size_t>(ordered.size(), gpu::fixedLights)), block.lights);
  const size_t perGroup = lightsPerGroup(ordered.size());
  block.view.lightsPerGroup = static_cast<uint32_t>(perGroup);
  for (size_t first = 0; first < ordered.size(); first += perGroup) {
    const auto group = ordered.subspan(first, std::min(perGroup, ordered.size() - first));
    block.lightGroups[first / perGroup] = info.settings.debug.skipLights ? boxAround(group) : everywhere;
  }
}

void FrameData::addInstances(const FrameInfo& info, const Pass& pass, const glm::dmat4& clipFromRelative,
                             DrawList& data) {
  const Scene& scene = info.scene;
  const SceneState& state = info.state;
  const EffectSettings& effects = info.settings.effects;
  const auto isCurved = [&](int i) { return effects.curved && curvedMirrorOf(scene, state.instances[i]).has_value(); };
  std::vector<int> order = frontToBack(pass.view, pass.instances, state);
  // Instances of a mesh that look alike share a draw, those that are curved mirrors another one. Each instance that is
  // seen in part has a draw of its own.
  for (auto first = order.begin(); first != order.end();) {
    const int mesh = state.instances[*first].mesh;
    const auto last = std::find_if(first, order.end(), [&](int i) { return state.instances[i].mesh != mesh; });
    if (std::any_of(first, last, isCurved)) {
      std::stable_partition(first, last, [&](int i) { return !isCurved(i); });
    }
    first = last;
  }
  for (const int i : order) {
    const InstanceState& instance = state.instances[i];
    const Object& object = scene.objects[instance.object];
    const bool curved = isCurved(i);
    const bool environment = curved && effects.curvedLookup == CurvedLookup::environment;
    const PartialInstance* part = partOf(pass.partial, i);
    const float handedness = handednessOf(instance);
    const Mesh& mesh = scene.meshes[instance.mesh];
    const bool culls = cullsBacks(device_, info.settings, pass.view, instance, mesh);
    const Batch* last = data.batches.empty() ? nullptr : &data.batches.back();
    if (!last || last->mesh != instance.mesh || last->curved != curved || last->handedness != handedness ||
        last->cullsBacks != culls || !sameColors(scene.objects[last->object], object) || environment || part ||
        !last->ranges.empty()) {
      data.batches.push_back({.mesh = instance.mesh,
                              .object = instance.object,
                              .handedness = handedness,
                              .firstInstance = static_cast<uint32_t>(instances_.size()),
                              .cullsBacks = culls,
                              .curved = curved});
      data.batches.back().ranges = part ? part->ranges : RecycledVector<IndexRange>();
    }
    ++data.batches.back().count;
    instances_.push_back(instanceData(instance, pass.view, clipFromRelative));
    instances_.back().traceInstance = static_cast<uint32_t>(i);
    instances_.back().repeats = repeats_.empty() ? 0 : repeats_[i];
    if (environment) {
      addEnvironment(info, pass, i, data.batches.back());
    }
  }
}

// Adds the environment map that a curved mirror looks up. In faces of such maps curved mirrors show the background.
void FrameData::addEnvironment(const FrameInfo& info, const Pass& pass, int instance, Batch& batch) {
  const RecycledVector<Cube>& cubes = info.plan.cubes;
  const auto map = std::ranges::find(cubes, instance, &Cube::instance);
  const bool exists = map != cubes.end() && !pass.isFace();
  const MirrorOptics optics =
      opticsOf(*curvedMirrorOf(info.scene, info.state.instances[instance]), info.settings.effects);
  gpu::CurvedMirrorData data{.hasMap = exists,
                             .reflectance = glm::vec3(optics.reflectance),
                             .schlick = optics.fresnel == Fresnel::schlick,
                             .baseColor = glm::vec3(optics.baseColor)};
  if (exists) {
    data.center = glm::vec3(map->center - pass.view.eye);
    data.low = glm::vec3(map->low - map->center);
    data.high = glm::vec3(map->high - map->center);
    data.hasBox = info.settings.effects.environmentBox;
    data.faceSize = map->size;
  }
  batch.environment = true;
  batch.colored = optics.baseColor != glm::dvec3(0.0);
  batch.map = exists ? static_cast<int>(map - cubes.begin()) : -1;
  instances_.back().curvedMirror = static_cast<uint32_t>(curvedMirrors_.size());
  curvedMirrors_.push_back(data);
}

void FrameData::addMirrors(const FrameInfo& info, const Pass& pass, const glm::dmat4& projection, DrawList& data) {
  const EffectSettings& effects = info.settings.effects;
  const std::vector<std::vector<ClipPolygon>> polygons = mirrorPolygons(pass, projection);
  size_t cuts = 0;
  for (size_t i = 0; i < pass.mirrors.size(); ++i) {
    const MirrorDraw& draw = pass.mirrors[i];
    const std::vector<ClipPolygon> parts = partsToDraw(pass, info.state, polygons, i, cuts);
    if (parts.empty()) {
      continue;
    }
    const Mirror& mirror = info.scene.mirror(draw.mirror);
    const MirrorOptics optics = opticsOf(mirror, effects);
    const View* image = imageView(draw, info.plan);
    const bool ripples = draw.ripples && image;
    MirrorRange range{.mirror = static_cast<uint32_t>(mirrors_.size()),
                      .firstVertex = static_cast<uint32_t>(mirrorVertices_.size()),
                      .pass = draw.pass,
                      .cached = draw.cached ? draw.cached->image : -1,
                      .reprojected = draw.cached && draw.cached->moved,
                      .blurs = draw.blurs,
                      .ripples = ripples,
                      .byRays = draw.byRays,
                      .rippled = ripples || (draw.byRays && optics.ripple),
                      .rough = draw.blurs || (draw.byRays && optics.alpha > 0.0),
                      .fresnel = !draw.back && optics.fresnel == Fresnel::schlick,
                      .map = draw.back ? -1 : optics.map,
                      .base = optics.baseColor != glm::dvec3(0.0)};
    range.shows = draw.back ? gpu::showsBack : image ? gpu::showsImage : gpu::showsBackground;
    range.colored = draw.back ? optics.backColor != glm::dvec3(0.0) : range.base;
    range.lookup = image ? lookupFor(image->pictureSize / pass.view.pictureSize) : gpu::lookupFetch;
    mirrors_.push_back({.mirror = mirrorData(draw, optics, info.state, effects, pass.view, image)});
    mirrors_.back().mirror.index = range.mirror;
    mirrors_.back().mirror.showsRipples = ripples;
    for (const ClipPolygon& part : parts) {
      addFan(mirrorVertices_, part);
    }
    for (const ClipPolygon& polygon : polygons[i]) {
      addFringe(mirrorVertices_, polygon, pass.view.pictureSize * overscan(pass.view));
    }
    range.vertexCount = static_cast<uint32_t>(mirrorVertices_.size()) - range.firstVertex;
    data.mirrors.push_back(range);
  }
}

void FrameData::addRepeating(const FrameInfo& info) {
  repeating_.clear();
  repeats_.clear();
  if (!device_.caps().primitiveId || !hasRepeatingTriangles(info.scene)) {
    return;
  }
  for (const InstanceState& instance : info.state.instances) {
    const Mesh& mesh = info.scene.meshes[instance.mesh];
    const auto end = static_cast<uint32_t>(mesh.indices.size() / 3);
    repeats_.push_back(static_cast<uint32_t>(repeating_.size()) - (end - mesh.repeats));
    for (uint32_t triangle = end - mesh.repeats; triangle < end; ++triangle) {
      repeating_.push_back(repeatingTriangle(mesh, triangle, instance, info.plan.main().view.eye));
    }
  }
}

void FrameData::addOutside(const FrameInfo& info, const Pass& pass, DrawList& data) {
  if (pass.view.path.empty() || (!mixesTexels(pass) && pass.quality.samples == pass.shownIn.samples)) {
    return;
  }
  // Before everything, or before the background alone. At one resolution a lookup reads less than a texel outside the
  // mirror, and what is drawn there usually continues the image better than the texels inside do.
  const bool resized = pass.quality.scale != pass.shownIn.scale;
  const double depth = resized ? 1.0 - 0x1p-24 : 1e-30;
  data.outsideFirstVertex = static_cast<uint32_t>(mirrorVertices_.size());
  for (const std::vector<glm::dvec2>& part : outsideParts(pass.view, info.plan.projection)) {
    addFan(mirrorVertices_, clipPolygonAt(depth, part, overscan(pass.view)));
  }
  data.outsideVertexCount = static_cast<uint32_t>(mirrorVertices_.size()) - data.outsideFirstVertex;
}

void FrameData::addMask(const FrameInfo& info, const Pass& pass, double reach, std::span<const PixelRect> converged,
                        DrawList& data) {
  if (!info.settings.debug.maskPasses) {
    return;
  }
  double left = pass.view.rect.area();
  std::ranges::for_each(converged, [&](const PixelRect& part) { left -= part.area(); });
  if (left == 0.0) {
    data.batches.clear();
    data.mirrors.clear();
    data.glyphs.clear();
    data.outsideVertexCount = 0;
    return;
  }
  const glm::dvec2 drawn = overscan(pass.view);
  data.maskFirstVertex = static_cast<uint32_t>(mirrorVertices_.size());
  if (!pass.view.path.empty()) {
    constexpr double infinitelyFar = 0.0;
    const std::vector<glm::dvec2> mask = passMask(pass.view, info.plan.projection, reach);
    addFan(mirrorVertices_, clipPolygonAt(infinitelyFar, mask, drawn));
    data.maskOpens = !mask.empty();
  }
  for (const PixelRect& part : converged) {
    const glm::dvec2 step = 2.0 / (pass.view.pictureSize * drawn);
    const glm::dvec2 low = glm::dvec2(part.x, part.y) * step - 1.0 / drawn;
    const glm::dvec2 high = low + glm::dvec2(part.width, part.height) * step;
    const ClipPolygon nearest{{low, 1.0, 1.0}, {high.x, low.y, 1.0, 1.0}, {high, 1.0, 1.0}, {low.x, high.y, 1.0, 1.0}};
    addFan(mirrorVertices_, nearest);
  }
  data.maskVertexCount = static_cast<uint32_t>(mirrorVertices_.size()) - data.maskFirstVertex;
}

}  // namespace speculum
