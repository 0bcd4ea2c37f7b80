// Converts linear radiance to display-referred sRGB, after the samples are averaged. DISPLAY_IMAGE is the image's type.
// With DISPLAY_ENLARGED the image has fewer texels than the display has pixels.
#include "gpu_data.h"
#include "texels.glsl"

layout(constant_id = 0) const bool aces = false;

layout(set = 0, binding = 0) uniform DISPLAY_IMAGE radiance;

layout(push_constant) uniform Constants { DisplayConstants display; };

layout(location = 0) out vec4 color;

// Narkowicz, "ACES Filmic Tone Mapping Curve" (2016).
vec3 toneCurve(vec3 x) {
  return min(aces ? x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14) : x, vec3(1.0));
}

// IEC 61966-2-1.
vec3 srgbEncode(vec3 x) {
  return mix(12.92 * x, 1.055 * pow(max(x, vec3(1e-8)), vec3(1.0 / 2.4)) - 0.055, greaterThan(x, vec3(0.0031308)));
}

#ifdef DISPLAY_ENLARGED
// Catmull and Rom, "A class of local interpolating splines" (1974).
vec4 splineWeights(float t) {
  return vec4(((-0.5 * t + 1.0) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1.0, ((-1.5 * t + 2.0) * t + 0.5) * t,
              (0.5 * t - 0.5) * t * t);
}

vec3 texelAt(ivec2 texel) {
  return texelFetch(radiance, clamp(texel, ivec2(0), textureSize(radiance, 0) - 1), 0).rgb;
}

// The spline, kept within the four nearest texels: image/enlarge.hpp.
vec3 radianceAt(vec2 position) {
  ivec2 corner = ivec2(floor(position - 0.5));
  vec2 t = position - 0.5 - vec2(corner);
  vec4 columns = splineWeights(t.x);
  vec4 rows = splineWeights(t.y);
  vec3 sum = vec3(0.0);
  vec3 low = vec3(65504.0);
  vec3 high = vec3(0.0);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      vec3 value = texelAt(corner + ivec2(x, y) - 1);
      sum += rows[y] * columns[x] * value;
      if ((x == 1 || x == 2) && (y == 1 || y == 2)) {
        low = min(low, value);
        high = max(high, value);
      }
    }
  }
  return clamp(sum, low, high);
}
#else
vec3 radianceAt(vec2 position) { return texelMean(radiance, ivec2(position)).rgb; }
#endif

void main() {
  vec3 x = display.exposure * radianceAt(gl_FragCoord.xy * display.lookup.xy + display.lookup.zw);
  color = vec4(srgbEncode(toneCurve(x)), 1.0);
}
