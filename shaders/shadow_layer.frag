#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"

layout(set = 1, binding = 0) uniform sampler2D layer;

// Copies the disparities of the layer, and the depths that belong to them.
layout(location = 0) out float disparity;

void main() {
  disparity = texelFetch(layer, ivec2(gl_FragCoord.xy), 0).r;
  gl_FragDepth = view.clipFromRelative[3].z * disparity;
}
