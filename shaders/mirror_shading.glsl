// The fragment shader of mirrors. MIRROR_IMAGE is the type of the image. With MIRROR_OWN_SAMPLE each invocation draws
// one sample, reads the same sample of the image and gives the reflection's share only.
#define HANDS_ON
#define HANDED in
#include "interface.glsl"
#include "mirror_values.glsl"
#include "shading.glsl"
#include "texels.glsl"
#include "microfacet.glsl"
#include "mirror_plane.glsl"

// Specialisation constants: pixels run no code that their mirror does not need.
layout(constant_id = constantBaseOnly) const bool baseOnly = false;  // draws the base without the reflection
// The image is cached, and eye or mirror moved since.
layout(constant_id = constantReprojects) const bool reprojects = false;
layout(constant_id = constantAdded) const bool added = false;  // the reflection is added to the base, drawn before
// The mirror is rough, its image is that of a smooth mirror.
layout(constant_id = constantBlurs) const bool blurs = false;
layout(constant_id = constantShows) const uint shows = showsImage;
layout(constant_id = constantLookup) const uint lookup = lookupFetch;
layout(constant_id = constantColored) const bool colored = true;  // its back, or its base, is not black
// The mirror is rippled, its image is that of a smooth mirror.
layout(constant_id = constantRipples) const bool ripples = false;

layout(constant_id = constantMapped) const bool mapped = false;  // a map multiplies its reflectance

layout(set = 1, binding = 0) uniform MIRROR_IMAGE reflection;
layout(set = 1, binding = 1) uniform sampler2D reflectanceMap;

layout(location = 0) out vec4 color;

MirrorData mirror = drawnMirror;  // main() replaces what the vertex shader hands on

#ifdef MIRROR_OWN_SAMPLE
// All views share one projection and one set of sample positions: sample i of the parent's pixel and sample i of the
// image's texel lie on one ray and its reflection.
vec4 valueAt(ivec2 texel) { return texelFetch(reflection, texel, gl_SampleID); }

// Position of the values of valueAt() within their texels.
vec2 valuePosition() { return gl_SamplePosition; }

vec4 reflected() {
  ivec2 texel = ivec2(floor(gl_FragCoord.xy + mirror.lookupOffset));
  return valueAt(clamp(texel, ivec2(0), mirror.imageSize - 1));
}
#else
vec4 valueAt(ivec2 texel) { return insideMean(reflection, texel); }

vec2 valuePosition() { return vec2(0.5); }

// Returns the mean of the values between two corners. Those outside the mirror count only if all are.
vec4 boxFiltered(vec2 low, vec2 high, ivec2 last) {
  vec4 value = vec4(0.0);
  vec4 sum = vec4(0.0);
  float area = 0.0;
  for (int y = int(floor(low.y)); y < int(ceil(high.y)); ++y) {
    for (int x = int(floor(low.x)); x < int(ceil(high.x)); ++x) {
      vec2 covered = min(vec2(x + 1, y + 1), high) - max(vec2(x, y), low);
      value = valueAt(clamp(ivec2(x, y), ivec2(0), last));
      float weight = isOutside(value) ? 0.0 : max(covered.x, 0.0) * max(covered.y, 0.0);
      sum += weight * value;
      area += weight;
    }
  }
  return area > 0.0 ? sum / area : value;
}

// Interpolates at `position` in texels, half a texel or more inside the used part of the image. Unlike a sampler, reads
// no neighbour of weight 0: texels beside the used part were never written, and 0 x NaN is NaN.
vec4 bilinear(vec2 position, ivec2 last) {
  vec2 corner = floor(position - 0.5);
  vec2 weight = position - 0.5 - corner;
  ivec2 low = ivec2(corner);
  ivec2 high = ivec2(ceil(position - 0.5));
  vec4 values[4] = vec4[](valueAt(low), valueAt(ivec2(high.x, low.y)), valueAt(ivec2(low.x, high.y)), valueAt(high));
  if (isOutside(values[0]) || isOutside(values[1]) || isOutside(values[2]) || isOutside(values[3])) {
    return boxFiltered(position - 0.5, position + 0.5, last);
  }
  return mix(mix(values[0], values[1], weight.x), mix(values[2], values[3], weight.x), weight.y);
}

