// Rays through the scene: a hierarchy of boxes over instances and mirrors, and one over the triangles of each mesh.
// Needs interface.glsl, shading.glsl and coverage.glsl.
//
// Written for lavapipe, which runs both sides of every branch, enters every loop once, and reads a storage buffer once
// for each pixel and component. So nodes are read through texel buffers, traversal needs no stack, and rays to all
// lights are traced by one call. A ray tests 11 to 22 boxes of instances and mirrors and 9 to 26 of meshes, few enough
// not to limit the speed.

layout(set = 2, binding = 0) uniform usamplerBuffer traceNodes;      // TraceNode
layout(set = 2, binding = 1) uniform usamplerBuffer traceTriangles;  // TraceTriangle
layout(set = 2, binding = 2, std430) readonly buffer TraceFaces { TraceFace traceFaces[]; };
layout(set = 2, binding = 3, std430) readonly buffer TraceVertices { TraceVertex traceVertices[]; };
layout(set = 2, binding = 4, std430) readonly buffer TraceTextures { TraceTexture traceTextures[]; };
layout(set = 2, binding = 5, std430) readonly buffer TraceTexels { uvec2 traceTexels[]; };      // rgba, half floats
layout(set = 2, binding = 6) uniform usamplerBuffer traceTopNodes;  // TraceTopNode
layout(set = 2, binding = 7, std430) readonly buffer TraceInstances { TraceInstance traceInstances[]; };
layout(set = 2, binding = 8, std430) readonly buffer TraceMirrors { TraceMirror traceMirrors[]; };
layout(set = 2, binding = 9) uniform usamplerBuffer traceMirrorEdges;  // from x, y; to x, y; local
layout(set = 2, binding = 10, std430) readonly buffer LightPaths {
  TraceCounts traceCounts;
  LightPath lightPaths[];
};
layout(set = 2, binding = 11) uniform usamplerBuffer traceInstanceTexels;
layout(set = 2, binding = 12) uniform usamplerBuffer traceMirrorTexels;

layout(constant_id = constantRepeating) const bool repeating = false;  // there are repeatingTriangles
layout(constant_id = constantVertexAlpha) const bool vertexAlpha = false;  // colors of some mesh have alpha that counts
layout(constant_id = constantTransparency) const bool transparency = false;  // some material has coverage

TraceVertex vertexOf(uint instance, uint triangle, uint corner) {
  uint vertex = traceFaces[traceInstances[instance].firstTriangle + triangle].vertices[corner];
  return traceVertices[traceInstances[instance].firstVertex + vertex];
}

const uint none = 0xffffffffu;
const float infinity = 1e38;

// Surfaces that a ray ignores: the one it starts on, and the mirror that it ends on. A ray ignores all mirrors in the
// plane of such a mirror.
struct Skip {
  uint instance;
  uint triangle;
  uint plane;
  uint secondPlane;
  float near;  // metres from the origin within which triangles are ignored in whose plane the origin lies
};

// Returns Skip::near for a point. Where triangles meet or coincide, rounding may put the point behind another one: by
// some 1e-7 of its distance from the eye, and more along a ray that leaves at grazing angle.
float nearOf(vec3 position) { return 2e-5 * length(position); }

struct Hit {
  float t;
  uint instance;  // `none`: not an object
  uint slot;      // of its triangle in traceTriangles
  vec3 weights;
  uint mirror;  // `none`: not a mirror
};

// A ray prepared for the boxes of one hierarchy. It enters a box's slab of sides `near` and `far` at
// near * inverse - nearOffset and leaves it at far * inverse - farOffset.
struct BoxRay {
  vec3 inverse;
  vec3 nearOffset;
  vec3 farOffset;
  uint octant;
};

float largestComponent(vec3 v) {
  vec3 size = abs(v);
  return max(size.x, max(size.y, size.z));
}

