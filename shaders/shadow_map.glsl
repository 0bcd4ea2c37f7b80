// Shadows looked up in the images about a light: ShadowMap in src/frame/frame_plan.hpp. docs/numerics.md derives the
// bias. Needs interface.glsl.
#include "cube_face.glsl"

layout(constant_id = 11) const uint shadowedLights = 0;  // bits of the pass's lights that have a map, if these are fixed

layout(set = 2, binding = 0) uniform sampler2D shadowTexels;  // disparities from the light, 1/m; 0: nothing is there
layout(set = 2, binding = 1, std140) uniform ShadowMaps { ShadowMapData shadowMaps[mostShadowMaps]; };

const float leastShadowCosine = 0.05;  // steeper slopes count as this one
const float shadowBias = 0.5;          // texels

// Returns the lit ones of four texels.
vec4 litTexels(vec2 corner, vec4 disparity) {
  vec4 texels = textureGather(shadowTexels, corner / vec2(textureSize(shadowTexels, 0)));
  return vec4(lessThanEqual(texels, disparity));
}

// Unit normal of the triangle at `position`, on the side of the shading normal. Needs uniform control flow.
vec3 facetNormal(vec3 position, vec3 normal) {
  vec3 facet = cross(dFdx(position), dFdy(position));
  float length2 = dot(facet, facet);
  facet = length2 > 1e-30 ? facet * inversesqrt(length2) : normal;
  return dot(facet, normal) < 0.0 ? -facet : facet;
}

// Returns the share of the light that reaches the surface, the mean over a square of three texels. Each texel is
// compared with the disparity of the surface's plane at that texel, which is linear on the face, so that no plane
// shadows itself whatever its slope.
float shadowShare(LightData light, vec3 position, vec3 normal) {
  vec3 p = position - light.position;
  CubeFace face = cubeFace(p);
  vec4 window = shadowMaps[light.shadowMap].faces[face.index];
  float disparity = 1.0 / max(face.along, 1e-30);
  vec2 at = vec2(dot(p, face.right), dot(p, face.down)) * disparity * window.xy + window.zw;
  float away = length(p);
  float height = min(dot(normal, p), -leastShadowCosine * away);  // of the light below the surface's plane
  vec2 gradient = vec2(dot(normal, face.right), dot(normal, face.down)) / (min(height, -1e-30) * window.xy);
  disparity += disparity * shadowBias / min(window.x, window.y);

  vec2 corner = floor(at - 0.5);
  vec2 f = at - 0.5 - corner;
  vec4 x = disparity + gradient.x * (vec4(-1.0, 0.0, 1.0, 2.0) - f.x);  // of the four columns
  vec4 y = gradient.y * (vec4(-1.0, 0.0, 1.0, 2.0) - f.y);
  // textureGather gives the lower left, lower right, upper right and upper left texel of the four about a corner.
  vec4 sum = litTexels(corner, x.xyyx + y.yyxx) * vec4(1.0 - f.x, 1.0, 1.0, 1.0 - f.x) * vec4(1.0, 1.0, 1.0 - f.y, 1.0 - f.y);
  sum += litTexels(corner + vec2(2.0, 0.0), x.zwwz + y.yyxx) * vec4(1.0, f.x, f.x, 1.0) * vec4(1.0, 1.0, 1.0 - f.y, 1.0 - f.y);
  sum += litTexels(corner + vec2(0.0, 2.0), x.xyyx + y.wwzz) * vec4(1.0 - f.x, 1.0, 1.0, 1.0 - f.x) * vec4(f.y, f.y, 1.0, 1.0);
  sum += litTexels(corner + vec2(2.0, 2.0), x.zwwz + y.wwzz) * vec4(1.0, f.x, f.x, 1.0) * vec4(f.y, f.y, 1.0, 1.0);
  return dot(sum, vec4(1.0 / 9.0));
}

// Returns the share of light `index` of the pass that reaches the surface.
float litShare(uint index, LightData light, Surface surface) {
  bool shadowed = lightCount == manyLights ? light.shadowMap != noShadowMap : (shadowedLights >> index & 1u) != 0;
  return shadowed ? shadowShare(light, surface.position, facetNormal(surface.position, surface.normal)) : 1.0;
}
