// Reflections of a curved mirror, looked up in its environment map, six images about its centre: Cube in
// src/plan/frame_plan.hpp, with the faces of src/plan/cube_face.hpp. The map is bound as `diffuseTexture`. Needs
// shading.glsl.
#include "cube_face.glsl"

const float environmentBorder = 1.0;  // texels of a face beyond its edges

// Texel of the map in a direction from its centre.
struct MapTexel {
  ivec2 corner;  // of the face
  vec2 texel;    // in the face
};

MapTexel mapTexel(vec3 d, int size) {
  FaceDirection face = cubeFace(d);
  vec2 p = inFace(face, d) / max(face.along, 1e-30);
  int index = indexOf(face);
  float within = float(size) - 2.0 * environmentBorder;
  return MapTexel(size * ivec2(index % 3, index / 3), environmentBorder + (0.5 * clamp(p, -1.0, 1.0) + 0.5) * within);
}

// Returns the map's radiance, interpolated bilinearly. The background, which alone has disparity 0 in a map, is
// infinitely far, in direction d from everywhere.
vec3 mapRadiance(MapTexel at, int size, vec3 d) {
  vec2 low = clamp(floor(at.texel - 0.5), vec2(0.0), vec2(size - 2));
  vec2 weight = clamp(at.texel - 0.5 - low, 0.0, 1.0);
  vec3 background = backgroundRadiance(d);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 next = ivec2(i & 1, i >> 1);
    vec4 value = texelFetch(diffuseTexture, at.corner + ivec2(low) + next, 0);
    vec2 share = mix(1.0 - weight, weight, vec2(next));
    sum += share.x * share.y * (value.a > 0.0 ? value.rgb : background);
  }
  return sum;
}

// Returns the direction from the map's centre to the point where a ray leaves the box: Lagarde, Zanuttini, "Local
// Image-based Lighting With Parallax-corrected Cubemap" (2012).
vec3 throughBox(CurvedMirrorData map, vec3 position, vec3 d) {
  vec3 from = position - map.center;
  vec3 along = vec3(abs(d.x) < 1e-20 ? 1e-20 : d.x, abs(d.y) < 1e-20 ? 1e-20 : d.y, abs(d.z) < 1e-20 ? 1e-20 : d.z);
  vec3 leave = max((map.low - from) / along, (map.high - from) / along);
  float t = min(leave.x, min(leave.y, leave.z));
  return t > 0.0 ? from + t * d : d;
}

// Returns the radiance that a curved mirror reflects at `surface`, seen along `direction`.
vec3 environmentRadiance(CurvedMirrorData map, Surface surface, vec3 direction, vec3 reflectance) {
  // The reflection is kept above the shading normal's plane, not the triangle's: triangles may be too small for
  // derivatives.
  vec3 d = mirrored(direction, surface.normal, surface.normal);
  if (map.hasMap == 0 || isLastBounce(view.depth, view.throughput * reflectance)) {
    return backgroundRadiance(d);
  }
  vec3 toward = map.hasBox != 0 ? throughBox(map, surface.position, d) : d;
  return mapRadiance(mapTexel(toward, map.faceSize), map.faceSize, d);
}
