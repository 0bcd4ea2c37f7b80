#version 450
#extension GL_GOOGLE_include_directive : require
#include "../common/display.glsl"
#include "view.glsl"

layout(push_constant) uniform Object {
  mat4 worldFromModel;
  vec4 diffuse;   // Kd
  vec4 specular;  // Ks, and the shininess Ns
} object;

layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;

const float pi = 3.14159265;

// Lights the surface by Phong and Blinn, as docs/picture.md defines it.
void main() {
  vec3 n = normalize(worldNormal);
  vec3 v = normalize(view.eye.xyz - worldPosition);
  vec3 toLight = view.light.xyz - worldPosition;
  vec3 l = normalize(toLight);
  float shininess = object.specular.w;
  float highlight = (shininess + 8.0) / (8.0 * pi) * pow(max(dot(n, normalize(l + v)), 1e-6), shininess);
  vec3 irradiance = view.lightColor.rgb * max(dot(n, l), 0.0) / dot(toLight, toLight);
  show(view.ambient.rgb * object.diffuse.rgb + irradiance * (object.diffuse.rgb / pi + object.specular.rgb * highlight));
}
