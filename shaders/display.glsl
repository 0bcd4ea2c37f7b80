// Converts linear radiance to display-referred sRGB, after the samples are averaged. DISPLAY_IMAGE is the image's type.
// With DISPLAY_ENLARGED the image has fewer texels than the display has pixels.
#include "gpu_data.h"
#include "encoding.glsl"
#include "texels.glsl"

layout(constant_id = constantShrunk) const bool shrunk = false;  // a pixel covers more than one texel
// The sampler enlarges the image. Only on CPUs, whose samplers have floats as weights.
layout(constant_id = constantSampled) const bool sampled = false;

layout(set = 0, binding = 0) uniform DISPLAY_IMAGE radiance;

layout(push_constant) uniform Constants { DisplayConstants display; };

layout(location = 0) out vec4 color;

#ifdef DISPLAY_ENLARGED
vec3 texelAt(ivec2 texel) {
  return texelFetch(radiance, clamp(texel, ivec2(0), textureSize(radiance, 0) - 1), 0).rgb;
}

// Interpolates bilinearly like enlarged() of image/image.hpp, by a sampler only on CPUs: samplers of GPUs have weights
// of few bits, which differ between devices.
vec3 radianceAt(vec2 position) {
  if (sampled) {
    return textureLod(radiance, position / vec2(textureSize(radiance, 0)), 0.0).rgb;
  }
  ivec2 corner = ivec2(floor(position - 0.5));
  vec2 t = position - 0.5 - vec2(corner);
  vec3 a = texelAt(corner);
  vec3 b = texelAt(corner + ivec2(1, 0));
  vec3 c = texelAt(corner + ivec2(0, 1));
  vec3 d = texelAt(corner + ivec2(1, 1));
  return clamp(mix(mix(a, b, t.x), mix(c, d, t.x), t.y), min(min(a, b), min(c, d)), max(max(a, b), max(c, d)));
}
#else
// Where the image is shrunk, returns the mean of the box of texels that a pixel covers: without it thin lines would
// come and go.
vec3 radianceAt(vec2 position) {
  if (!shrunk) {
    return texelMean(radiance, ivec2(position)).rgb;
  }
  vec2 low = max(position - 0.5 * display.lookup.xy, vec2(0.0));
  vec2 high = min(position + 0.5 * display.lookup.xy, vec2(display.size));
  vec3 sum = vec3(0.0);
  float covered = 0.0;
  for (int y = int(low.y); y < int(ceil(high.y)); ++y) {
    for (int x = int(low.x); x < int(ceil(high.x)); ++x) {
      vec2 part = min(vec2(x + 1, y + 1), high) - max(vec2(x, y), low);
      sum += part.x * part.y * texelMean(radiance, ivec2(x, y)).rgb;
      covered += part.x * part.y;
    }
  }
  return sum / covered;
}
#endif

void main() {
  color = displayColor(display.exposure * radianceAt(gl_FragCoord.xy * display.lookup.xy + display.lookup.zw));
}
