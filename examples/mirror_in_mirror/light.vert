#version 450
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

layout(location = 0) out vec2 disc;

// Draws a square that faces the eye, so large that the lamp's sphere, as the eye sees it, covers the unit disc.
void main() {
  const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
  disc = corners[gl_VertexIndex];
  vec3 toEye = view.eye.xyz - view.light.xyz;
  float squared = dot(toEye, toEye);
  float radius = view.light.w * sqrt(squared / (squared - view.light.w * view.light.w));
  vec3 right = normalize(cross(vec3(0, 1, 0), toEye));
  vec3 up = cross(normalize(toEye), right);
  vec4 world = vec4(view.light.xyz + radius * (disc.x * right + disc.y * up), 1.0);
  gl_Position = view.clipFromWorld * world;
  gl_ClipDistance[0] = dot(view.clipPlane, world);
}