// Widens all boxes by what rounding may move the ray or their sides, and by `margin`.
BoxRay boxRay(vec3 origin, vec3 direction, float margin) {
  // A component of zero would give 0 * infinity, which is not a number.
  vec3 size = abs(direction);
  float least = max(1e-10 * largestComponent(direction), 1e-30);
  vec3 inverse = 1.0 / mix(direction, vec3(least), lessThan(size, vec3(least)));
  vec3 offset = origin * inverse;
  vec3 reach = abs(inverse) * (1e-6 * abs(origin) + margin);
  uvec3 below = uvec3(lessThan(inverse, vec3(0.0)));
  return BoxRay(inverse, offset + reach, offset - reach, below.x + 2 * below.y + 4 * below.z);
}

// Maximum and minimum without care for NaN: one CPU instruction each, unlike max() and min().
float larger(float a, float b) { return a > b ? a : b; }
float smaller(float a, float b) { return a < b ? a : b; }

bool meetsBox(vec3 near, vec3 far, BoxRay ray, float tMax) {
  vec3 enters = near * ray.inverse - ray.nearOffset;
  vec3 leaves = far * ray.inverse - ray.farOffset;
  return larger(larger(enters.x, enters.y), larger(enters.z, 0.0)) <=
         smaller(smaller(leaves.x, leaves.y), smaller(leaves.z, tMax));
}

vec3 permuted(vec3 p, uint along) { return along == 2 ? p.xyz : along == 0 ? p.yzx : p.zxy; }

// Intersects by Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection" (2013): neighbours evaluate a shared edge
// with the same numbers. Returns the weights of a, b, c in xyz and the ray's parameter in w, negative without a hit.
vec4 meetTriangle(vec3 corners[3], vec3 origin, uint along, vec3 shear) {
  vec3 a = permuted(corners[0] - origin, along);
  vec3 b = permuted(corners[1] - origin, along);
  vec3 c = permuted(corners[2] - origin, along);
  a.xy -= shear.xy * a.z;
  b.xy -= shear.xy * b.z;
  c.xy -= shear.xy * c.z;
  precise float u = c.x * b.y - c.y * b.x;
  precise float v = a.x * c.y - a.y * c.x;
  precise float w = b.x * a.y - b.y * a.x;
  float area = u + v + w;
  bool outside = min(min(u, v), w) < 0.0 && max(max(u, v), w) > 0.0;
  if (outside || area == 0.0) {
    return vec4(-1.0);
  }
  return vec4(u, v, w, shear.z * (u * a.z + v * b.z + w * c.z)) / area;
}

uvec4 mirrorBits(uint mirror, uint i) {
  return texelFetch(traceMirrorTexels, int(traceMirrorTexelCount * mirror + i));
}

vec4 mirrorTexel(uint mirror, uint i) { return uintBitsToFloat(mirrorBits(mirror, i)); }

// Returns TraceMirror::firstPhase, hasRipple, plane and layers.
uvec4 mirrorPlace(uint mirror) { return mirrorBits(mirror, 7); }

uint planeOf(uint mirror) { return mirrorPlace(mirror).z; }

// Returns the layer, in its plane, of the side that is seen along `direction`.
uint layerSeen(uint mirror, vec3 direction) {
  uint layers = mirrorPlace(mirror).w;
  return dot(mirrorTexel(mirror, 1).xyz, direction) < 0.0 ? layers & 0xffffu : layers >> 16;
}

// Says whether a ray that meets `other` at `otherT` sees `mirror`, which it meets at `t`, in the place of `other`: by
// layer if both lie in one plane.
bool covers(uint mirror, float t, uint other, float otherT, vec3 direction) {
  bool onePlane = other != none && planeOf(mirror) == planeOf(other);
  return onePlane ? layerSeen(mirror, direction) < layerSeen(other, direction) : t < otherT;
}

