// Shadows looked up in a shadow map, six images about a light: Cube in src/plan/frame_plan.hpp. docs/numerics.md
// derives the comparison. With ASKS, light is left to rays where the map does not decide it; the map then has marks of
// edges. Needs interface.glsl.
#ifdef COMPUTE
#define SHADOW_SET 3
#else
#define SHADOW_SET 2
#endif
#include "cube_face.glsl"

// Face that contains the whole scene, in every map.
layout(constant_id = constantOnlyShadowFace) const uint onlyShadowFace = anyShadowFace;
// Number of lights with a shadow map. They are the first lights of each pass.
layout(constant_id = constantShadowedLights) const uint shadowedLights = 0;

layout(set = SHADOW_SET, binding = 0) uniform usampler2D shadowTexels;  // of storePlane(); 0: nothing is there
layout(set = SHADOW_SET, binding = 1, std140) uniform ShadowMaps { ShadowMapData shadowMaps[mostShadowMaps]; };

const float leastShadowCosine = 1e-6;  // steeper slopes count as this one
const float shadowBias = 0.125;        // texels
const float slopeError = 1.0 / 64.0;   // texels; error of planes that are rasterised or derived from pixels

// The point that shadows are looked up for, relative, and the normal of its triangle, towards the eye. Set before
// surfaceRadiance().
vec3 receiver;
vec3 receiverNormal;

#ifdef ASKS
const float undecided = -1.0;  // a share of light

bool hasPlane = true;  // the receiver's triangle has a plane
#ifndef COMPUTE
layout(constant_id = constantWholePixel) const bool wholePixel = false;  // a share must hold in the whole pixel

vec3 pixelCenter;  // where the pixel's centre sees the receiver's plane, relative
vec3 pixelAcross;  // from there to where the next pixels see it
vec3 pixelDown;
bool asks = false;  // light that would reach the surface is undecided
#endif
#endif

#ifndef COMPUTE
// Sets the receiver from a triangle's interpolated position. Where the triangle covers a pixel in part, some drivers
// put that position off its plane, so the plane is derived from pixel centres. Needs uniform control flow.
void setReceiver(vec3 position, vec3 shadingNormal) {
  vec3 center = rayThrough(gl_FragCoord.xy) / max(gl_FragCoord.w, 1e-30);
  vec3 facet = cross(dFdx(center), dFdy(center));
  float along = dot(facet, center) / dot(facet, position);  // not a number for a triangle without a plane
#ifdef ASKS
  bool found = abs(along - 1.0) < 2e-4;  // seen at grazing angle, the derived plane is too uncertain to decide
  hasPlane = found;
  pixelCenter = center;
  pixelAcross = dFdx(center);
  pixelDown = dFdy(center);
#else
  bool found = along > 0.5 && along < 2.0;
#endif
  receiver = found ? along * position : position;
  receiverNormal = found ? safeNormalize(facet * inversesqrt(max(dot(facet, facet), 1e-30))) : shadingNormal;
  receiverNormal = dot(receiverNormal, position) > 0.0 ? -receiverNormal : receiverNormal;
}
#endif

// Chooses among loads at uniform addresses, because lavapipe reads any other address once for each pixel.
vec4 windowOf(uint map, FaceDirection face) {
  ShadowMapData data = shadowMaps[map];
  bool positive = face.side > 0.0;
  vec4 x = positive ? data.faces[0] : data.faces[1];
  vec4 y = positive ? data.faces[2] : data.faces[3];
  vec4 z = positive ? data.faces[4] : data.faces[5];
  return face.axis == 0 ? x : face.axis == 1 ? y : z;
}

