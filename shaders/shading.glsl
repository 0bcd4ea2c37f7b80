// Radiance of a surface and of the background, as docs/picture.md defines them. Needs interface.glsl.
#extension GL_EXT_control_flow_attributes : require
#include "encoding.glsl"
#include "half_float.glsl"

// The value of view.lightCount, if it is at most fixedLights.
layout(constant_id = constantLightCount) const uint lightCount = manyLights;

// The device leaves out code that a branch passes over. lavapipe runs both sides of a branch.
layout(constant_id = constantBranches) const bool branches = false;

#ifdef HANDS_ON
vec3 ambientRadiance() { return handedAmbient.rgb; }
float exposure() { return handedAmbient.w; }
LightData passLight(uint i) {
  LightData light = passLights[i];
  if (i < handedLights) {
    light.position = handedPosition[i].xyz;
    light.radius = handedPosition[i].w;
    light.irradiance = handedIrradiance[i];
  }
  return light;
}
#else
vec3 ambientRadiance() { return view.ambient; }
float exposure() { return view.horizon.w; }
LightData passLight(uint i) { return passLights[i]; }
#endif

const float pi = 3.14159265358979;
const float halfMax = 65504.0;
const float halfLeast = 6e-8;  // the least half float above 0
const float radianceMax = 1e30;  // sums stay finite, and unlike infinity it gives 0 if multiplied by 0
const float shareMax = 65472.0;  // largest value of a base or a reflection: the sum of two rounds to halfMax at most

struct Surface {
  vec3 position;  // relative
  vec3 normal;    // unit, towards the viewer's side
  vec3 diffuse;
  vec3 specular;
  vec3 emission;
  float shininess;
  bool glossy;  // the specular color is not black
  float reach;  // metres: largest length in what the position was computed from
};

#ifdef COMPUTE
// Says whether the invocation's result is not needed. Always false here, but no compiler can know that.
bool isUnneeded() { return gl_LocalInvocationIndex > 0xffff; }
#else
bool isUnneeded() { return gl_HelperInvocation; }
#endif

// A branch or a loop that depends on uniform values alone makes lavapipe of Mesa 22.3 compile a large shader again for
// each draw and keep it. Values are chosen with mix() instead, and loops end at countHere(), which is not uniform
// because it depends on the invocation. Helper invocations need no light.
uint countHere(uint count) { return isUnneeded() ? 0 : count; }

vec3 safeNormalize(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-37)); }

// Products of a matrix that is given by its rows with a point and with a direction.
vec3 timesPoint(vec4 rows[3], vec3 p) {
  return vec3(dot(rows[0], vec4(p, 1.0)), dot(rows[1], vec4(p, 1.0)), dot(rows[2], vec4(p, 1.0)));
}
vec3 timesDirection(vec4 rows[3], vec3 d) { return vec3(dot(rows[0].xyz, d), dot(rows[1].xyz, d), dot(rows[2].xyz, d)); }

// The lookups that anisotropic filtering averages, along the longer side of a pixel's footprint: Vulkan specification,
// "Texel Anisotropic Filtering".
struct Footprint {
  vec2 major;   // the longer side, in texture coordinates
  float count;  // of lookups
};

// `across` and `down` are the steps of texture coordinates from pixel to pixel, `size` the texture's in texels.
Footprint footprintOf(vec2 across, vec2 down, vec2 size) {
  bool along = length(across * size) > length(down * size);
  vec2 major = along ? across : down;
  float minor = length((along ? down : across) * size);
  return Footprint(major, min(max(1.0, ceil(length(major * size) / max(1.0, minor))), float(mostAnisotropy)));
}

// Returns where lookup i = 1 .. count lies, from the footprint's middle.
vec2 partOf(Footprint footprint, float i) { return footprint.major * (i / (footprint.count + 1.0) - 0.5); }

// The four texels that a bilinear lookup mixes, in a texture that repeats or clamps, with v upwards. A sampler's weights may
// have only 8 bits, which shows where texels differ much.
struct BilinearTexels {
  ivec2 low;
  ivec2 high;
  vec2 weight;
};

