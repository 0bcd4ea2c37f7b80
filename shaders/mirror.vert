#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"

// The polygon is cut at the pass's clip plane and brought to clip space in double on the CPU.
void main() { gl_Position = mirrorVertices[gl_VertexIndex]; }