// The planes that a light sees at four texels about a point of its map, in the order of textureGather: lower left,
// lower right, upper right, upper left, with y downwards. Disparities are linear on a plane.
struct SeenPlanes {
  vec4 x;  // texels, from the point to the texels' centres
  vec4 y;
  vec4 disparity;  // at the texels' centres; 0: nothing is there
  vec4 riseX;      // growth of the disparity from texel to texel
  vec4 riseY;
  vec4 rise;       // growth of the disparity from the point to the texels' centres
#ifdef ASKS
  vec4 edge;       // 1: an edge is seen, and the disparity is that of a point of it within the texel
#endif
};

SeenPlanes planesAbout(vec2 at) {
  vec2 corner = floor(at + 0.5);  // shared by the four texels
  vec2 low = corner - 0.5 - at;
  SeenPlanes seen;
  seen.x = low.x + vec4(0.0, 1.0, 1.0, 0.0);
  seen.y = low.y + vec4(1.0, 1.0, 0.0, 0.0);
  corner /= vec2(textureSize(shadowTexels, 0));
  seen.disparity = uintBitsToFloat(textureGather(shadowTexels, corner, 0));
  uvec4 slopes = textureGather(shadowTexels, corner, 1);
#ifdef ASKS
  bvec4 edge = equal(slopes, uvec4(shadowEdge));
  seen.edge = vec4(edge);
  slopes = mix(slopes, uvec4(0), edge);
#endif
  seen.riseX = uintBitsToFloat(slopes & 0xffff0000u);
  seen.riseY = uintBitsToFloat(slopes << 16);
  seen.rise = seen.riseX * seen.x + seen.riseY * seen.y;
  return seen;
}

