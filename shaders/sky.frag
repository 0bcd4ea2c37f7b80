#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"
#include "shading.glsl"

layout(location = 0) out vec4 color;

void main() {
  ViewData view = views[draw.viewIndex];
  color = storable(backgroundRadiance(view, rayThrough(view, gl_FragCoord.xy)), 0.0);
}
