// The fragment shader of mirrors. MIRROR_IMAGE is the type of the image; with MIRROR_OWN_SAMPLE each invocation stands
// for one sample, reads the same sample of the image and gives the reflection's share only.
#include "interface.glsl"
#include "shading.glsl"
#include "texels.glsl"

layout(constant_id = 0) const bool baseOnly = false;  // the share of the layer under the reflection

layout(set = 1, binding = 0) uniform MIRROR_IMAGE reflection;

layout(location = 0) out vec4 color;

#ifdef MIRROR_OWN_SAMPLE
// All views share one projection and one set of sample positions: sample i of the parent's pixel and sample i of the
// image's texel lie on one ray and its reflection.
vec3 reflectedRadiance(MirrorData mirror) {
  ivec2 texel = ivec2(floor(gl_FragCoord.xy + mirror.lookup.zw));
  return texelFetch(reflection, clamp(texel, ivec2(0), mirror.image.xy - 1), gl_SampleID).rgb;
}
#else
vec3 boxFiltered(vec2 low, vec2 high, ivec2 last) {
  vec3 sum = vec3(0.0);
  float area = 0.0;
  for (int y = int(floor(low.y)); y < int(ceil(high.y)); ++y) {
    for (int x = int(floor(low.x)); x < int(ceil(high.x)); ++x) {
      vec2 covered = min(vec2(x + 1, y + 1), high) - max(vec2(x, y), low);
      float weight = max(covered.x, 0.0) * max(covered.y, 0.0);
      sum += weight * texelRadiance(reflection, clamp(ivec2(x, y), ivec2(0), last));
      area += weight;
    }
  }
  return sum / max(area, 1e-6);
}

vec3 reflectedRadiance(MirrorData mirror) {
  ivec2 last = mirror.image.xy - 1;
  vec2 texel = gl_FragCoord.xy * mirror.lookup.xy + mirror.lookup.zw;
  if (mirror.image.z == lookupFetch) {
    return texelRadiance(reflection, clamp(ivec2(floor(texel)), ivec2(0), last));
  }
  if (mirror.image.z == lookupBilinear) {
    return bilinearRadiance(reflection, clamp(texel, vec2(0.5), vec2(mirror.image.xy) - 0.5));
  }
  vec2 low = floor(gl_FragCoord.xy) * mirror.lookup.xy + mirror.lookup.zw;
  return boxFiltered(low, low + mirror.lookup.xy, last);
}
#endif

// F of docs/picture.md; `inward` is the ray's component along the normal, below zero.
vec3 reflectance(MirrorData mirror, vec3 ray, float inward) {
  vec3 f = mirror.reflectance.rgb;
  if (mirror.reflectance.w > 0.0) {
    float cosine = clamp(-inward * inversesqrt(max(dot(ray, ray), 1e-30)), 0.0, 1.0);
    float grazing = 1.0 - cosine;
    float grazing2 = grazing * grazing;
    f += (1.0 - f) * (grazing2 * grazing2 * grazing);
  }
  return f;
}

vec3 baseRadiance(MirrorData mirror, ViewData view, vec3 position) {
  Surface base;
  base.position = position;
  base.normal = mirror.plane.xyz;
  base.diffuse = mirror.baseColor.rgb;
  base.specular = vec3(0.0);
  base.emission = vec3(0.0);
  base.shininess = 1.0;
  bool back = mirror.baseColor.w == mirrorBack;
  return back || any(greaterThan(base.diffuse, vec3(0.0))) ? surfaceRadiance(view, base) : vec3(0.0);
}

void main() {
  MirrorData mirror = mirrors[draw.drawIndex];
  ViewData view = views[draw.viewIndex];
  // The pixel's ray meets the plane: exact at every distance and angle, where interpolation over a polygon that may
  // reach behind the eye is not. A pixel whose centre lies beyond the horizon is seen at grazing angle.
  vec3 ray = rayThrough(view, gl_FragCoord.xy);
  float inward = min(dot(mirror.plane.xyz, ray), -1e-7 * length(ray));
  vec3 f = reflectance(mirror, ray, inward);
#ifdef MIRROR_OWN_SAMPLE
  color = storable(f * min(reflectedRadiance(mirror), shareMax));
#else
  vec3 base = baseRadiance(mirror, view, ray * (-mirror.plane.w / inward));
  if (mirror.baseColor.w == mirrorBack) {
    color = storable(base);
    return;
  }
  if (baseOnly) {
    color = storable((1.0 - f) * min(base, shareMax));
    return;
  }
  vec3 reflected = mirror.baseColor.w == mirrorImage ? reflectedRadiance(mirror)
                                                     : backgroundRadiance(view, reflect(ray, mirror.plane.xyz));
  color = storable(f * reflected + (1.0 - f) * base);
#endif
}
