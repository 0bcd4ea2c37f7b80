// traceRay() by ray queries, with the device's hierarchies. Rays ignore the same surfaces and meet mirrors in the same
// way as in trace.glsl.

layout(set = 2, binding = 13) uniform accelerationStructureEXT traceStructure;

bool ignores(Skip skip, uint instance, uint slot, float t, float near, vec3 origin) {
  if (t < near) {
    vec4 rows[3] = meshRows(instance);
    vec3 start = timesPoint(rows, origin);
    if (liesInPlane(start, reachOf(start, rows), slot)) {
      return true;
    }
  }
  return instance == skip.instance && triangleTexel(slot, 0).w == skip.triangle;
}

// Finds the first surface that a reflected ray in trace space meets before tMax; with `any`, one of those that a ray to
// a light meets. `seed` decides which surfaces with coverage are there.
Hit traceRay(vec3 origin, vec3 direction, float tMax, Skip skip, bool any, uint seed) {
  Hit hit = Hit(tMax, none, 0, vec3(0.0), none);
  vec3 size = abs(direction);
  float largest = max(size.x, max(size.y, size.z));
  if (!(largest > 0.0 && largest < infinity && tMax > 0.0)) {
    return hit;  // with these values a query would be undefined
  }
  float near = skip.near / max(length(direction), 1e-30);
  // Only a ray that starts on an object, or that may pass a surface, has to look at candidates.
  bool opaque = !transparency && skip.instance == none;
  uint flags = (any ? gl_RayFlagsTerminateOnFirstHitEXT : 0) | (opaque ? gl_RayFlagsOpaqueEXT : 0);
  rayQueryEXT query;
  rayQueryInitializeEXT(query, traceStructure, flags, any ? maskShadows : maskReflected, origin, 0.0, direction, tMax);
  while (rayQueryProceedEXT(query)) {
    uint index = rayQueryGetIntersectionInstanceCustomIndexEXT(query, false);
    if (rayQueryGetIntersectionTypeEXT(query, false) == gl_RayQueryCandidateIntersectionTriangleEXT) {
      uint slot = traceInstances[index].firstTriangle + rayQueryGetIntersectionPrimitiveIndexEXT(query, false);
      bool meets = !ignores(skip, index, slot, rayQueryGetIntersectionTEXT(query, false), near, origin);
      if (transparency && meets) {
        vec2 w = rayQueryGetIntersectionBarycentricsEXT(query, false);
        meets = meetsSurface(index, slot, vec3(1.0 - w.x - w.y, w), origin, direction, seed);
      }
      if (meets) {
        rayQueryConfirmIntersectionEXT(query);
      }
    } else if (planeOf(index) != skip.plane && planeOf(index) != skip.secondPlane) {
      float t = meetMirror(index, origin, direction);
      uint type = rayQueryGetIntersectionTypeEXT(query, true);
      float foundT = type == gl_RayQueryCommittedIntersectionNoneEXT ? tMax : rayQueryGetIntersectionTEXT(query, true);
      uint other = type == gl_RayQueryCommittedIntersectionGeneratedEXT
                       ? rayQueryGetIntersectionInstanceCustomIndexEXT(query, true)
                       : none;
      if (t > 0.0 && covers(index, t, other, foundT, direction)) {
        rayQueryGenerateIntersectionEXT(query, min(t, foundT));
      }
    }
  }
  uint found = rayQueryGetIntersectionTypeEXT(query, true);
  if (found == gl_RayQueryCommittedIntersectionNoneEXT) {
    return hit;
  }
  hit.t = rayQueryGetIntersectionTEXT(query, true);
  uint index = rayQueryGetIntersectionInstanceCustomIndexEXT(query, true);
  if (found == gl_RayQueryCommittedIntersectionGeneratedEXT) {
    hit.mirror = index;
    return hit;
  }
  vec2 weights = rayQueryGetIntersectionBarycentricsEXT(query, true);
  hit.instance = index;
  hit.slot = traceInstances[index].firstTriangle + rayQueryGetIntersectionPrimitiveIndexEXT(query, true);
  hit.weights = vec3(1.0 - weights.x - weights.y, weights);
  return hit;
}
