#version 450
// Adds a picture to the sum of the earlier ones.
#extension GL_GOOGLE_include_directive : require
#include "gpu_data.h"

layout(set = 0, binding = 0) uniform sampler2D radiance;
layout(set = 0, binding = 1) uniform sampler2D before;

layout(push_constant) uniform Constants { AccumulateConstants add; };

layout(location = 0) out vec4 sum;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  sum = vec4(texelFetch(radiance, texel, 0).rgb, 1.0);
  if (add.begins == 0) {
    sum += texelFetch(before, texel, 0);
  }
}
