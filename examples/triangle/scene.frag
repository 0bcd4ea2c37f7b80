#version 450
#extension GL_GOOGLE_include_directive : require
#include "../common/display.glsl"
#include "view.glsl"

layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
layout(location = 2) in vec3 diffuse;

// Lights the side that faces the eye.
void main() {
  vec3 n = gl_FrontFacing ? worldNormal : -worldNormal;
  vec3 toLight = view.light.xyz - worldPosition;
  vec3 irradiance = view.lightColor.rgb * max(dot(n, normalize(toLight)), 0.0) / dot(toLight, toLight);
  show(diffuse * (4.0 * view.ambient.rgb + irradiance / 3.14159265));  // alone, a triangle needs more ambient light
}
