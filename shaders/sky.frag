#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"
#include "shading.glsl"

layout(location = 0) out vec4 color;

void main() {
  color = storable(backgroundRadiance(rayThrough(gl_FragCoord.xy)), 0.0, gl_FragCoord.xy);
}