// Returns the parameter at which the ray meets the mirror's polygon, from either side; below zero if it does not.
float meetMirror(uint mirror, vec3 origin, vec3 direction) {
  vec4 place = mirrorTexel(mirror, 0);
  vec4 normal = mirrorTexel(mirror, 1);
  vec3 fromMirror = origin - place.xyz;
  float towards = dot(normal.xyz, direction);
  float t = -dot(normal.xyz, fromMirror) / (abs(towards) < 1e-30 ? 1e-30 : towards);
  vec3 p = fromMirror + t * direction;
  vec2 local = vec2(dot(p, mirrorTexel(mirror, 2).xyz), dot(p, mirrorTexel(mirror, 3).xyz));
  uint first = floatBitsToUint(place.w);
  uint last = first + floatBitsToUint(normal.w);
  for (uint i = first;;) {
    vec4 side = uintBitsToFloat(texelFetch(traceMirrorEdges, int(i)));
    vec2 edge = side.zw - side.xy;
    t = edge.x * (local.y - side.y) - edge.y * (local.x - side.x) < 0.0 ? -1.0 : t;
    ++i;
    if (i >= last || t < 0.0) {
      return t;
    }
  }
}

// A ray in the space of one mesh.
struct LocalRay {
  vec3 origin;
  uint along;  // axis of its largest component
  vec3 shear;
};

LocalRay localRay(vec3 origin, vec3 direction) {
  vec3 size = abs(direction);
  uint along = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  vec3 d = permuted(direction, along);
  return LocalRay(origin, along, vec3(d.xy / d.z, 1.0 / d.z));
}

uvec4 instanceTexel(uint instance, uint i) {
  return texelFetch(traceInstanceTexels, int(traceInstanceTexelCount * instance + i));
}

vec4[3] meshRows(uint instance) {
  return vec4[3](uintBitsToFloat(instanceTexel(instance, 0)), uintBitsToFloat(instanceTexel(instance, 1)),
                 uintBitsToFloat(instanceTexel(instance, 2)));
}

uvec4 triangleTexel(uint slot, uint i) { return texelFetch(traceTriangles, int(3 * slot + i)); }

// Says whether a point in mesh space lies in a triangle's plane, as far as rounding tells. Then rounding decides whether
// a ray that starts or ends there meets the triangle: if it is nearly parallel to it, it may do so far from the point.
// `reach` is the sum of the lengths from which the point was computed.
bool liesInPlane(vec3 point, float reach, uint slot) {
  vec3 a = uintBitsToFloat(triangleTexel(slot, 0).xyz);
  vec3 b = uintBitsToFloat(triangleTexel(slot, 1).xyz) - a;
  vec3 c = uintBitsToFloat(triangleTexel(slot, 2).xyz) - a;
  vec3 normal = cross(b / largestComponent(b), c / largestComponent(c));
  return abs(dot(normal, point - a)) < leastHeight * (reach + largestComponent(a)) * length(normal);
}

// Returns the reach of a ray's origin in mesh space.
float reachOf(vec3 origin, vec4 rows[3]) {
  return largestComponent(origin) + largestComponent(vec3(rows[0].w, rows[1].w, rows[2].w));
}

bool endsInPlane(Hit hit, vec3 origin, vec3 direction) {
  vec4 rows[3] = meshRows(hit.instance);
  vec3 start = timesPoint(rows, origin);
  vec3 along = timesDirection(rows, direction);
  return liesInPlane(start + along, reachOf(start, rows) + largestComponent(along), hit.slot);
}

// Returns the texture coordinates of a point of a triangle, which a ray from `origin` along `direction` meets.
vec2 uvOf(uint instance, uint triangle, vec3 w, vec3 origin, vec3 direction) {
  if (repeating && triangle >= traceInstances[instance].firstRepeating) {
    return repeatingUv(traceInstances[instance].repeats + triangle, origin, direction);
  }
  TraceVertex a = vertexOf(instance, triangle, 0);
  TraceVertex b = vertexOf(instance, triangle, 1);
  TraceVertex c = vertexOf(instance, triangle, 2);
  return mat3x2(a.u, a.v, b.u, b.v, c.u, c.v) * w;
}

