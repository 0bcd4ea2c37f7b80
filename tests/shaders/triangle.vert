#version 450

// A triangle whose corners stand at different depths, pushed around by `offset` (clip space) and `depth`.
layout(push_constant) uniform Push {
  vec2 offset;
  float depth;
  float brightness;
} push;

layout(location = 0) out vec3 color;

void main() {
  const vec2 corners[3] = vec2[](vec2(-0.8, -0.7), vec2(0.9, -0.3), vec2(-0.1, 0.8));
  gl_Position = vec4(corners[gl_VertexIndex] + push.offset, push.depth, 1.0);
  color = push.brightness * vec3(gl_VertexIndex == 0, gl_VertexIndex == 1, gl_VertexIndex == 2);
}
