#version 450
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

layout(push_constant) uniform MirrorPush { mat4 worldFromMirror; } mirror;

layout(location = 0) out vec2 uv;

// Draws a square of side 1, which faces +z: seen from there, its corners run counter-clockwise.
void main() {
  const vec2 corners[6] = vec2[](vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 0), vec2(1, 1), vec2(0, 1));
  uv = corners[gl_VertexIndex];
  vec4 world = mirror.worldFromMirror * vec4(uv - 0.5, 0.0, 1.0);
  gl_Position = view.clipFromWorld * world;
}
