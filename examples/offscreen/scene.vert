#version 450
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

layout(push_constant) uniform Object {
  mat4 worldFromModel;
  vec4 diffuse;
  vec4 specular;
} object;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 worldPosition;
layout(location = 1) out vec3 worldNormal;

void main() {
  vec4 world = object.worldFromModel * vec4(position, 1.0);
  worldPosition = world.xyz;
  // Right for rotations, uniform scales and boxes; others need the inverse transpose (normalMatrix in src/geometry).
  worldNormal = mat3(object.worldFromModel) * normal;
  gl_Position = view.clipFromWorld * world;
}