// Where the texels of this pixel lie outside the mirror, those around them continue the image.
vec4 reflected() {
  ivec2 last = mirror.imageSize - 1;
  vec2 texel = gl_FragCoord.xy * mirror.lookupScale + mirror.lookupOffset;
  vec4 value;
  if (lookup == lookupBilinear) {
    value = bilinear(clamp(texel, vec2(0.5), vec2(mirror.imageSize) - 0.5), last);
  } else if (lookup == lookupBox) {
    vec2 low = floor(gl_FragCoord.xy) * mirror.lookupScale + mirror.lookupOffset;
    value = boxFiltered(low, low + mirror.lookupScale, last);
  } else {
    value = valueAt(clamp(ivec2(floor(texel)), ivec2(0), last));
  }
  if (lookup != lookupFetch && isOutside(value)) {
    vec2 reach = max(mirror.lookupScale, vec2(1.0));
    value = boxFiltered(texel - reach, texel + reach, last);
  }
  return vec4(value.rgb, max(value.a, 0.0));
}
#endif

// Relation of this fragment to a cached image. docs/architecture.md: When is an image used again?
struct Reprojection {
  vec3 direction;  // homogeneous texel of what is infinitely far
  vec3 parallax;   // added to `direction` per disparity
  float nearest;   // disparity of the mirror's surface, behind which everything in the image lies
};

Reprojection reprojection(float nearest) {
  vec4 rows[3] = mirror.texelFromPixel;
  mat3 fromPixel = transpose(mat3(rows[0].xyz, rows[1].xyz, rows[2].xyz));
  return Reprojection(fromPixel * vec3(gl_FragCoord.xy, 1.0), vec3(rows[0].w, rows[1].w, rows[2].w), nearest);
}

vec2 texelAt(Reprojection r, float disparity) {
  vec3 texel = r.direction + r.parallax * disparity;
  return texel.xy / max(texel.z, 1e-30);
}

// Returns the present disparity of a point on this fragment's ray that had disparity `then` in the image.
float disparityNow(Reprojection r, float then) {
  float ahead = 1.0 - then * r.parallax.z;
  return ahead > 1e-6 ? clamp(then * r.direction.z / ahead, 0.0, r.nearest) : r.nearest;
}

// Improves a guess: replaces it by the disparity stored in the texel that it leads to.
float refined(Reprojection r, ivec2 last, float disparity) {
  for (int i = 0; i < 3; ++i) {
    disparity = disparityNow(r, valueAt(clamp(ivec2(floor(texelAt(r, disparity))), ivec2(0), last)).a);
  }
  return disparity;
}

// Finds the point of the image that lies on this fragment's ray, and returns its disparity. The candidates lie on a
// line in the image, from the mirror's surface to infinity; the first one whose stored disparity leads back to its own
// texel is the point. If there is none, something hid what is seen now, and the farthest candidate fills the gap.
float foundDisparity(Reprojection r, ivec2 last) {
  float span = distance(texelAt(r, r.nearest), texelAt(r, 0.0));
  int steps = int(clamp(ceil(span), 1.0, 32.0));
  float reach = max(span / float(steps), 1.0);
  float farthest = r.nearest;
  float guess = r.nearest;
  float filling = 0.0;
  for (int i = 0; i <= steps; ++i) {
    guess = r.nearest * (1.0 - float(i) / float(steps));
    ivec2 texel = clamp(ivec2(floor(texelAt(r, guess))), ivec2(0), last);
    float found = disparityNow(r, valueAt(texel).a);
    vec2 off = abs(texelAt(r, found) - valuePosition() - vec2(texel));
    if (max(off.x, off.y) < reach) {
      return reach > 1.0 ? refined(r, last, found) : found;
    }
    if (found < farthest) {
      farthest = found;
      filling = guess;
    }
  }
  return filling;
}

// Filters by a box as wide as a pixel, or as a texel if that is wider; at the view's resolution this is bilinear. Each
// value is weighted by the distance of its own point from the ray: beside a silhouette, far points have moved by
// another length than near ones and would leave an outline. If no value has weight, the farthest fills the gap.
vec4 reprojected(float nearest) {
  ivec2 last = mirror.imageSize - 1;
  Reprojection r = reprojection(nearest);
  vec2 position = texelAt(r, foundDisparity(r, last)) - valuePosition();
  vec2 reach = 0.5 * max(mirror.lookupScale, vec2(1.0)) + 0.5;
  ivec2 low = clamp(ivec2(ceil(position - reach)), ivec2(0), last);
  ivec2 high = clamp(ivec2(floor(position + reach)), ivec2(0), last);
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  vec4 farthest = valueAt(low);
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      vec4 value = valueAt(ivec2(x, y));
      vec2 own = texelAt(r, disparityNow(r, value.a)) - valuePosition();
      vec2 weight = clamp(reach - abs(own - vec2(x, y)), 0.0, 1.0);
      float share = isOutside(value) ? 0.0 : weight.x * weight.y;
      sum += share * value;
      weights += share;
      farthest = isOutside(farthest) || (value.a <= farthest.a && !isOutside(value)) ? value : farthest;
    }
  }
  return weights > 0.05 ? sum / weights : vec4(farthest.rgb, max(farthest.a, 0.0));
}

