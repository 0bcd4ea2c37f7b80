#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"

layout(set = 1, binding = 0) uniform usampler2D layer;

// Copies the layer, the still casters of a shadow map's face: its planes, and the depths that belong to them.
layout(location = 0) out uvec2 plane;

void main() {
  plane = texelFetch(layer, ivec2(gl_FragCoord.xy), 0).rg;
  gl_FragDepth = view.clipFromRelative[3].z * uintBitsToFloat(plane.x);
}
