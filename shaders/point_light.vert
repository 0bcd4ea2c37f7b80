#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"

layout(location = 0) flat out uint lightIndex;

// Draws a cube around the glyph. Its far faces cover the glyph on the screen from every eye, even from inside.
void main() {
  const int corners[36] = int[](0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6,
                                1, 3, 5, 3, 7, 5);
  int corner = corners[gl_VertexIndex];
  vec3 side = vec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1) * 2.0 - 1.0;
  lightIndex = view.firstLight + uint(gl_InstanceIndex);
  LightData light = lights[lightIndex];
  gl_Position = view.clipFromRelative * vec4(light.position + 1.01 * light.radius * side, 1.0);
}
