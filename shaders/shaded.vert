#version 450

layout(location = 0) flat out uint drawnSample;

// One triangle that covers the target for each sample.
void main() {
  vec2 corner = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2);
  drawnSample = gl_InstanceIndex;
  gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
