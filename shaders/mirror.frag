#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"
#include "shading.glsl"

layout(set = 1, binding = 0) uniform sampler2D reflection;

layout(location = 0) out vec4 color;

vec3 boxFiltered(vec2 low, vec2 high, ivec2 last) {
  vec3 sum = vec3(0.0);
  float area = 0.0;
  for (int y = int(floor(low.y)); y < int(ceil(high.y)); ++y) {
    for (int x = int(floor(low.x)); x < int(ceil(high.x)); ++x) {
      vec2 covered = min(vec2(x + 1, y + 1), high) - max(vec2(x, y), low);
      float weight = max(covered.x, 0.0) * max(covered.y, 0.0);
      sum += weight * texelFetch(reflection, clamp(ivec2(x, y), ivec2(0), last), 0).rgb;
      area += weight;
    }
  }
  return sum / max(area, 1e-6);
}

vec3 reflectedRadiance(MirrorData mirror) {
  ivec2 last = mirror.image.xy - 1;
  vec2 texel = gl_FragCoord.xy * mirror.lookup.xy + mirror.lookup.zw;
  if (mirror.image.z == lookupFetch) {
    return texelFetch(reflection, clamp(ivec2(floor(texel)), ivec2(0), last), 0).rgb;
  }
  if (mirror.image.z == lookupBilinear) {
    vec2 inside = clamp(texel, vec2(0.5), vec2(mirror.image.xy) - 0.5);
    return textureLod(reflection, inside / vec2(textureSize(reflection, 0)), 0.0).rgb;
  }
  vec2 low = floor(gl_FragCoord.xy) * mirror.lookup.xy + mirror.lookup.zw;
  return boxFiltered(low, low + mirror.lookup.xy, last);
}

void main() {
  MirrorData mirror = mirrors[draw.drawIndex];
  ViewData view = views[draw.viewIndex];
  // The pixel's ray meets the plane: exact at every distance and angle, where interpolation over a polygon that may
  // reach behind the eye is not. A pixel whose centre lies beyond the horizon is seen at grazing angle.
  vec3 ray = rayThrough(view, gl_FragCoord.xy);
  float inward = min(dot(mirror.plane.xyz, ray), -1e-7 * length(ray));
  vec3 position = ray * (-mirror.plane.w / inward);

  Surface base;
  base.position = position;
  base.normal = mirror.plane.xyz;
  base.diffuse = mirror.baseColor.rgb;
  base.specular = vec3(0.0);
  base.emission = vec3(0.0);
  base.shininess = 1.0;
  bool back = mirror.baseColor.w == mirrorBack;
  vec3 baseRadiance = back || any(greaterThan(base.diffuse, vec3(0.0))) ? surfaceRadiance(view, base) : vec3(0.0);
  if (back) {
    color = storable(baseRadiance);
    return;
  }

  vec3 f = mirror.reflectance.rgb;
  if (mirror.reflectance.w > 0.0) {
    float cosine = clamp(-inward * inversesqrt(max(dot(ray, ray), 1e-30)), 0.0, 1.0);
    float grazing = 1.0 - cosine;
    float grazing2 = grazing * grazing;
    f += (1.0 - f) * (grazing2 * grazing2 * grazing);
  }
  vec3 reflected = mirror.baseColor.w == mirrorImage ? reflectedRadiance(mirror)
                                                     : backgroundRadiance(view, reflect(ray, mirror.plane.xyz));
  color = storable(f * reflected + (1.0 - f) * baseRadiance);
}
