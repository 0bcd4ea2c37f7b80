#version 450
// Stores the mean of each texel's samples, in the place of a device that would round it down.
#extension GL_GOOGLE_include_directive : require
#include "gpu_data.h"
#include "texels.glsl"
#include "half_float.glsl"

layout(set = 0, binding = 0) uniform sampler2DMS samples;

layout(push_constant) uniform Constants { MeanConstants rounding; };

layout(location = 0) out vec4 mean;

void main() {
  float part = rounding.dither * storeNoise(gl_FragCoord.xy, rounding.turn);
  mean = nearestHalf(texelMean(samples, ivec2(gl_FragCoord.xy)), vec4(part, part, part, 0.0));
}
