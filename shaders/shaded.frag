#version 450
#extension GL_GOOGLE_include_directive : require
#include "gpu_data.h"
#define SHADED_SET 0
#define SHADED_ACCESS readonly
#include "shaded.glsl"

layout(location = 0) flat in uint drawnSample;

layout(location = 0) out vec4 color;

// Replaces a sample's identifier by its radiance. The mask selects the sample, which no device feature is needed for.
void main() {
  uint pixel = pixelNumber(uvec2(ivec2(gl_FragCoord.xy) - area.corner));
  uvec2 value = shaded[sampleNumber(pixel, drawnSample)];
  if (value.x == notShaded) {
    discard;
  }
  gl_SampleMask[0] = 1 << drawnSample;
  color = vec4(unpackHalf2x16(value.x), unpackHalf2x16(value.y));
  color.a = color.a < 0.0 ? 0.0 : color.a;  // a reflectionMark()
}
