#version 450
#extension GL_GOOGLE_include_directive : require
#include "gpu_data.h"
#include "identifiers.glsl"

layout(constant_id = constantBaseOnly) const bool baseOnly = false;

layout(push_constant) uniform Draw { DrawConstants draw; };

layout(location = 3) flat in uint instanceIndex;

layout(location = 0) out vec4 color;

void main() {
  color = encoded(Identifier(false, baseOnly, instanceIndex, draw.firstTriangle + uint(gl_PrimitiveID)));
}
