#version 450
#extension GL_GOOGLE_include_directive : require
#include "gpu_data.h"
#include "shaded.glsl"

layout(constant_id = 0) const uint samples = 1;

layout(set = 0, binding = 1, std430) readonly buffer Shaded { uvec2 shaded[]; };

layout(push_constant) uniform Area { ShadeConstants area; };

layout(location = 0) flat in uint drawnSample;

layout(location = 0) out vec4 color;

// Replaces a sample's identifier by its radiance. The mask selects the sample, which no device feature is needed for.
void main() {
  uvec2 pixel = uvec2(ivec2(gl_FragCoord.xy) - area.corner);
  uvec2 value = shaded[shadedIndex(pixel, area.size.x, samples, drawnSample)];
  if (value.x == notShaded) {
    discard;
  }
  gl_SampleMask[0] = 1 << drawnSample;
  color = vec4(unpackHalf2x16(value.x), unpackHalf2x16(value.y));
}
