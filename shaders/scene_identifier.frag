#version 450
#extension GL_GOOGLE_include_directive : require
#include "gpu_data.h"
#include "identifiers.glsl"

layout(constant_id = constantBaseOnly) const bool baseOnly = false;

layout(push_constant) uniform Draw { DrawConstants draw; };

layout(location = 2) flat in uvec2 indexAndReach;

layout(location = 0) out vec4 color;

void main() {
  color = encoded(Identifier(false, baseOnly, indexAndReach.x, draw.firstTriangle + uint(gl_PrimitiveID)));
}
