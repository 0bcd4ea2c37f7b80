// Deferred shading: computes the radiance of the surfaces that collect_surfaces.glsl listed, with rays. With ASKS, shadow
// maps decide most light.
#define COMPUTE
#include "interface.glsl"
#include "shading.glsl"
#include "identifiers.glsl"
#define SHADED_SET 1
#define SHADED_ACCESS
#include "shaded.glsl"
#include "requests.glsl"
#include "mirror_plane.glsl"
#include "sample_positions.glsl"
#include "coverage.glsl"
#include "trace.glsl"
#ifdef ASKS
#include "shadow_map.glsl"
#endif
#include "traced_light.glsl"
#include "microfacet.glsl"
#include "traced_path.glsl"

layout(local_size_x = requestsPerGroup) in;

layout(set = 1, binding = 3, std430) readonly buffer Mirrors { MirrorBlock mirrorBlocks[]; };

// A triangle's vertices, relative.
struct Corners {
  vec3 a;
  vec3 b;
  vec3 c;
};

vec3 relativeVertex(uint index, uint triangle, uint corner) {
  return timesPoint(instances[index].relativeFromMesh,
                    vertexOf(instances[index].traceInstance, triangle, corner).position);
}

// Returns the factor that gives a triangle near `point` the size of 1, so that no area leaves the range of floats.
float unitScale(vec3 point, Corners corners) {
  float size = max(largestComponent(corners.a - point),
                   max(largestComponent(corners.b - point), largestComponent(corners.c - point)));
  return 1.0 / max(size, 1e-30);
}

// Returns the triangle's normal, of any length.
vec3 normalOf(Corners corners) {
  float scale = unitScale(corners.a, corners);
  return cross((corners.b - corners.a) * scale, (corners.c - corners.a) * scale);
}

// Returns the point of the line of sight that is near the triangle's plane and not beyond the triangle. `known` is a
// point of the plane; the nearer it is to the result, the more exact is that.
vec3 pointAhead(vec3 sight, vec3 known, Corners corners) {
  vec3 normal = normalOf(corners);
  float farthest = sqrt(max(dot(corners.a, corners.a), max(dot(corners.b, corners.b), dot(corners.c, corners.c))));
  float t = dot(normal, known) / dot(normal, sight);
  return sight * (t >= 0.0 && t <= farthest ? t : farthest);
}

// Returns the weights of the corners where the line of sight through `point` meets the triangle's plane.
vec3 weightsAt(vec3 point, Corners corners) {
  LocalRay sight = localRay(point, point);
  float scale = unitScale(point, corners);
  vec3 a = permuted((corners.a - point) * scale, sight.along);
  vec3 b = permuted((corners.b - point) * scale, sight.along);
  vec3 c = permuted((corners.c - point) * scale, sight.along);
  a.xy -= sight.shear.xy * a.z;
  b.xy -= sight.shear.xy * b.z;
  c.xy -= sight.shear.xy * c.z;
  vec3 weights = vec3(c.x * b.y - c.y * b.x, a.x * c.y - a.y * c.x, b.x * a.y - b.y * a.x);
  float area = weights.x + weights.y + weights.z;
  return abs(area) < 1e-30 ? vec3(1.0, 0.0, 0.0) : weights / area;
}

// Moves weights of a point in the triangle's plane onto the triangle: a pixel that the triangle covers in part may look
// past it.
vec3 onTriangle(vec3 weights) {
  weights = max(weights, vec3(0.0));
  return weights / (weights.x + weights.y + weights.z);
}

// Says whether a point that weights give lies so far beside the line of sight that rounding of the weights is the
// reason, as in a triangle that is much longer than wide. A pixel may look past the triangle: then the point belongs
// beside the line of sight.
bool strays(vec3 point, vec3 sight, vec3 onPlane, Corners corners) {
  const float farBeside = 1e-5;  // of the distance; a pixel is some hundred times wider
  float rounding = 1e-6 / max(length(normalOf(corners)), 1e-12);
  vec3 beside = point - sight * dot(sight, point);
  return all(greaterThan(onPlane, vec3(-rounding))) &&
         dot(beside, beside) > farBeside * farBeside * dot(point, point);
}

// Returns how the weights change if their point is moved along the triangle's longest edge.
vec3 weightsOf(vec3 movement, Corners corners) {
  vec3 ab = corners.b - corners.a;
  vec3 bc = corners.c - corners.b;
  vec3 ca = corners.a - corners.c;
  vec3 squares = vec3(dot(ab, ab), dot(bc, bc), dot(ca, ca));
  if (squares.x >= max(squares.y, squares.z)) {
    return vec3(-1.0, 1.0, 0.0) * (dot(movement, ab) / squares.x);
  }
  return squares.y >= squares.z ? vec3(0.0, -1.0, 1.0) * (dot(movement, bc) / squares.y)
                                : vec3(1.0, 0.0, -1.0) * (dot(movement, ca) / squares.z);
}

// A surface as a pixel sees it.
struct Seen {
  Bounce bounce;
  vec3 direction;  // unit, towards the surface
  float disparity;
  uint seed;
  Draws draws;
};