#ifndef MIRROR_OWN_SAMPLE
// Returns the pixel of the view at which a point behind the mirror is seen. The point is relative and in front of the
// eye.
vec2 pixelOf(vec3 point) {
  vec3 x = view.rayX;
  vec3 y = view.rayY.xyz;
  vec3 axis = cross(x, y);
  vec3 onPlane = point * (dot(view.rayOrigin.xyz, axis) / dot(point, axis)) - view.rayOrigin.xyz;
  return vec2(dot(onPlane, x) / dot(x, x), dot(onPlane, y) / dot(y, y));
}

// Where the image of the smooth mirror is looked up from: a point of the mirror, and what is seen there.
struct Origin {
  vec3 position;
  float guess;     // distance of what the smooth mirror shows here
  float limit;     // distance beyond which nothing changes
};

// Returns what the image shows along the direction. The distance is first guessed, then taken from the image. Beyond
// the image the background is seen.
vec3 imageAlong(vec3 direction, Origin origin) {
  vec3 behind = direction - 2.0 * dot(direction, mirror.normal) * mirror.normal;
  float far = origin.guess;
  vec3 found = vec3(0.0);
  for (int i = 0; i < 3; ++i) {
    vec2 pixel = pixelOf(origin.position + far * behind);
    vec2 texel = pixel * mirror.lookupScale + mirror.lookupOffset;
    if (!(all(greaterThanEqual(texel, vec2(0.0))) && all(lessThan(texel, vec2(mirror.imageSize))))) {
      return backgroundRadiance(direction);
    }
    vec4 value = valueAt(ivec2(texel));
    found = value.rgb;
    vec3 shown = rayThrough(pixel) * (disparityLength / max(disparityOf(value.a), 1e-30));
    far = clamp(dot(shown - origin.position, behind), 0.0, origin.limit);
  }
  return found;
}

const int marchSteps = 16;

// Follows the reflected ray behind the mirror in steps of equal length on the screen. Returns the radiance of the first
// surface in the image that lies between two steps; if there is none, that of the farthest surface on the way. Beyond
// the image its edge is read.
vec3 marchImage(vec3 direction, vec3 position) {
  vec3 behind = direction - 2.0 * dot(direction, mirror.normal) * mirror.normal;
  vec3 axis = cross(view.rayX, view.rayY.xyz);
  axis /= dot(view.rayOrigin.xyz, axis);
  float start = dot(position, axis);  // depth
  float slope = max(dot(behind, axis), 1e-4);
  behind += (slope - dot(behind, axis)) * axis / dot(axis, axis);  // never towards the eye, as pixelOf() needs
  float before = start;
  vec4 farthest = vec4(0.0, 0.0, 0.0, halfMax);
  for (int i = 1; i <= marchSteps; ++i) {
    float part = min(float(i) / float(marchSteps), 0.9999);
    float t = part * start / ((1.0 - part) * slope);
    vec2 texel = pixelOf(position + t * behind) * mirror.lookupScale + mirror.lookupOffset;
    vec4 value = valueAt(ivec2(clamp(floor(texel), vec2(0.0), vec2(mirror.imageSize - 1))));
    float depth = start + t * slope;
    if (value.a * depth >= disparityLength && value.a * before <= disparityLength) {
      return value.rgb;
    }
    before = depth;
    farthest = value.a <= farthest.a ? value : farthest;
  }
  return farthest.rgb;
}

// Returns what a rippled or rough mirror reflects, looked up in the image of the smooth mirror: along the ray that the
// ripples reflect, or as the mean over microfacets.
vec4 scatteredReflection(vec3 ray, vec3 position, vec3 normal) {
  vec3 incoming = safeNormalize(ray);
  vec4 sharp = reflected();
  if (!blurs) {
    return vec4(marchImage(mirrored(incoming, normal, mirror.normal), position), sharp.a);
  }
  float limit = 1e4 * (length(position) + 1.0);
  float guess = length(ray) * disparityLength / max(disparityOf(sharp.a), 1e-30) - length(position);
  Origin origin = Origin(position, clamp(guess, 0.0, limit), limit);
  uint seed = seedAt(gl_FragCoord.xy);
  vec2 shift = recurrenceShift(seed, view.picture * uint(mirror.blurSamples));
  vec3 sum = vec3(0.0);
  int taken = 0;
  int lookups = int(countHere(uint(mirror.blurSamples)));
  for (int drawn = 1; drawn <= lookups; ++drawn) {
    vec3 m = microfacet(normal, mirror.alpha, recurrencePoint(shift, drawn));
    if (staysAbove(incoming, m, mirror.normal)) {
      sum += imageAlong(incoming - 2.0 * dot(incoming, m) * m, origin);
      ++taken;
    }
  }
  return taken > 0 ? vec4(sum / float(taken), sharp.a) : sharp;
}

