#version 450
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

layout(location = 0) out vec2 disc;

// Draws a square around the lamp that faces the eye. The disc in it is the sphere's outline. The disc is larger than
// the sphere, because rays from the eye that touch the sphere pass its center at more than its radius.
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