// Returns the color and opacity of one level of a texture, interpolated bilinearly.
vec4 bilinearTraced(TraceTexture source, vec2 uv, bool clamped) {
  ivec2 size = ivec2(source.width, source.height);
  BilinearTexels at = bilinearTexels(uv, size, clamped);
  vec4 rows[2];
  for (int i = 0; i < 2; ++i) {
    int y = i == 0 ? at.low.y : at.high.y;
    uvec2 left = traceTexels[source.firstTexel + uint(y * size.x + at.low.x)];
    uvec2 right = traceTexels[source.firstTexel + uint(y * size.x + at.high.x)];
    rows[i] = mix(vec4(unpackHalf2x16(left.x), unpackHalf2x16(left.y)),
                  vec4(unpackHalf2x16(right.x), unpackHalf2x16(right.y)), at.weight.x);
  }
  return mix(rows[0], rows[1], at.weight.y);
}

// Returns color `number`. Colors stand behind the vertices of all meshes, two in the place of a vertex.
vec4 colorOf(uint number) {
  TraceVertex two = traceVertices[number >> 1];
  return (number & 1) == 0 ? vec4(two.position, two.u) : vec4(two.normal, two.v);
}

// Returns the alpha of the corners' colors.
vec3 alphasOf(uint instance, uint triangle, uint firstColor) {
  vec3 alphas;
  for (int i = 0; i < 3; ++i) {
    alphas[i] = colorOf(firstColor + traceFaces[traceInstances[instance].firstTriangle + triangle].vertices[i]).a;
  }
  return alphas;
}

// Says whether the triangle in a slot is there for a ray with this seed. Curved mirrors are.
bool meetsSurface(uint instance, uint slot, vec3 weights, vec3 origin, vec3 direction, uint seed) {
  uint coverage = triangleTexel(slot, 1).w;
  if (coverage == 0 || traceInstances[instance].curved != curvedNone) {
    return true;
  }
  MaterialData material = materials[coverage - 1];
  uint triangle = triangleTexel(slot, 0).w;
  float opacity = material.opacity;
  if (vertexAlpha && material.firstColor != noColors) {
    opacity *= dot(weights, alphasOf(instance, triangle, material.firstColor));
  }
  if (material.opacityTexture != noTexture) {
    vec2 uv = uvOf(instance, triangle, weights, origin, direction);
    opacity *= bilinearTraced(traceTextures[material.opacityTexture], uv, material.clamps != 0).a;
  }
  return isThere(opacity, material.cutoff, view.picture, seed, instance, triangle);
}

#ifdef RAY_QUERY
#include "trace_ray_query.glsl"
#else
vec4 meetSlot(uint slot, LocalRay ray, out uint triangle) {
  uvec4 a = triangleTexel(slot, 0);
  triangle = a.w;
  vec3 corners[3] = vec3[3](uintBitsToFloat(a.xyz), uintBitsToFloat(triangleTexel(slot, 1).xyz),
                            uintBitsToFloat(triangleTexel(slot, 2).xyz));
  return meetTriangle(corners, ray.origin, ray.along, ray.shear);
}

