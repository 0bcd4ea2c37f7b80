// Shadows looked up in the images about a light: ShadowMap in src/frame/frame_plan.hpp. docs/numerics.md derives the
// bias. Needs interface.glsl.
#include "cube_face.glsl"

layout(constant_id = 4) const uint onlyShadowFace = anyShadowFace;  // face that contains the whole scene, in every map
layout(constant_id = 10) const uint shadowedLights = 0;  // first lights of each pass, which have a map

layout(set = 2, binding = 0) uniform sampler2D shadowTexels;  // disparities from the light, 1/m; 0: nothing is there
layout(set = 2, binding = 1, std140) uniform ShadowMaps { ShadowMapData shadowMaps[mostShadowMaps]; };

const float leastShadowCosine = 0.05;  // steeper slopes count as this one
const float shadowBias = 0.5;          // texels

// The point that shadows are looked up for, relative, and the normal of its triangle. Set before surfaceRadiance().
vec3 receiver;
vec3 receiverNormal;

// Sets the receiver from a triangle's interpolated position. Where the triangle covers a pixel in part, some drivers
// put that position off its plane, so the plane is derived from pixel centres. Needs uniform control flow.
void setReceiver(vec3 position, vec3 shadingNormal) {
  vec3 center = rayThrough(gl_FragCoord.xy) / max(gl_FragCoord.w, 1e-30);
  vec3 facet = cross(dFdx(center), dFdy(center));
  float along = dot(facet, center) / dot(facet, position);  // not a number for a triangle without a plane
  bool found = along > 0.5 && along < 2.0;
  receiver = found ? along * position : position;
  receiverNormal = found ? safeNormalize(facet * inversesqrt(max(dot(facet, facet), 1e-30))) : shadingNormal;
  receiverNormal = dot(receiverNormal, shadingNormal) < 0.0 ? -receiverNormal : receiverNormal;
}

// Chooses among loads at uniform addresses, because lavapipe reads any other address once for each pixel.
vec4 windowOf(uint map, FaceDirection face) {
  ShadowMapData data = shadowMaps[map];
  bool positive = face.side > 0.0;
  vec4 x = positive ? data.faces[0] : data.faces[1];
  vec4 y = positive ? data.faces[2] : data.faces[3];
  vec4 z = positive ? data.faces[4] : data.faces[5];
  return face.axis == 0 ? x : face.axis == 1 ? y : z;
}

// Returns the share of the light that reaches the receiver, interpolated bilinearly between four texels. Each is
// compared with the disparity of the receiver's plane at that texel, which is linear on the face, so that no plane
// shadows itself whatever its slope.
float shadowShare(LightData light) {
  vec3 p = receiver - light.position;
  FaceDirection face = onlyShadowFace == anyShadowFace ? cubeFace(p) : faceOf(onlyShadowFace, p);
  vec4 window = windowOf(light.shadowMap, face);
  float disparity = 1.0 / max(face.along, 1e-30);
  vec2 at = inFace(face, p) * disparity * window.xy + window.zw;
  // Height of the light below the receiver's plane.
  float height = min(dot(receiverNormal, p), -leastShadowCosine * length(p) - 1e-30);
  vec2 gradient = inFace(face, receiverNormal) / (height * window.xy);
  disparity += disparity * shadowBias / min(window.x, window.y);

  vec2 corner = floor(at + 0.5);  // shared by the four texels
  vec2 low = corner - 0.5 - at;
  // In the order of textureGather: lower left, lower right, upper right, upper left, with y downwards.
  vec4 x = low.x + vec4(0.0, 1.0, 1.0, 0.0);
  vec4 y = low.y + vec4(1.0, 1.0, 0.0, 0.0);
  vec4 texels = textureGather(shadowTexels, corner / vec2(textureSize(shadowTexels, 0)));
  vec4 lit = vec4(lessThanEqual(texels, disparity + gradient.x * x + gradient.y * y));
  float share = dot(lit, (1.0 - abs(x)) * (1.0 - abs(y)));
  return window.x > 0.0 ? share : 1.0;  // nothing casts a shadow in an empty face
}

// Returns the share of light `index` of the pass that reaches the receiver.
float litShare(uint index, LightData light) {
  bool shadowed = lightCount == manyLights ? light.shadowMap != noShadowMap : index < shadowedLights;
  return shadowed ? shadowShare(light) : 1.0;
}