vec3 mirrorNormal(vec3 position) {
  if (!ripples) {
    return mirror.normal;
  }
  return rippledNormal(mirror.normal, mirror.axisX, mirror.axisY, position - mirror.rippleOrigin, mirror.waveNumber,
                       mirror.rippleSlope, vec2(mirror.firstPhase, mirror.secondPhase));
}
#endif

// Returns the share by which the map multiplies the reflectance.
vec3 mapShare(vec3 position) {
  if (!mapped) {
    return vec3(1.0);
  }
  vec2 uv = vec2(dot(mirror.mapU.xyz, position) + mirror.mapU.w, dot(mirror.mapV.xyz, position) + mirror.mapV.w);
  return bilinearColor(reflectanceMap, withinBorder(uv, vec2(textureSize(reflectanceMap, 0))), false);
}

vec3 baseRadiance(vec3 position, vec3 normal) {
  if (!colored) {
    return vec3(0.0);
  }
  Surface base = mirrorBase(position, normal, mirror.baseColor, length(position));
#ifdef SHADOW_MAPS
  receiver = position;
  receiverNormal = mirror.normal;
#endif
  return surfaceRadiance(base);
}

// Stores the disparity of the reflected surface, so that the parent's image can be reprojected too. This disparity is
// the same in the mirror's image and in its parent's, because views share one projection and reflection keeps lengths.
void main() {
  mirror.normal = handedNormal.xyz;
  mirror.eyeDistance = handedNormal.w;
  mirror.reflectance = handedReflectance.rgb;
  mirror.schlick = uint(handedReflectance.w);
  mirror.baseColor = handedBaseColor;
  mirror.lookupScale = handedLookup.xy;
  mirror.lookupOffset = handedLookup.zw;
  mirror.imageSize = ivec2(handedRayX.w, handedRayY.w);
  vec3 ray = handedRayX.xyz * gl_FragCoord.x + handedRayY.xyz * gl_FragCoord.y + handedRayOrigin;
  PlaneHit hit = planeHit(mirror.normal, mirror.eyeDistance, ray);
#ifdef MIRROR_OWN_SAMPLE
  float cosine = -hit.inward * inversesqrt(max(dot(hit.ray, hit.ray), 1e-30));
  vec3 f = mapShare(hit.position) * reflectanceAt(mirror.reflectance, mirror.schlick, cosine);
  vec4 image = reprojects ? reprojected(hit.disparity) : reflected();
  vec3 radiance = f * min(image.rgb, shareMax);
  color = added ? addable(radiance, image.a, gl_FragCoord.xy) : storable(radiance, image.a, gl_FragCoord.xy);
#else
  vec3 normal = mirrorNormal(hit.position);
  float inward = ripples ? dot(normal, hit.ray) : hit.inward;
  float cosine = -inward * inversesqrt(max(dot(hit.ray, hit.ray), 1e-30));
  vec3 f = mapShare(hit.position) * reflectanceAt(mirror.reflectance, mirror.schlick, cosine);
  vec3 base = baseRadiance(hit.position, normal);
  if (shows == showsBack) {
    color = storable(base, hit.disparity, gl_FragCoord.xy);
    return;
  }
  if (baseOnly) {
    color = storable(sumFactor(gl_FragCoord.xy) * (1.0 - f) * min(base, shareMax), 0.0, gl_FragCoord.xy);
    return;
  }
  vec4 image = vec4(0.0, 0.0, 0.0, float(view.inMap) * halfLeast);
  if (shows == showsImage) {
    if (blurs || ripples) {
      image = scatteredReflection(hit.ray, hit.position, normal);
    } else {
      image = reprojects ? reprojected(hit.disparity) : reflected();
    }
  } else {
    image.rgb = backgroundRadiance(reflect(hit.ray, mirror.normal));
  }
  color = added ? addable(f * min(image.rgb, shareMax), image.a, gl_FragCoord.xy)
                : storable(f * image.rgb + (1.0 - f) * base, image.a, gl_FragCoord.xy);
#endif
}
