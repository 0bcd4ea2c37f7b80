// Converts linear radiance to display-referred sRGB, after the samples are averaged. DISPLAY_IMAGE is the image's type.
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

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy * display.lookup.xy + display.lookup.zw);
  vec3 x = display.exposure * texelMean(radiance, texel).rgb;
  color = vec4(srgbEncode(toneCurve(x)), 1.0);
}