Seen seenObject(Identifier id, vec2 position) {
  Corners corners = Corners(relativeVertex(id.index, id.triangle, 0), relativeVertex(id.index, id.triangle, 1),
                            relativeVertex(id.index, id.triangle, 2));
  vec3 sight = safeNormalize(rayThrough(position));
  vec3 point = pointAhead(sight, corners.a, corners);
  vec3 onPlane = weightsAt(point, corners);
  vec3 w = onTriangle(onPlane);
  Weights weights = Weights(w, vec3(0.0), vec3(0.0));
  if (textureFilter == textureTrilinear || textureFilter == textureAnisotropic) {
    float ahead = length(point);
    weights.across = weightsAt(ahead * safeNormalize(rayThrough(position + vec2(1.0, 0.0))), corners) - onPlane;
    weights.down = weightsAt(ahead * safeNormalize(rayThrough(position + vec2(0.0, 1.0))), corners) - onPlane;
  }
  point += w.x * (corners.a - point) + w.y * (corners.b - point) + w.z * (corners.c - point);
  if (strays(point, sight, onPlane, corners)) {
    vec3 seen = pointAhead(sight, point, corners);
    weights.here += weightsOf(seen - point, corners);
    point = seen;
  }
  vec3 direction = safeNormalize(point);
  Bounce bounce = objectBounce(instances[id.index].traceInstance, id.triangle, weights, point, direction,
                               view.traceOffset.xyz, sight);
  float depth = (view.clipFromRelative * vec4(point, 1.0)).w;
  float disparity = id.baseOnly ? reflectionMark(id) : disparityLength / max(depth, 1e-30);
  return Seen(bounce, direction, disparity, seedAt(position), Draws(view.picture, 1, 0, 1));
}

Seen seenMirror(Identifier id, vec2 position, uint firstSample) {
  MirrorData mirror = mirrorBlocks[id.index].mirror;
  PlaneHit hit = planeHit(mirror.normal, mirror.eyeDistance, rayThrough(position));
  // The CPU turned the normal to the eye in double; near the horizon the ray does not determine the side in float.
  bool front = dot(traceMirrors[mirror.traceMirror].normal, mirror.normal) > 0.0;
  vec3 direction = safeNormalize(hit.ray);
  Seen seen;
  // Ripples tilt the base if they displace the reflection that is added to it.
  bool ripples = !id.baseOnly || mirror.showsRipples != 0;
  seen.bounce = mirrorBounce(mirror.traceMirror, hit.position + view.traceOffset.xyz, direction, front, ripples);
  seen.bounce.alpha = id.baseOnly ? 0.0 : seen.bounce.alpha;
  seen.direction = direction;
  seen.disparity = id.baseOnly && seen.bounce.reflects ? 0.0 : hit.disparity;  // the reflection adds its own
  seen.seed = seedAt(position);
  seen.draws = Draws(view.picture, 1, 0, 1);
  if (seen.bounce.alpha > 0.0 && seen.bounce.reflects && !id.baseOnly) {
    // The samples share the pixel's points, so that many samples and few are equally smooth.
    seen.seed = seedAt(floor(position) + 0.5);
    uint wanted = (traceCounts.roughSamples + samples - 1) / samples;
    // A mirror's edge leaves out some samples of a pixel, so each sample takes another share in each block of pixels.
    // In one block all pixels agree, and their rays take the same branches.
    uint turn = seedAt(floor(position / 8.0)) + view.picture;
    seen.draws = Draws(view.picture, int(wanted), int((firstSample + turn) % samples), int(samples));
  }
  return seen;
}

void shade(uint pixel, uint seenBy) {
  uint first = uint(findLSB(seenBy));
  uvec2 bits = shaded[sampleNumber(pixel, first)];
  Identifier id = decoded(vec4(unpackHalf2x16(bits.x), unpackHalf2x16(bits.y)));
  vec2 corner = vec2(area.corner + ivec2(pixel % area.size.x, pixel / area.size.x));
  vec2 position = corner + meanPosition(samples, seenBy);
  Seen seen;
  if (id.mirror) {
    seen = seenMirror(id, position, first);
  } else {
    seen = seenObject(id, position);
  }
  bool addsReflection = id.baseOnly && seen.bounce.reflects;
  vec3 share = addsReflection ? 1.0 - seen.bounce.reflectance : vec3(1.0);
  seen.bounce.reflects = seen.bounce.reflects && !id.baseOnly;
#ifdef ASKS
  receiver = seen.bounce.surface.position;
  receiverNormal = seen.bounce.planeNormal;
#endif
  vec3 radiance = tracedRadiance(seen.bounce, seen.direction, seen.seed, seen.draws);
  vec3 stored = addsReflection ? sumFactor(position) * share * min(radiance, shareMax) : radiance;
  vec4 value = storable(stored, max(seen.disparity, 0.0), position);
  value.a = seen.disparity < 0.0 ? seen.disparity : value.a;
  uvec2 halfs = uvec2(packHalf2x16(value.rg), packHalf2x16(value.ba));
  for (uint i = 0; i < samples; ++i) {
    if ((seenBy & 1 << i) != 0) {
      shaded[sampleNumber(pixel, i)] = halfs;
    }
  }
}

void main() {
  if (gl_GlobalInvocationID.x < requestCount) {
    uint request = requests[gl_GlobalInvocationID.x];
    shade(request >> samples, request & ((1 << samples) - 1));
  }
}
