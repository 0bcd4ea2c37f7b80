#version 450
#extension GL_GOOGLE_include_directive : require
#define HANDED in
#define OBJECT
#include "interface.glsl"
#include "object_values.glsl"
#include "shading.glsl"
#include "shadow_plane.glsl"

void main() {
  storePlane();
  if (holdsLight()) {
    discard;
  }
}