BilinearTexels bilinearTexels(vec2 uv, ivec2 size, bool clamped) {
  vec2 place = vec2(uv.x, 1.0 - uv.y);
  vec2 texel = clamped ? clamp(place * vec2(size), vec2(0.5), vec2(size) - 0.5) - 0.5 : fract(place) * vec2(size) - 0.5;
  vec2 corner = floor(texel);
  // Integer divisions cost lavapipe more than the rest of the lookup.
  ivec2 low = ivec2(corner);
  low += size * ivec2(lessThan(low, ivec2(0)));
  ivec2 high = low + 1;
  return BilinearTexels(low, high - size * ivec2(equal(high, size)), texel - corner);
}

// Returns the color of a texture's first level, interpolated bilinearly.
vec3 bilinearColor(sampler2D image, vec2 uv, bool clamped) {
  BilinearTexels at = bilinearTexels(uv, textureSize(image, 0), clamped);
  vec3 a = texelFetch(image, at.low, 0).rgb;
  vec3 b = texelFetch(image, ivec2(at.high.x, at.low.y), 0).rgb;
  vec3 c = texelFetch(image, ivec2(at.low.x, at.high.y), 0).rgb;
  vec3 d = texelFetch(image, at.high, 0).rgb;
  return mix(mix(a, b, at.weight.x), mix(c, d, at.weight.x), at.weight.y);
}

// Keeps the coordinates of a texture that does not repeat from mixing its opposite borders.
vec2 withinBorder(vec2 uv, vec2 size) { return clamp(uv, 0.5 / size, 1.0 - 0.5 / size); }

// Returns the texel of the first level that holds `uv`.
ivec2 nearestTexel(vec2 uv, ivec2 size, bool clamped) {
  vec2 place = vec2(uv.x, 1.0 - uv.y);
  return min(ivec2((clamped ? clamp(place, 0.0, 1.0) : fract(place)) * vec2(size)), size - 1);
}

// Largest height of a light above a surface that may be rounding, relative to the lengths from which the height is
// computed. A light so low counts as in the surface's plane, or its side would change from pixel to pixel.
const float leastHeight = 3e-7;

// Returns the texture coordinates where a line of sight in trace space meets the triangle's plane.
vec2 repeatingUv(uint index, vec3 origin, vec3 direction) {
  RepeatingTriangle at = repeatingTriangles[index];
  float height = dot(at.height.xyz, origin) + at.height.w;
  vec4 point = vec4(origin - direction * (height / dot(at.height.xyz, direction)), 1.0);
  return vec2(dot(at.u, point), dot(at.v, point));
}

// Says whether lightRadiance() is 0 for all lights of a group, because they lie below the surface's plane. The last term
// is what rounding may take away from the sum; leastHeight makes up for that of the light's height.
bool liesBelow(LightGroup group, Surface surface) {
  vec3 toCenter = group.center - surface.position;
  float above = dot(abs(surface.normal), group.halfExtent);
  return dot(surface.normal, toCenter) + above <= -1e-6 * dot(abs(toCenter), vec3(1.0));
}

// Returns the radiance due to a light at `toLight` from the surface; `irradiance` is at 1 m, facing the light.
vec3 lightRadiance(vec3 toLight, float radius, vec3 irradiance, Surface surface, vec3 toViewer) {
  float distance2 = max(dot(toLight, toLight), 1e-37);
  float inverse = inversesqrt(distance2);
  float height = dot(surface.normal, toLight);
  bool above = height > leastHeight * (surface.reach + distance2 * inverse);
  if (branches && height <= 0.0) {
    return vec3(0.0);
  }
  float cosine = above ? clamp(height * inverse, 0.0, 1.0) : 0.0;
  vec3 brdf = surface.diffuse / pi;
  if (surface.glossy) {
    // The half vector is l + toViewer; its cosine with the normal is squared, which takes no square root. Where the
    // viewer looks at the light, rounding leaves the half vector no direction.
    float along = max(cosine + dot(surface.normal, toViewer), 0.0);
    float length2 = max(2.0 + 2.0 * dot(toLight, toViewer) * inverse, 1e-5);
    float lobe2 = clamp(along * along / length2, 1e-12, 1.0);
    brdf += surface.specular * ((surface.shininess + 8.0) / (8.0 * pi) * pow(lobe2, 0.5 * surface.shininess));
  }
  // The bounds keep the falloff finite: infinity times a black channel of the surface would be NaN.
  float falloff = cosine / max(distance2, radius * radius);
  return min(irradiance * falloff, 1e30) * brdf;
}

