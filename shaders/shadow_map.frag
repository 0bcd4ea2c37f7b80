#version 450
// Stores the disparity from a light.

layout(location = 0) out float disparity;

void main() { disparity = gl_FragCoord.w; }
