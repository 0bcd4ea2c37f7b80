// Rays through the scene: a hierarchy of boxes over instances and mirrors, and one over the triangles of each mesh.
// Needs interface.glsl and shading.glsl.

layout(set = 2, binding = 0, std430) readonly buffer TraceNodes { TraceNode traceNodes[]; };
layout(set = 2, binding = 1, std430) readonly buffer TraceTriangles { TraceTriangle traceTriangles[]; };
layout(set = 2, binding = 2, std430) readonly buffer TraceIndices { uint traceIndices[]; };
layout(set = 2, binding = 3, std430) readonly buffer TraceVertices { TraceVertex traceVertices[]; };
layout(set = 2, binding = 4, std430) readonly buffer TraceTextures { TraceTexture traceTextures[]; };
layout(set = 2, binding = 5, std430) readonly buffer TraceTexels { uvec2 traceTexels[]; };      // rgba, half floats
layout(set = 2, binding = 6, std430) readonly buffer TraceTopNodes { TraceNode traceTopNodes[]; };
layout(set = 2, binding = 7, std430) readonly buffer TraceItems { uint traceItems[]; };  // instance, or mirror + itemMirror
layout(set = 2, binding = 8, std430) readonly buffer TraceInstances { TraceInstance traceInstances[]; };
layout(set = 2, binding = 9, std430) readonly buffer TraceMirrors { TraceMirror traceMirrors[]; };
layout(set = 2, binding = 10, std430) readonly buffer TraceMirrorVertices { vec2 traceMirrorVertices[]; };  // local x, y
layout(set = 2, binding = 11, std430) readonly buffer LightPaths {
  TraceCounts traceCounts;
  LightPath lightPaths[];
};

// Entries of the stack: the depth of both hierarchies together.
layout(constant_id = 2) const uint traceStackSize = 64;

TraceVertex vertexOf(uint instance, uint triangle, uint corner) {
  uint index = 3 * (traceInstances[instance].firstTriangle + triangle) + corner;
  return traceVertices[traceInstances[instance].firstVertex + traceIndices[index]];
}

const uint none = 0xffffffffu;
const float infinity = 1e38;

// Surfaces that a ray ignores: the one it starts on, and the mirror that it ends on.
struct Skip {
  uint instance;
  uint triangle;
  uint mirror;
  uint secondMirror;
  float near;  // metres from the origin within which the rest of the instance is ignored too
};

// Returns Skip::near for a point. Where triangles meet, rounding may put the point inside the object: by some 1e-7 of
// its distance from the eye, and more along a ray that leaves at grazing angle.
float nearOf(vec3 position) { return 2e-5 * length(position); }

struct Hit {
  float t;
  uint instance;  // `none`: not an object
  uint slot;      // of its triangle in traceTriangles
  vec3 weights;
  uint mirror;  // `none`: not a mirror
};

uint stackNodes[traceStackSize];
float stackDistances[traceStackSize];

// Never misses because of rounding: Ize, "Robust BVH Ray Traversal" (2013).
float enterBox(TraceNode node, vec3 origin, vec3 inverse, float tMax) {
  vec3 a = (node.low - origin) * inverse;
  vec3 b = (node.high - origin) * inverse;
  vec3 low = min(a, b);
  vec3 high = max(a, b);
  float near = max(max(low.x, low.y), max(low.z, 0.0));
  float far = min(min(high.x, high.y), min(high.z, tMax));
  return near <= far * (1.0 + 5e-7) ? near : infinity;
}

// A component of zero would give 0 * infinity, which is not a number.
vec3 safeInverse(vec3 d) {
  return 1.0 / vec3(abs(d.x) < 1e-25 ? 1e-25 : d.x, abs(d.y) < 1e-25 ? 1e-25 : d.y, abs(d.z) < 1e-25 ? 1e-25 : d.z);
}

vec3 permuted(vec3 p, uint along) { return along == 2 ? p.xyz : along == 0 ? p.yzx : p.zxy; }

// Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection" (2013): neighbours evaluate a shared edge with the same
// numbers. Weights of a, b, c in xyz, the parameter of the ray in w; below zero: no hit.
vec4 meetTriangle(TraceTriangle triangle, vec3 origin, uint along, vec3 shear) {
  vec3 a = permuted(triangle.a - origin, along);
  vec3 b = permuted(triangle.b - origin, along);
  vec3 c = permuted(triangle.c - origin, along);
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

// Returns the parameter at which the ray meets the mirror's polygon, from either side; below zero if it does not.
float meetMirror(uint mirror, vec3 origin, vec3 direction) {
  vec3 fromMirror = origin - traceMirrors[mirror].origin;
  vec3 normal = traceMirrors[mirror].normal;
  float towards = dot(normal, direction);
  float t = -dot(normal, fromMirror) / (abs(towards) < 1e-30 ? 1e-30 : towards);
  vec3 p = fromMirror + t * direction;
  vec2 local = vec2(dot(p, traceMirrors[mirror].axisX), dot(p, traceMirrors[mirror].axisY));
  uint first = traceMirrors[mirror].firstVertex;
  uint count = traceMirrors[mirror].vertexCount;
  vec2 from = traceMirrorVertices[first + count - 1];
  for (uint i = 0; i < count; ++i) {
    vec2 to = traceMirrorVertices[first + i];
    vec2 edge = to - from;
    if (edge.x * (local.y - from.y) - edge.y * (local.x - from.x) < 0.0) {
      return -1.0;
    }
    from = to;
  }
  return t;
}

// A ray in the space of one hierarchy.
struct LocalRay {
  vec3 origin;
  vec3 inverse;
  uint along;  // axis of its largest component
  vec3 shear;
};

LocalRay localRay(vec3 origin, vec3 direction) {
  vec3 size = abs(direction);
  uint along = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  vec3 d = permuted(direction, along);
  return LocalRay(origin, safeInverse(direction), along, vec3(d.xy / d.z, 1.0 / d.z));
}

LocalRay meshRay(uint instance, vec3 origin, vec3 direction) {
  vec4 rows[3] = traceInstances[instance].meshFromTrace;
  return localRay(timesPoint(rows, origin), timesDirection(rows, direction));
}

#ifdef RAY_QUERY
#include "trace_ray_query.glsl"
#else
// Finds the first surface that the ray meets before tMax, or with `any` one of them. In trace space.
Hit traceRay(vec3 origin, vec3 direction, float tMax, Skip skip, bool any) {
  Hit hit = Hit(tMax, none, 0, vec3(0.0), none);
  if (traceCounts.items == 0) {
    return hit;
  }
  LocalRay ray = localRay(origin, direction);
  float near = skip.near / max(length(direction), 1e-30);
  uint instance = none;  // instance whose mesh is searched; none: the top hierarchy
  uint used = 0;
  uint base = 0;  // entries of the stack that belong to the top
  uint current = 0;
  float enter = 0.0;
  for (;;) {
    if (enter < hit.t) {
      TraceNode node;
      if (instance == none) {
        node = traceTopNodes[current];
      } else {
        node = traceNodes[current];
      }
      if (node.count == 0) {
        uint left = node.first;
        uint right = node.first + 1;
        float leftEnter;
        float rightEnter;
        if (instance == none) {
          leftEnter = enterBox(traceTopNodes[left], ray.origin, ray.inverse, hit.t);
          rightEnter = enterBox(traceTopNodes[right], ray.origin, ray.inverse, hit.t);
        } else {
          leftEnter = enterBox(traceNodes[left], ray.origin, ray.inverse, hit.t);
          rightEnter = enterBox(traceNodes[right], ray.origin, ray.inverse, hit.t);
        }
        bool swap = rightEnter < leftEnter;
        float later = swap ? leftEnter : rightEnter;
        if (later < infinity) {
          stackNodes[used] = swap ? left : right;
          stackDistances[used] = later;
          ++used;
        }
        current = swap ? right : left;
        enter = swap ? rightEnter : leftEnter;
        continue;
      }
      if (instance == none) {
        uint item = traceItems[node.first];
        if ((item & itemMirror) == 0) {
          instance = item;
          ray = meshRay(instance, origin, direction);
          base = used;
          current = traceInstances[instance].root;
          continue;
        }
        uint mirror = item & ~itemMirror;
        if (mirror != skip.mirror && mirror != skip.secondMirror) {
          float t = meetMirror(mirror, origin, direction);
          if (t > 0.0 && t < hit.t) {
            hit = Hit(t, none, 0, vec3(0.0), mirror);
          }
        }
      } else {
        for (uint i = node.first; i < node.first + node.count; ++i) {
          vec4 met = meetTriangle(traceTriangles[i], ray.origin, ray.along, ray.shear);
          bool own = instance == skip.instance && (traceTriangles[i].triangle == skip.triangle || met.w < near);
          if (met.w > 0.0 && met.w < hit.t && !own) {
            hit = Hit(met.w, instance, i, met.xyz, none);
          }
        }
      }
      if (any && (hit.instance != none || hit.mirror != none)) {
        return hit;
      }
    }
    if (used == base && instance != none) {
      instance = none;
      base = 0;
      ray = localRay(origin, direction);
    }
    if (used == 0) {
      return hit;
    }
    --used;
    current = stackNodes[used];
    enter = stackDistances[used];
  }
}
#endif
