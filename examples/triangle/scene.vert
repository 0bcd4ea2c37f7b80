#version 450
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

layout(push_constant) uniform Object {
  mat4 worldFromModel;
  vec4 diffuse;
  vec4 specular;
} object;

layout(location = 0) out vec3 worldPosition;
layout(location = 1) out vec3 worldNormal;
layout(location = 2) out vec3 diffuse;

void main() {
  const vec3 corners[3] = vec3[](vec3(-1.0, 0.1, 0.0), vec3(1.0, 0.1, 0.0), vec3(0.0, 1.7, 0.0));
  const vec3 colors[3] = vec3[](vec3(0.9, 0.1, 0.03), vec3(0.05, 0.6, 0.2), vec3(0.06, 0.2, 0.9));
  vec3 position = corners[gl_VertexIndex];
  vec3 normal = vec3(0.0, 0.0, 1.0);
  diffuse = object.diffuse.rgb * colors[gl_VertexIndex];
  vec4 world = object.worldFromModel * vec4(position, 1.0);
  worldPosition = world.xyz;
  // Right for rotations, uniform scales and boxes; others need the inverse transpose (normalMatrix in src/geometry).
  worldNormal = mat3(object.worldFromModel) * normal;
  gl_Position = view.clipFromWorld * world;
}
