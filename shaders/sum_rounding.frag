#version 450
// Adds three quarters of a step to the half float 1.

layout(location = 0) out vec4 color;

void main() { color = vec4(0.75 * exp2(-10.0)); }
