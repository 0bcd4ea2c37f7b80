// Encodes linear radiance as display-referred sRGB. Needs gpu_data.h.
#include "srgb.glsl"

layout(constant_id = constantEncoding) const uint encoding = encodingNone;

// Narkowicz, "ACES Filmic Tone Mapping Curve" (2016).
vec3 toneCurve(vec3 x) {
  return min(encoding == encodingAces ? x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14) : x, vec3(1.0));
}

// Rounds to steps of 8 bits, a tie up. Vulkan does not specify how devices round ties.
vec3 nearestStep(vec3 x) {
  precise vec3 steps = 255.0 * x;
  return floor(steps + 0.5) * (1.0 / 255.0);
}

// Returns the color that the display image stores. `x`: radiance times exposure.
vec4 displayColor(vec3 x) { return vec4(nearestStep(srgbEncode(toneCurve(x))), 1.0); }
