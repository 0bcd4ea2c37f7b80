#version 450
// Adds a picture to the sum of the earlier ones. Where nothing was drawn, because the mean has converged there, adds
// the mean itself.
#extension GL_GOOGLE_include_directive : require
#include "gpu_data.h"

layout(set = 0, binding = 0) uniform sampler2D radiance;
layout(set = 0, binding = 1) uniform sampler2D before;

layout(set = 0, binding = 2, std430) readonly buffer Tiles { uint refined[]; };  // RefinedTiles::tiles

layout(push_constant) uniform Constants { AccumulateConstants add; };

layout(location = 0) out vec4 sum;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  sum = vec4(texelFetch(radiance, texel, 0).rgb, 1.0);
  if (add.begins == 0) {
    vec4 earlier = texelFetch(before, texel, 0);
    ivec2 tile = texel / int(add.tileSide);
    bool drawn = add.columns == 0 || refined[tile.y * int(add.columns) + tile.x] != 0;
    sum = drawn ? sum + earlier : earlier * ((earlier.a + 1.0) / earlier.a);
  }
}