vec3 lightRadiance(LightData light, Surface surface, vec3 toViewer) {
  return lightRadiance(light.position - surface.position, light.radius, light.irradiance, surface, toViewer);
}

// Limits radiance to radianceMax. Keeps NaN for debug.check_finite to find, which min() need not.
vec3 bounded(vec3 radiance) { return mix(radiance, vec3(radianceMax), greaterThan(radiance, vec3(radianceMax))); }

#ifdef SHADOW_MAPS
#include "shadow_map.glsl"
#else
float litShare(uint index, LightData light) { return 1.0; }
#endif

// Returns the radiance due to light `index` of the pass, with shadows.
vec3 litBy(uint index, LightData light, Surface surface, vec3 toViewer) {
  vec3 lit = lightRadiance(light, surface, toViewer);
  float share = litShare(index, light);
#if defined(SHADOW_MAPS) && defined(ASKS)
  asks = asks || (share == undecided && any(greaterThan(lit, vec3(0.0))));
#endif
  return share * lit;
}

vec3 surfaceRadiance(Surface surface) {
  vec3 toViewer = safeNormalize(-surface.position);
  vec3 radiance = surface.emission + ambientRadiance() * surface.diffuse;
  if (lightCount == manyLights) {
    uint count = countHere(view.lightCount);
    uint group = 0;
    for (uint first = 0; first < count; first += view.lightsPerGroup) {
      uint end = liesBelow(lightGroups[group++], surface) ? first : min(first + view.lightsPerGroup, count);
      for (uint i = first; i < end; ++i) {
        LightData light = lights[view.firstLight + i];
        radiance += litBy(i, light, surface, toViewer);
      }
    }
  } else {
    [[unroll]] for (uint i = 0; i < lightCount; ++i) {
      radiance += litBy(i, passLight(i), surface, toViewer);
    }
  }
  return bounded(radiance);
}

// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering" (1994).
vec3 schlick(vec3 reflectance, float cosine) {
  float grazing = 1.0 - clamp(cosine, 0.0, 1.0);
  float grazing2 = grazing * grazing;
  return reflectance + (1.0 - reflectance) * (grazing2 * grazing2 * grazing);
}

// Reflectance at an angle of incidence, from that at normal incidence.
vec3 reflectanceAt(vec3 reflectance, uint followsSchlick, float cosine) {
  return mix(reflectance, schlick(reflectance, cosine), bvec3(followsSchlick != 0));
}

// Says whether a bounce at this depth, after which `channels` of the light are left, shows the background only.
bool isLastBounce(uint depth, vec3 channels) {
  float through = max(channels.r, max(channels.g, channels.b));
  return depth >= view.maxDepth || through < view.minThroughput || through == 0.0;
}

// Mirrors the direction about m, and turns it back above the plane if it points below.
vec3 mirrored(vec3 direction, vec3 m, vec3 planeNormal) {
  vec3 d = direction - 2.0 * dot(direction, m) * m;
  float outward = dot(d, planeNormal);
  return safeNormalize(outward < 0.0 ? d - 2.0 * outward * planeNormal : d);
}

// The base of a mirror: the diffuse surface under its reflection, or its back.
Surface mirrorBase(vec3 position, vec3 normal, vec3 color, float reach) {
  return Surface(position, normal, color, vec3(0.0), vec3(0.0), 1.0, false, reach);
}

