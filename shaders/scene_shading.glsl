// The fragment shader of objects whose light takes no rays. ENVIRONMENT draws curved mirrors, which look up an
// environment map; with REFLECTION_ONLY it draws no base, because shade.glsl has shaded the base. REPEATING draws
// RepeatingTriangles, VERTEX_COLORS meshes with colors of their vertices, COVERED materials with coverage. ASKS draws
// the identifiers of surfaces whose light shadow maps do not decide. HANDS_ON takes values from scene_handed.vert
// instead of uniform buffers.
#define HANDED in
#include "interface.glsl"
#include "object_values.glsl"
#include "shading.glsl"

layout(constant_id = constantDiffuseLookup) const uint diffuseLookup = textureNone;
layout(constant_id = constantGlossy) const bool glossy = true;  // the specular color is not black

#ifdef REFLECTION_ONLY
layout(constant_id = constantSamples) const uint samples = 1;

layout(push_constant) uniform Draw {
  DrawConstants draw;
  ShadeConstants area;
};

#include "identifiers.glsl"
#define SHADED_SET 2
#define SHADED_ACCESS readonly
#define SHADED_BY_DRAWS
#include "shaded.glsl"
#elif defined(COVERED)
#include "covered_draw.glsl"
layout(constant_id = constantRepeating) const bool repeating = false;
#else
layout(push_constant) uniform Draw { DrawConstants draw; };
#endif
#ifndef COVERED
layout(constant_id = constantClamps) const bool clamps = false;
#endif

layout(set = 1, binding = 0) uniform sampler2D diffuseTexture;  // linear radiance factors; with ENVIRONMENT the map

layout(location = 0) out vec4 color;

#ifdef ASKS
#include "identifiers.glsl"
#ifndef COVERED
#include "sample_positions.glsl"
layout(constant_id = constantSamples) const uint samples = 1;
#endif

#define SHADED(input) interpolateAtOffset(input, shadedAt)
#else
#define SHADED(input) input
#endif

vec2 shadedAt = vec2(0.0);  // point that is shaded, from the pixel's centre

// Returns the place within the texture if it does not repeat. The sampler repeats: half a texel of the coarser level
// from the edge it reads no texel of the other edge.
vec2 insideEdges(vec2 place, float level) {
  vec2 edge = min(0.5 * exp2(ceil(max(level, 0.0))) / vec2(textureSize(diffuseTexture, 0)), 0.5);
  return clamps ? clamp(place, edge, 1.0 - edge) : place;
}

vec3 filtered(vec2 place) {
  if (clamps) {
    vec2 inside = insideEdges(place, textureQueryLod(diffuseTexture, place).x);
    return textureGrad(diffuseTexture, inside, dFdx(place), dFdy(place)).rgb;
  }
  return texture(diffuseTexture, place).rgb;
}

// Filters anisotropically for devices whose samplers do not.
vec3 anisotropic(vec2 place) {
  vec2 size = vec2(textureSize(diffuseTexture, 0));
  // A longer step than the whole texture changes no mean. It need not be finite at a triangle's edge.
  vec2 across = min(vec2(1.0), max(vec2(-1.0), dFdx(place)));
  vec2 down = min(vec2(1.0), max(vec2(-1.0), dFdy(place)));
  Footprint footprint = footprintOf(across, down, size);
  vec2 step = footprint.major / footprint.count;
  float level = log2(max(1.0, length(step * size)));
  vec3 sum = vec3(0.0);
  for (float i = 1.0; i <= footprint.count; i += 1.0) {
    vec2 at = insideEdges(place + partOf(footprint, i), level);
    sum += textureGrad(diffuseTexture, at, step, vec2(0.0)).rgb;
  }
  return sum / footprint.count;
}

// Returns the texture coordinates where the line of sight through `pixel` meets the triangle, or `interpolated` ones.
vec2 uvAt(vec2 interpolated, vec2 pixel) {
#if defined(REPEATING) || defined(COVERED)
#ifdef COVERED
  if (!repeating) {
    return interpolated;
  }
#endif
  uint index = instances[indexAndReach.x].repeats + draw.firstTriangle + uint(gl_PrimitiveID);
  return repeatingUv(index, view.traceOffset.xyz, rayThrough(pixel));
#else
  return interpolated;
#endif
}

vec3 diffuseFactor(vec2 uv) {
  if (diffuseLookup == textureNearest) {
    return texelFetch(diffuseTexture, nearestTexel(uv, textureSize(diffuseTexture, 0), clamps), 0).rgb;
  }
  if (diffuseLookup == textureBilinear) {
    return bilinearColor(diffuseTexture, uv, clamps);
  }
  vec2 place = vec2(uv.x, 1.0 - uv.y);
  return diffuseLookup == textureAnisotropic ? anisotropic(place) : filtered(place);
}

