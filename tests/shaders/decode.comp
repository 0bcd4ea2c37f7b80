#version 450

layout(local_size_x = 256) in;
layout(set = 0, binding = 0) uniform sampler2D source;
layout(set = 0, binding = 1, std430) buffer Values { float values[256]; };

void main() { values[gl_LocalInvocationIndex] = texelFetch(source, ivec2(gl_LocalInvocationIndex, 0), 0).r; }
