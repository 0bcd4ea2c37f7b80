#version 450
#extension GL_GOOGLE_include_directive : require
#include "../common/display.glsl"
#include "view.glsl"

layout(location = 0) in vec2 disc;

void main() {
  if (dot(disc, disc) > 1.0) {
    discard;
  }
  show(view.lightColor.rgb * view.lightColor.w);
}
