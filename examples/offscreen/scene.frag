#version 450
#extension GL_GOOGLE_include_directive : require
#include "../common/display.glsl"
#include "view.glsl"
#include "../common/lighting.glsl"

layout(push_constant) uniform Object {
  mat4 worldFromModel;
  vec4 diffuse;
  vec4 specular;
} object;

layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;

void main() {
  vec3 n = normalize(worldNormal);
  show(litSurface(worldPosition, n, object.diffuse.rgb, object.specular));
}