// Follows the ray through a mesh. In the loops here and below, each iteration sets or keeps the variables that hold the
// result: lavapipe of Mesa 22.3 changes others for pixels that have left a loop while their neighbours go on.
void traceMesh(uint instance, vec3 origin, vec3 direction, float near, Skip skip, bool any, uint seed,
               inout Hit hit) {
  vec4 rows[3] = meshRows(instance);
  vec3 meshOrigin = timesPoint(rows, origin);
  vec3 meshDirection = timesDirection(rows, direction);
  uvec4 low = instanceTexel(instance, 3);
  uvec4 scale = instanceTexel(instance, 4);
  vec3 gridScale = uintBitsToFloat(scale.xyz);
  LocalRay ray = localRay(meshOrigin, meshDirection);
  float reach = reachOf(meshOrigin, rows);
  BoxRay boxes = boxRay((meshOrigin - uintBitsToFloat(low.xyz)) * gridScale, meshDirection * gridScale, 0.05);
  uint node = low.w + boxes.octant * scale.w;
  uint last = node + scale.w;
  for (;;) {
    uint leaf = 0;
    for (;;) {
      uvec4 box = texelFetch(traceNodes, int(node));
      bool meets = meetsBox(vec3(ivec3(box.xyz & 0xffffu)), vec3(ivec3(box.xyz >> 16)), boxes, hit.t);
      bool isLeaf = (box.w & traceLeaf) != 0;
      node = meets || isLeaf ? node + 1 : box.w;
      leaf = meets && isLeaf ? box.w : leaf;
      if (leaf != 0 || node == last) {
        break;
      }
    }
    uint slot = (leaf & ~traceLeaf) >> 3;
    uint end = slot + (leaf & 7);
    for (;;) {
      uint triangle;
      vec4 met = meetSlot(slot, ray, triangle);
      bool own = (met.w < near && liesInPlane(meshOrigin, reach, slot)) ||
                 (instance == skip.instance && triangle == skip.triangle);
      // Where surfaces coincide, the ray meets the instance that is listed first.
      bool first = met.w < hit.t || (met.w == hit.t && instance < hit.instance);
      bool meets = slot < end && met.w > 0.0 && first && !own;
      if (transparency && meets) {
        meets = meetsSurface(instance, slot, met.xyz, origin, direction, seed);
      }
      if (meets) {
        hit.t = met.w;
        hit.instance = instance;
        hit.slot = slot;
        hit.mirror = none;
      }
      ++slot;
      if (slot >= end) {
        break;
      }
    }
    if (node == last || (any && hit.instance != none)) {
      break;
    }
  }
}

// Finds the first surface that a reflected ray in trace space meets before tMax; with `any`, one of those that a ray to
// a light meets. `seed` decides which surfaces with coverage are there.
Hit traceRay(vec3 origin, vec3 direction, float tMax, Skip skip, bool any, uint seed) {
  Hit hit = Hit(tMax, none, 0, vec3(0.0), none);
  if (traceCounts.topNodes == 0) {
    return hit;
  }
  float near = skip.near / max(length(direction), 1e-30);
  BoxRay boxes = boxRay(origin, direction, 0.0);
  uint node = boxes.octant * traceCounts.topNodes;
  uint last = node + traceCounts.topNodes;
  for (;;) {
    uint item = 0;
    for (;;) {
      uvec4 box = texelFetch(traceTopNodes, int(2 * node));
      vec3 far = uintBitsToFloat(texelFetch(traceTopNodes, int(2 * node + 1)).xyz);
      bool meets = meetsBox(uintBitsToFloat(box.xyz), far, boxes, hit.t);
      bool isLeaf = (box.w & traceLeaf) != 0;
      node = meets || isLeaf ? node + 1 : box.w;
      item = meets && isLeaf ? box.w : item;
      if (item != 0 || node == last) {
        break;
      }
    }
    uint index = item & ~(traceLeaf | itemMirror | itemUnreflected);
    if ((item & itemMirror) != 0) {
      uint plane = planeOf(index);
      if (plane != skip.plane && plane != skip.secondPlane) {
        float t = meetMirror(index, origin, direction);
        if (t > 0.0 && covers(index, t, hit.mirror, hit.t, direction)) {
          hit.t = t;
          hit.instance = none;
          hit.mirror = index;
        }
      }
    } else if (item != 0 && (any || (item & itemUnreflected) == 0)) {
      traceMesh(index, origin, direction, near, skip, any, seed, hit);
    }
    if (node == last || (any && (hit.instance != none || hit.mirror != none))) {
      break;
    }
  }
  if (!any && hit.instance != none) {
    vec4 rows[3] = meshRows(hit.instance);
    uint triangle;
    LocalRay ray = localRay(timesPoint(rows, origin), timesDirection(rows, direction));
    hit.weights = meetSlot(hit.slot, ray, triangle).xyz;
  }
  return hit;
}
#endif
