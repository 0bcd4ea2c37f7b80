#version 450
#extension GL_GOOGLE_include_directive : require
#include "../../shaders/srgb.glsl"

layout(local_size_x = 256) in;
layout(set = 0, binding = 0, std430) buffer Values { float values[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  values[i] = srgbEncode(vec3(values[i])).x;
}