// The surface of an object, without its texture.
Surface objectSurface(vec3 position, vec3 normal, MaterialData material, MaterialChange change, float shininess,
                      float reach) {
  vec3 specular = change.replacesSpecular != 0 ? change.specular : material.specular;
  return Surface(position, normal, change.replacesDiffuse != 0 ? change.diffuse : material.diffuse, specular,
                 change.replacesEmission != 0 ? change.emission : material.emission,
                 shininess > 0.0 ? shininess : material.shininess, any(greaterThan(specular, vec3(0.0))), reach);
}

vec3 backgroundRadiance(vec3 direction) {
  float y = safeNormalize(direction).y;
  float away = y >= 0.0 ? sqrt(y) : min(1.0, -8.0 * y);
  // Some devices compute mix(a, b, x) as a + x (b - a), which loses b beside a very bright horizon.
  vec3 sky = (1.0 - away) * view.horizon.rgb + away * (y >= 0.0 ? view.zenith.rgb : view.ground.rgb);
  return bounded(mix(view.background, sky, bvec3(view.hasSky != 0)));
}

// Returns the value within the range of half floats: beyond it some drivers store infinity, and one such sample spoils a
// mean. `disparity` is disparityLength / w, by which cached images are reprojected. 0: the background is seen, directly
// or in a mirror. halfLeast: too far to store, or a mirror in an environment map that shows the background, which must
// not be replaced by the background behind the mirror.
vec4 inHalfRange(vec3 radiance, float disparity) {
  return clamp(vec4(radiance, disparity), vec4(0.0, 0.0, 0.0, disparity > 0.0 ? halfLeast : 0.0), vec4(halfMax));
}

// Puts back the NaN that clamp() hides, for debug.check_finite. NaN is found by its bits, because compilers may take
// isnan() for false.
vec4 keepingNan(vec4 stored, vec3 radiance, float disparity) {
  vec4 value = vec4(radiance, disparity);
  uint largest = view.checksFinite != 0 ? 0x7f800000u : 0x7fffffffu;
  return mix(stored, value, greaterThan(floatBitsToUint(value) & 0x7fffffffu, uvec4(largest)));
}

// Returns the value as a target stores it, whatever the device rounds to: the nearest half float. In the later pictures
// of a mean, radiance is moved by up to half a step before, because rounding that all pictures shared would stay in the
// mean. `pixel` is the position in the target. A pass that draws colors of the display encodes what would be stored, so
// that it shows what the display pass would. It draws no mean, and debug.check_finite is off.
vec4 storable(vec3 radiance, float disparity, vec2 pixel) {
  if (encoding != encodingNone) {
    return displayColor(exposure() * nearestHalf(inHalfRange(radiance, disparity), vec4(0.0)).rgb);
  }
  float part = view.rayOrigin.w * storeNoise(pixel, view.rayY.w);
  vec4 stored = nearestHalf(inHalfRange(radiance, disparity), vec4(part, part, part, 0.0));
  return keepingNan(stored, radiance, disparity);
}

// Factor on the base and on the reflection of a mirror that the device adds in the target. 1, unless the device rounds
// sums down (Renderer::roundsSumsDown()): then, on the mean over sums, as much more as rounding takes away.
float sumFactor(vec2 pixel) {
  return 1.0 + view.zenith.w * (0.5 + view.rayOrigin.w * storeNoise(pixel.yx, 7.0 * view.rayY.w));
}

// Returns a reflection that the device adds to a base. It is not rounded where the device rounds the sum down, because
// sumFactor() takes the digits of the sum for random.
vec4 addable(vec3 radiance, float disparity, vec2 pixel) {
  vec4 value = inHalfRange(radiance * sumFactor(pixel), disparity);
  float part = view.rayOrigin.w * storeNoise(pixel, view.rayY.w);
  vec4 rounded = nearestHalf(value, vec4(part, part, part, 0.0));
  return keepingNan(mix(rounded, value, bvec4(view.zenith.w > 0.0)), radiance, disparity);
}

// Returns the disparity that storable() stored; 0, infinitely far, for halfLeast.
float disparityOf(float stored) { return stored > halfLeast ? stored : 0.0; }
