#version 450
#extension GL_GOOGLE_include_directive : require
#include "../common/display.glsl"

layout(set = 0, binding = 1) uniform sampler2D image;  // linear radiance

layout(location = 0) in vec2 uv;

// The picture's rows run from the top, and uv from the bottom.
void main() { show(texture(image, vec2(uv.x, 1.0 - uv.y)).rgb); }
