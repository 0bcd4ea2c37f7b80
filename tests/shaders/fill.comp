#version 450

layout(constant_id = 0) const uint factor = 1;
layout(local_size_x = 8) in;
layout(set = 0, binding = 0, std430) buffer Values { uint values[8]; };
layout(push_constant) uniform Push { uint offset; };

void main() { values[gl_LocalInvocationIndex] = offset + factor * gl_LocalInvocationIndex; }