#ifdef ENVIRONMENT
#include "environment.glsl"
#endif

#ifdef REFLECTION_ONLY
// Returns the mask of the samples whose base was shaded for this triangle.
int samplesOfBase() {
  float mark = reflectionMark(Identifier(false, true, indexAndReach.x, draw.firstTriangle + uint(gl_PrimitiveID)));
  uint pixel = pixelNumber(uvec2(ivec2(gl_FragCoord.xy) - area.corner));
  int mask = 0;
  for (uint i = 0; i < samples; ++i) {
    uvec2 value = shaded[sampleNumber(pixel, i)];
    mask |= int(value.x != notShaded && unpackHalf2x16(value.y).y == mark) << i;
  }
  return mask;
}
#endif

void main() {
#ifdef ASKS
  // Drivers choose places of their own for `centroid`. Deferred shading takes the mean of the samples, of those that
  // nothing hides.
  shadedAt = meanPosition(samples, uint(gl_SampleMaskIn[0])) - 0.5;
#endif
  vec4 positionU = SHADED(positionAndU);
  vec4 normalV = SHADED(normalAndV);
  vec3 position = positionU.xyz;
  vec3 normal = normalV.xyz;
  uint instanceIndex = indexAndReach.x;
  float reach = uintBitsToFloat(indexAndReach.y);
#ifdef HANDS_ON
  Surface surface = Surface(position, normal, handedDiffuse.rgb, handedSpecular.rgb, handedEmission, handedDiffuse.w,
                            glossy, reach);
  float handedness = handedSpecular.w;
#else
  float handedness = draw.handedness;
  Surface surface =
      Surface(position, normal, draw.diffuse, draw.specular, draw.emission, draw.shininess, glossy, reach);
#endif
  surface.specular = glossy ? surface.specular : vec3(0.0);
  // The side that faces the viewer is lit, by the winding in the model file. gl_FrontFacing already follows the view's
  // handedness; the sign of the instance's determinant corrects it for mirrored instances.
  bool front = gl_FrontFacing == (handedness > 0.0);
  surface.normal = safeNormalize(front ? normal : -normal);
#ifndef ENVIRONMENT
  if (diffuseLookup != textureNone) {
    surface.diffuse *= diffuseFactor(uvAt(vec2(positionU.w, normalV.w), gl_FragCoord.xy + shadedAt));
  }
#endif
#ifdef VERTEX_COLORS
  surface.diffuse *= SHADED(vertexColor).rgb;
#endif
#ifdef SHADOW_MAPS
  setReceiver(position, surface.normal);
#endif
#ifdef ENVIRONMENT
  CurvedMirrorData map = curvedMirrors[instances[instanceIndex].curvedMirror];
  vec3 direction = safeNormalize(surface.position);
  surface = mirrorBase(surface.position, surface.normal, map.baseColor, reach);
  float cosine = -dot(surface.normal, direction);
  vec3 reflectance = reflectanceAt(map.reflectance, map.schlick, cosine);
  vec3 base = vec3(0.0);
#ifndef REFLECTION_ONLY
  if (any(greaterThan(surface.diffuse, vec3(0.0)))) {
    base = surfaceRadiance(surface);
  }
#endif
  vec3 reflection = environmentRadiance(map, surface, direction, reflectance);
#ifdef REFLECTION_ONLY
  reflection = min(reflection, shareMax);
#endif
  vec3 radiance = (1.0 - reflectance) * base + reflectance * reflection;
#else
  vec3 radiance = surfaceRadiance(surface);
#endif
  // gl_FragCoord.w would belong to the pixel's centre, which on a steep triangle may lie far from the shaded point.
  float w = (view.clipFromRelative * vec4(position, 1.0)).w;
#ifndef REFLECTION_ONLY
  color = storable(radiance, disparityLength / max(w, 1e-30), gl_FragCoord.xy);
#else
  color = addable(radiance, disparityLength / max(w, 1e-30), gl_FragCoord.xy);
  gl_SampleMask[0] = samplesOfBase();
#endif
#ifdef ASKS
  color = asks ? encoded(Identifier(false, false, instanceIndex, draw.firstTriangle + uint(gl_PrimitiveID))) : color;
#endif
#ifdef COVERED
  keepCovered(uvAt(vec2(positionAndU.w, normalAndV.w), gl_FragCoord.xy), instances[instanceIndex].traceInstance,
              draw.firstTriangle + uint(gl_PrimitiveID));
#endif
}
