#include "systems/gpu_conversion.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numbers>

#include "geometry/affine.hpp"
#include "geometry/projection.hpp"
#include "scene/value_range.hpp"

namespace speculum {

namespace {

// The view's clip plane as (n, h) for points relative to the eye; without one, every point passes.
glm::dvec4 relativeClipPlane(const View& view) {
  if (!view.clip) {
    return {0.0, 0.0, 0.0, 1.0};
  }
  return {view.clip->normal, view.clip->distance(view.eye)};
}

// In pixels: the error of vertices snapped to 1/256 of a pixel. A wider fringe shows at recursion depth 32.
constexpr double fringeWidth = 1.0 / 256.0;
// Depth behind everything but the background.
constexpr double fringeDepth = 1e-25;

// Moves a mirror's polygon behind the mirrors that cover it in its plane: for each layer by a thousandth of the
// distance, and by more than rounding moves any depth in the plane.
ClipPolygon movedBack(ClipPolygon clip, int layer, double largestDepth) {
  for (glm::dvec4& v : clip) {
    const double step = std::max(0x1p-10 * v.z, 0x1p-16 * largestDepth * v.w);
    v.z = std::max(fringeDepth * v.w, v.z - layer * step);
  }
  return clip;
}

}  // namespace

glm::vec4 row(const glm::dmat3& m, int r, double w) {
  return glm::vec4(glm::dvec4(m[0][r], m[1][r], m[2][r], w));
}

glm::vec3 radiance(const glm::dvec3& product) {
  return glm::vec3(glm::min(product, radianceRange.high));
}

glm::vec4 texelOf(const Texture& texture, size_t index) {
  return {texture.texels[index], texture.opacity.empty() ? 1.0f : texture.opacity[index]};
}

// Appends the means of four texels each, of rows of this width, or of two where there is one row or column.
void appendHalved(std::span<const glm::vec4> from, size_t width, size_t height, std::vector<glm::vec4>& level) {
  const size_t right = width > 1 ? 1 : 0;
  const size_t below = height > 1 ? width : 0;
  const size_t halfWidth = std::max<size_t>(width / 2, 1);
  for (size_t i = 0; i < halfWidth * std::max<size_t>(height / 2, 1); ++i) {
    const glm::vec4* first = &from[2 * (i / halfWidth) * width + 2 * (i % halfWidth)];
    level.push_back(0.25f * (first[0] + first[right] + first[below] + first[right + below]));
  }
}

void forLevels(const Texture& texture, const std::function<void(std::span<const glm::vec4>)>& take) {
  auto width = static_cast<size_t>(texture.width);
  auto height = static_cast<size_t>(texture.height);
  std::vector<glm::vec4> level;
  std::vector<glm::vec4> rows;  // two of the first level, which as a whole would take more memory than all others
  for (size_t y = 0; y < height; y += 2) {
    const size_t count = std::min<size_t>(2, height - y);
    rows.clear();
    for (size_t i = y * width; i < (y + count) * width; ++i) {
      rows.push_back(texelOf(texture, i));
    }
    take(rows);
    if (count == 2 || height == 1) {
      appendHalved(rows, width, count, level);
    }
  }
  while (width * height > 1) {
    take(level);
    width = std::max<size_t>(width / 2, 1);
    height = std::max<size_t>(height / 2, 1);
    rows.clear();
    appendHalved(level, width, height, rows);
    std::swap(level, rows);
  }
}

void appendLevels(const Texture& texture, std::vector<uint64_t>& texels, uint64_t skipped) {
  forLevels(texture, [&](std::span<const glm::vec4> level) {
    const size_t first = std::min<size_t>(skipped, level.size());
    skipped -= first;
    for (const glm::vec4& texel : level.subspan(first)) {
      texels.push_back(glm::packHalf4x16(texel));
    }
  });
}

float halfTurn(size_t depth, int picture) {
  // 4 depth + 6 is even and no multiple of 4, hence no square: the root is irrational, and its multiples spread evenly.
  return static_cast<float>(glm::fract(picture * std::sqrt(4.0 * static_cast<double>(depth) + 6.0) / 2.0));
}

float storedRadiance(double value, int picture, float turn) {
  const double step = std::exp2(std::max(std::ilogb(std::max(value, 1e-30)), -14) - 10);
  return static_cast<float>(std::min(step * std::nearbyint(value / step + (picture > 0 ? turn - 0.5 : 0.0)), 65504.0));
}

Environment scaled(Environment environment, double scale) {
  Sky sky = environment.sky.value_or(Sky{});
  for (glm::dvec3* color : {&environment.background, &environment.ambient, &sky.zenith, &sky.horizon, &sky.ground}) {
    *color = radiance(scale * *color);
  }
  environment.sky = environment.sky ? std::optional(sky) : std::nullopt;
  return environment;
}

uint32_t textureLookup(TextureFilter filter) {
  constexpr std::array lookups{gpu::textureBilinear, gpu::textureTrilinear, gpu::textureNearest,
                               gpu::textureAnisotropic};
  return lookups[static_cast<size_t>(filter)];
}

gpu::MaterialChange materialChange(const Object& object) {
  return {.diffuse = glm::vec3(object.color.value_or(glm::dvec3(0.0))),
          .replacesDiffuse = object.color.has_value(),
          .specular = glm::vec3(object.specular.value_or(glm::dvec3(0.0))),
          .replacesSpecular = object.specular.has_value(),
          .emission = glm::vec3(object.emission.value_or(glm::dvec3(0.0))),
          .replacesEmission = object.emission.has_value()};
}

gpu::DrawConstants drawConstants(const Material& material, const Object& object, float handedness) {
  return {.diffuse = glm::vec3(object.color.value_or(material.diffuse)),
          .shininess = static_cast<float>(object.shininess.value_or(material.shininess)),
          .specular = glm::vec3(object.specular.value_or(material.specular)),
          .handedness = handedness,
          .emission = glm::vec3(object.emission.value_or(material.emission))};
}

glm::dmat3 unitNormalMatrix(const glm::dmat3& linear) {
  const glm::dmat3 normals = normalMatrix(linear);
  const double size = std::max({glm::length(normals[0]), glm::length(normals[1]), glm::length(normals[2])});
  return size > 0.0 ? normals * (1.0 / size) : normals;
}

RippleConstants rippleConstants(const Ripple& ripple, double time, const glm::dvec2& point) {
  const double k = 2.0 * std::numbers::pi / ripple.wavelength;
  constexpr double steepest = 1e15;  // its square is a float, and steeper slopes look the same
  // Phases are reduced in double: floats of whole phases would have lost their fraction after hours, or far away.
  const double shift = productModulo(ripple.speed, time, ripple.wavelength);
  const glm::dvec2 shifts(point.x + shift, 0.6 * point.x + 0.8 * point.y - shift);
  return {static_cast<float>(k), static_cast<float>(std::min(ripple.amplitude * k, steepest)),
          glm::vec2(k * glm::dvec2(std::fmod(shifts.x, ripple.wavelength), std::fmod(shifts.y, ripple.wavelength)))};
}

double reachOf(const InstanceState& instance, const glm::dvec3& eye) {
  // With a larger reach, a lamp at a usual height would count as in the surface's plane (leastHeight in shading.glsl).
  constexpr double largest = 1e6;
  return std::min(glm::length(instance.center - eye) + instance.radius, largest);
}

float handednessOf(const InstanceState& instance) {
  return glm::determinant(instance.worldFromMesh.linear) < 0.0 ? -1.0f : 1.0f;
}

gpu::InstanceData instanceData(const InstanceState& instance, const View& view, const glm::dmat4& clipFromRelative) {
  const glm::dmat3& linear = instance.worldFromMesh.linear;
  const glm::dvec3 offset = instance.worldFromMesh.translation - view.eye;
  glm::dmat4 relativeFromMesh(linear);
  relativeFromMesh[3] = glm::dvec4(offset, 1.0);
  const double reach = reachOf(instance, view.eye);
  const glm::dmat3 normals = unitNormalMatrix(linear);
  const glm::dvec4 plane = relativeClipPlane(view);
  const glm::dvec3 normal(plane);

  gpu::InstanceData data{};
  data.clipFromMesh = glm::mat4(clipFromRelative * relativeFromMesh);
  for (int r = 0; r < 3; ++r) {
    data.relativeFromMesh[r] = row(linear, r, offset[r]);
    data.normalFromMesh[r] = row(normals, r, reach);
  }
  data.clipPlane = glm::vec4(glm::dvec4(glm::transpose(linear) * normal, glm::dot(normal, offset) + plane.w));
  return data;
}

gpu::RepeatingTriangle repeatingTriangle(const Mesh& mesh, uint32_t triangle, const InstanceState& instance,
                                         const glm::dvec3& eye) {
  const uint32_t* index = &mesh.indices[size_t{triangle} * 3];
  const glm::dvec2& uv = mesh.vertices[index[0]].uv;
  const auto relative = [&](int corner) {
    return instance.worldFromMesh.linear * mesh.vertices[index[corner]].position +
           (instance.worldFromMesh.translation - eye);
  };
  const glm::dvec3 a = relative(0);
  const glm::dvec3 ab = relative(1) - a;
  const glm::dvec3 ac = relative(2) - a;
  const glm::dvec3 normal = glm::cross(ab, ac);
  const double area2 = glm::dot(normal, normal);
  // A texture looks the same after any whole number of repeats.
  const auto coordinate = [&](int k) {
    const double alongAb = mesh.vertices[index[1]].uv[k] - uv[k];
    const double alongAc = mesh.vertices[index[2]].uv[k] - uv[k];
    const glm::dvec3 slope = (alongAb * glm::cross(ac, normal) + alongAc * glm::cross(normal, ab)) / area2;
    return glm::vec4(glm::dvec4(slope, glm::fract(uv[k] - glm::dot(slope, a))));
  };
  const glm::dvec3 unit = normal / std::sqrt(area2);
  return {coordinate(0), coordinate(1), glm::vec4(glm::dvec4(unit, -glm::dot(unit, a)))};
}

glm::dmat4 viewProjection(const Projection& common, const View& view, ClipMethod clip) {
  glm::dmat4 projection = common.matrix();
  if (clip == ClipMethod::oblique && view.clip) {
    const glm::dvec4 relative = relativeClipPlane(view);
    const glm::dvec4 plane(view.worldToView * glm::dvec3(relative), relative.w);
    if (const std::optional<glm::dmat4> oblique = obliqueProjection(common, plane)) {
      projection = *oblique;
    }
  }
  const glm::dvec2 drawn = overscan(view);
  for (int column = 0; column < 4; ++column) {
    projection[column].x /= drawn.x;
    projection[column].y /= drawn.y;
  }
  return projection;
}

// Ray directions are affine in the pixel's position; see Projection for the clip space that is inverted here.
gpu::ViewData viewData(const View& view, const Projection& projection, const glm::ivec2& target,
                       const Environment& environment) {
  gpu::ViewData data{};
  data.clipPlane = glm::vec4(relativeClipPlane(view));
  const glm::dmat3 viewToWorld = glm::transpose(view.worldToView);
  const double sx = projection.aspect / projection.focal;
  const double sy = 1.0 / projection.focal;
  const glm::dvec2 step = 2.0 / view.pictureSize;
  const glm::dvec2 origin = glm::dvec2(view.rect.x, view.rect.y) - glm::dvec2(target);
  // Device coordinates of the target's pixel (0, 0), without the projection's offset.
  const glm::dvec2 corner = origin * step - 1.0 - projection.offset;
  data.rayX = glm::vec3(viewToWorld * glm::dvec3(step.x * sx, 0.0, 0.0));
  data.rayY = glm::vec4(glm::vec3(viewToWorld * glm::dvec3(0.0, -step.y * sy, 0.0)), 0.0f);
  data.rayOrigin = glm::vec4(glm::vec3(viewToWorld * glm::dvec3(corner.x * sx, -corner.y * sy, -1.0)), 0.0f);
  data.ambient = glm::vec3(environment.ambient);
  data.background = glm::vec3(environment.background);
  data.hasSky = environment.sky.has_value();
  const Sky sky = environment.sky.value_or(Sky{});
  data.zenith = glm::vec4(glm::vec3(sky.zenith), 0.0f);
  data.horizon = glm::vec4(glm::vec3(sky.horizon), 0.0f);
  data.ground = glm::vec3(sky.ground);
  return data;
}

gpu::MirrorData mirrorData(const MirrorDraw& draw, const MirrorOptics& optics, const SceneState& state,
                           const EffectSettings& effects, const View& view, const View* image) {
  gpu::MirrorData data{.normal = glm::vec3(draw.plane.normal),
                       .eyeDistance = static_cast<float>(draw.plane.distance(view.eye)),
                       .reflectance = glm::vec3(optics.reflectance),
                       .schlick = optics.fresnel == Fresnel::schlick,
                       .baseColor = glm::vec3(draw.back ? optics.backColor : optics.baseColor),
                       .traceMirror = static_cast<uint32_t>(state.mirrors[draw.mirror].firstPiece)};
  if (image) {
    const glm::dvec2 ratio = image->pictureSize / view.pictureSize;
    const PixelRect& rect = image->rect;
    data.lookupScale = glm::vec2(ratio);
    data.lookupOffset = glm::vec2(glm::dvec2(view.rect.x, view.rect.y) * ratio - glm::dvec2(rect.x, rect.y));
    data.imageSize = {rect.width, rect.height};
  }
  if (draw.cached && draw.cached->moved) {
    for (int r = 0; r < 3; ++r) {
      data.texelFromPixel[r] =
          row(draw.cached->texelFromPixel, r, draw.cached->texelFromDisparity[r] / gpu::disparityLength);
    }
  }
  if (optics.map >= 0) {
    const MirrorState& placed = state.mirrors[draw.mirror];
    const MirrorBox box = boxOf(placed, placed.polygon);
    const auto coordinate = [&](const glm::dvec3& axis, double low, double size) {
      return glm::vec4(glm::dvec4(axis / size, (glm::dot(view.eye - placed.origin, axis) - low) / size));
    };
    data.mapU = coordinate(placed.axisX, box.low.x, box.size.x);
    data.mapV = coordinate(placed.axisY, box.low.y, box.size.y);
  }
  if (draw.blurs) {
    data.alpha = static_cast<float>(optics.alpha);
    data.blurSamples = effects.roughSamples;
  }
  if (draw.ripples) {
    const MirrorState& placed = state.mirrors[draw.mirror];
    const glm::dvec2 near = localNear(placed, view.eye);
    const RippleConstants ripple = rippleConstants(*optics.ripple, state.time, near);
    const bool front = glm::dot(placed.normal, draw.plane.normal) > 0.0;
    data.axisX = glm::vec3(placed.axisX);
    data.axisY = glm::vec3(placed.axisY);
    data.rippleOrigin = glm::vec3(placed.at(near) - view.eye);
    data.waveNumber = ripple.waveNumber;
    data.rippleSlope = front ? ripple.slope : -ripple.slope;
    data.firstPhase = ripple.phases.x;
    data.secondPhase = ripple.phases.y;
  }
  return data;
}

std::vector<std::vector<ClipPolygon>> mirrorPolygons(const Pass& pass, const glm::dmat4& projection) {
  std::vector<std::vector<ClipPolygon>> polygons;
  for (const MirrorDraw& draw : pass.mirrors) {
    std::vector<ClipPolygon>& own = polygons.emplace_back();
    const std::span<const Polygon> pieces = draw.pieces.empty() ? std::span(&draw.polygon, 1) : std::span(draw.pieces);
    for (const Polygon& piece : pieces) {
      if (piece.empty()) {
        continue;  // outside the view
      }
      ClipPolygon& clip = own.emplace_back();
      for (const glm::dvec3& p : piece) {
        clip.push_back(projection * glm::dvec4(pass.view.worldToView * (p - pass.view.eye), 1.0));
      }
    }
  }
  return polygons;
}

std::vector<ClipPolygon> partsToDraw(const Pass& pass, const SceneState& state,
                                     std::span<const std::vector<ClipPolygon>> polygons, size_t index, size_t& cuts) {
  constexpr size_t mostParts = 1024;
  constexpr size_t mostCuts = 100'000;  // about 10 ms
  const MirrorDraw& draw = pass.mirrors[index];
  std::vector<ClipPolygon> parts = polygons[index];
  if (draw.layer == 0) {
    return parts;
  }
  double largestDepth = 0.0;
  for (size_t i = 0; i < polygons.size(); ++i) {
    const MirrorDraw& other = pass.mirrors[i];
    if (state.mirrors[other.mirror].plane != state.mirrors[draw.mirror].plane) {
      continue;
    }
    for (const ClipPolygon& polygon : polygons[i]) {
      for (const glm::dvec4& v : polygon) {
        largestDepth = std::max(largestDepth, v.z / v.w);
      }
      if (other.layer < draw.layer && parts.size() <= mostParts && cuts <= mostCuts) {
        cuts += parts.size();
        cutAway(parts, polygon);
      }
    }
  }
  if (parts.size() > mostParts || cuts > mostCuts) {
    parts.clear();
  } else if (parts.empty()) {
    return parts;
  }
  for (const ClipPolygon& polygon : polygons[index]) {
    parts.push_back(movedBack(polygon, draw.layer, largestDepth));
  }
  return parts;
}

void addFan(std::vector<glm::vec4>& vertices, std::span<const glm::dvec4> polygon) {
  for (size_t i = 1; i + 1 < polygon.size(); ++i) {
    vertices.insert(vertices.end(), {polygon[0], polygon[i], polygon[i + 1]});
  }
}

void addFringe(std::vector<glm::vec4>& vertices, std::span<const glm::dvec4> clip, const glm::dvec2& size) {
  const std::vector<glm::dvec4> outer = grown(clip, size.x, size.y, fringeWidth);
  const auto far = [](const glm::dvec4& v) { return glm::vec4(v.x, v.y, fringeDepth * v.w, v.w); };
  for (size_t i = 0; i < clip.size(); ++i) {
    const size_t next = (i + 1) % clip.size();
    vertices.insert(vertices.end(), {far(clip[i]), far(outer[i]), far(outer[next])});
    vertices.insert(vertices.end(), {far(clip[i]), far(outer[next]), far(clip[next])});
  }
}

}  // namespace speculum