// Returns the share of the light that reaches point `p` of the receiver's plane, from the light, interpolated bilinearly
// between four texels. The plane seen at a texel hides the receiver if it is nearer to the light than the receiver's own
// plane both at the texel's centre and at the receiver. If it is nearer at only one of these places, the two planes
// belong to surfaces that meet in between. If it is farther at both, the light passes beside the receiver's surface, and
// the texel tells nothing.
float shareAt(LightData light, vec3 p) {
  FaceDirection face = onlyShadowFace == anyShadowFace ? cubeFace(p) : faceOf(onlyShadowFace, p);
  vec4 window = windowOf(light.shadowMap, face);
  float disparity = 1.0 / max(face.along, 1e-30);
  SeenPlanes seen = planesAbout(inFace(face, p) * disparity * window.xy + window.zw);
  float height = dot(receiverNormal, p);  // of the light below the receiver's plane
  bool facesLight = height < 0.0;
  height = (facesLight ? -1.0 : 1.0) * max(abs(height), leastShadowCosine * length(p) + 1e-30);
  vec2 slope = inFace(face, receiverNormal) / (height * window.xy);
  vec4 rise = slope.x * seen.x + slope.y * seen.y;  // of the receiver's plane

  vec4 nearerAtTexel = seen.disparity - disparity - rise;
  vec4 nearerHere = seen.disparity - disparity - seen.rise;
#ifndef ASKS
  // Where the plane of the next texel passes through what a texel shows, two surfaces meet there, and rounding decides
  // which of them the texel shows. The one that is nearer at the receiver counts.
  vec4 besideX = seen.disparity.yxwz + vec4(-1.0, 1.0, 1.0, -1.0) * seen.riseX.yxwz;
  vec4 besideY = seen.disparity.wzyx + vec4(1.0, 1.0, -1.0, -1.0) * seen.riseY.wzyx;
  vec4 marginX = 1e-6 * disparity + abs(seen.riseX.yxwz - seen.riseX) / 128.0;
  vec4 marginY = 1e-6 * disparity + abs(seen.riseY.wzyx - seen.riseY) / 128.0;
  nearerHere += vec4(lessThan(abs(besideX - seen.disparity), marginX)) * max(nearerHere.yxwz - nearerHere, vec4(0.0));
  nearerHere += vec4(lessThan(abs(besideY - seen.disparity), marginY)) * max(nearerHere.wzyx - nearerHere, vec4(0.0));
#endif
  vec4 rounding = 1e-6 * disparity + slopeError * abs(seen.rise);
  vec4 error = disparity * shadowBias / min(window.x, window.y) + slopeError * (abs(seen.rise) + abs(rise));
  vec4 covers = vec4(greaterThan(nearerHere, rounding));
  vec4 hides = covers * vec4(greaterThan(nearerAtTexel, error));
  vec4 tells = vec4(greaterThan(max(nearerHere, nearerAtTexel), -error)) * vec4(greaterThan(seen.disparity, vec4(0.0)));
  // A plane may lie before the receiver's, but by less than the margin.
  vec4 least = disparity * slopeError / min(window.x, window.y) + slopeError * (abs(seen.rise) + abs(rise));
  vec4 close = covers * vec4(greaterThan(nearerAtTexel, least));
#ifdef ASKS
  // Dark and lit are decided only where all four texels agree, none sees an edge before the receiver's plane, and no
  // plane is close.
  vec4 reach = error + abs(slope.x) + abs(slope.y);  // an edge's point lies up to a texel from the centre
  vec4 unclear = mix(close - hides, vec4(greaterThan(nearerAtTexel, reach)), seen.edge);
  hides *= 1.0 - seen.edge;
  bool open = dot(hides + unclear, vec4(1.0)) == 0.0;
  bool decided = hasPlane && window.x > 0.0 && light.clearance == vec3(0.0);
  return !decided ? undecided : dot(hides, vec4(1.0)) == 4.0 ? 0.0 : open && facesLight ? 1.0 : undecided;
#else
  // A plane that is close and runs along the receiver's is the receiver's own, moved by rounding. Others meet the
  // receiver's plane within a texel.
  close = max(hides, close * vec4(lessThan(nearerAtTexel, abs(seen.riseX - slope.x) + abs(seen.riseY - slope.y))));
  // A plane that also hides the receiver from another texel crosses the receiver's plane and does not end there.
  vec4 hiding = close * nearerHere;
  float nearest = max(max(hiding.x, hiding.y), max(hiding.z, hiding.w));
  tells *= 1.0 - (covers - hides) * vec4(lessThan(abs(nearerHere - nearest), error));
  // A plane that is close decides only where no other texel tells anything: the receiver then is a wall's part behind
  // the edge at which it meets the plane, and light would leak along the edge.
  tells *= 1.0 - (close - hides);

  vec4 weights = (1.0 - abs(seen.x)) * (1.0 - abs(seen.y)) * tells;
  float sum = dot(weights, vec4(1.0));
  // Without any texel that tells something, a surface that faces away from the light lies behind its own body's
  // outline.
  bool isOpen = facesLight && dot(close, vec4(1.0)) == 0.0;
  float share = sum > 0.0 ? 1.0 - dot(weights, hides) / sum : isOpen ? 1.0 : 0.0;
  return window.x > 0.0 ? share : 1.0;  // nothing casts a shadow in an empty face
#endif
}

#ifndef COMPUTE
float shadowShare(LightData light) {
  float share = shareAt(light, receiver - light.position);
#ifdef ASKS
  if (wholePixel) {
    // Any of its samples may be seen: what is drawn later may hide the others.
    vec3 p = pixelCenter - light.position;
    float a = shareAt(light, p - 0.5 * (pixelAcross + pixelDown));
    float b = shareAt(light, p + 0.5 * (pixelAcross - pixelDown));
    float c = shareAt(light, p - 0.5 * (pixelAcross - pixelDown));
    float d = shareAt(light, p + 0.5 * (pixelAcross + pixelDown));
    return a == share && b == share && c == share && d == share ? share : undecided;
  }
#endif
  return share;
}

// Returns the share of light `index` of the pass that reaches the receiver.
float litShare(uint index, LightData light) {
  bool shadowed = lightCount == manyLights ? light.shadowMap != noShadowMap : index < shadowedLights;
  return shadowed ? shadowShare(light) : 1.0;
}
#endif
