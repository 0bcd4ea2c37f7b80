#version 450

layout(constant_id = 0) const float level = 0.0;
layout(set = 0, binding = 0) uniform sampler2D source;
layout(location = 0) out vec4 result;

void main() { result = textureLod(source, vec2(0.5), level); }
