// The fragment shader of objects. TRACED adds light that needs rays; CURVED draws objects that are mirrors; ENVIRONMENT
// draws those that look up a map.
#include "interface.glsl"
#include "shading.glsl"
#ifdef TRACED
#include "trace.glsl"
#include "traced_light.glsl"
#endif
#ifdef CURVED
#include "microfacet.glsl"
#include "traced_path.glsl"
#endif

layout(constant_id = 0) const uint diffuseLookup = textureNone;
layout(constant_id = 1) const bool glossy = true;  // the specular color is not black

layout(set = 1, binding = 0) uniform sampler2D diffuseTexture;  // linear radiance factors; with ENVIRONMENT the map

layout(location = 0) centroid in vec3 relativePosition;
layout(location = 1) centroid in vec3 relativeNormal;
layout(location = 2) centroid in vec2 textureUv;
layout(location = 3) flat in uint instanceIndex;

layout(location = 0) out vec4 color;

vec3 bilinearLevel0(vec2 uv) {
  BilinearTexels at = bilinearTexels(uv, textureSize(diffuseTexture, 0));
  vec3 a = texelFetch(diffuseTexture, at.low, 0).rgb;
  vec3 b = texelFetch(diffuseTexture, ivec2(at.high.x, at.low.y), 0).rgb;
  vec3 c = texelFetch(diffuseTexture, ivec2(at.low.x, at.high.y), 0).rgb;
  vec3 d = texelFetch(diffuseTexture, at.high, 0).rgb;
  return mix(mix(a, b, at.weight.x), mix(c, d, at.weight.x), at.weight.y);
}

vec3 diffuseFactor() {
  return diffuseLookup == textureTrilinear ? texture(diffuseTexture, vec2(textureUv.x, 1.0 - textureUv.y)).rgb
                                           : bilinearLevel0(textureUv);
}

#ifdef ENVIRONMENT
#include "environment.glsl"
#endif

#ifdef TRACED
// A triangle's vertices, relative.
struct Corners {
  vec3 a;
  vec3 b;
  vec3 c;
};

// Returns the weights of the corners at the point of the triangle that is nearest to the line of sight through `point`.
vec3 weightsOnTriangle(vec3 point, Corners corners) {
  LocalRay sight = localRay(point, point);
  vec3 a = permuted(corners.a - point, sight.along);
  vec3 b = permuted(corners.b - point, sight.along);
  vec3 c = permuted(corners.c - point, sight.along);
  a.xy -= sight.shear.xy * a.z;
  b.xy -= sight.shear.xy * b.z;
  c.xy -= sight.shear.xy * c.z;
  vec3 weights = vec3(c.x * b.y - c.y * b.x, a.x * c.y - a.y * c.x, b.x * a.y - b.y * a.x);
  float area = weights.x + weights.y + weights.z;
  weights = abs(area) < 1e-30 ? vec3(1.0, 0.0, 0.0) : max(weights / area, vec3(0.0));
  return weights / (weights.x + weights.y + weights.z);
}

vec3 relativeVertex(uint instance, uint triangle, uint corner) {
  return timesPoint(instances[instanceIndex].relativeFromMesh, vertexOf(instance, triangle, corner).position);
}

// Moves the surface onto the triangle. At a pixel that the triangle covers in part, an interpolated position lies
// beside the triangle, and with some drivers off its plane, so that rays would start inside the object.
void moveOnTriangle(uint instance, uint triangle, bool front, inout Surface surface) {
  Corners corners = Corners(relativeVertex(instance, triangle, 0), relativeVertex(instance, triangle, 1),
                            relativeVertex(instance, triangle, 2));
  vec3 point = relativePosition;
  if (perSample) {
    point = safeNormalize(rayThrough(gl_FragCoord.xy)) * length(relativePosition);
  }
  vec3 w = weightsOnTriangle(point, corners);
  surface.position = point + w.x * (corners.a - point) + w.y * (corners.b - point) + w.z * (corners.c - point);
  if (perSample) {
    vec3 normal = w.x * vertexOf(instance, triangle, 0).normal + w.y * vertexOf(instance, triangle, 1).normal +
                  w.z * vertexOf(instance, triangle, 2).normal;
    normal = timesDirection(instances[instanceIndex].normalFromMesh, normal);
    surface.normal = safeNormalize(front ? normal : -normal);
  }
}
#endif

void main() {
  // The side that faces the viewer is lit, by the winding in the model file. gl_FrontFacing already follows the view's
  // handedness; the sign of the instance's determinant corrects it for mirrored instances.
  bool front = gl_FrontFacing == (draw.handedness > 0.0);
  Surface surface = Surface(relativePosition, safeNormalize(front ? relativeNormal : -relativeNormal), draw.diffuse,
                            glossy ? draw.specular : vec3(0.0), draw.emission, draw.shininess, glossy);
#ifndef ENVIRONMENT
  if (diffuseLookup != textureNone) {
    surface.diffuse *= diffuseFactor();
  }
#endif
#ifdef SHADOW_MAPS
  setReceiver(relativePosition, surface.normal);
#endif
#ifdef TRACED
  uint traceInstance = instances[instanceIndex].traceInstance;
  Skip self = Skip(traceInstance, draw.firstTriangle + uint(gl_PrimitiveID), none, none,
                   nearOf(relativePosition));
#ifndef CURVED
  if (shadows)
#endif
    moveOnTriangle(traceInstance, self.triangle, front, surface);
#endif
#ifdef CURVED
  vec3 direction = safeNormalize(surface.position);
  vec3 geometric = facetNormal(traceInstance, self.triangle);
  geometric = dot(geometric, direction) > 0.0 ? -geometric : geometric;
  Bounce bounce = Bounce(surface, self, true, geometric, vec3(0.0), 0.0);
  applyCurvedMirror(traceInstance, direction, bounce);
  vec3 radiance = tracedRadiance(bounce, direction, seedAt(gl_FragCoord.xy), view.picture, 1);
#elif defined(ENVIRONMENT)
  EnvironmentData map = environments[instances[instanceIndex].environment];
  vec3 direction = safeNormalize(surface.position);
  surface = mirrorLayer(surface.position, surface.normal, map.baseColor);
  float cosine = -dot(surface.normal, direction);
  vec3 reflectance = reflectanceAt(map.reflectance, map.schlick, cosine);
  vec3 layer = vec3(0.0);
  if (any(greaterThan(surface.diffuse, vec3(0.0)))) {
#ifdef TRACED
    layer = tracedSurfaceRadiance(surface, -direction, self);
#else
    layer = surfaceRadiance(surface);
#endif
  }
  vec3 radiance = (1.0 - reflectance) * layer +
                  reflectance * environmentRadiance(map, surface, direction, reflectance);
#elif defined(TRACED)
  vec3 radiance = tracedSurfaceRadiance(surface, safeNormalize(-surface.position), self);
#else
  vec3 radiance = surfaceRadiance(surface);
#endif
  // gl_FragCoord.w would be that of the pixel's centre, which on a steep triangle may lie far from the shaded point.
  float w = (view.clipFromRelative * vec4(relativePosition, 1.0)).w;
  color = storable(radiance, disparityLength / max(w, 1e-30));
}
