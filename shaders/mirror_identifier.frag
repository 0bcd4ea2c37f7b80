#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"
#include "identifiers.glsl"

layout(constant_id = constantBaseOnly) const bool baseOnly = false;

layout(location = 0) out vec4 color;

void main() { color = encoded(Identifier(true, baseOnly, drawnMirror.index, 0)); }
