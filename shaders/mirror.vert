#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"

// A reflection that is added to a base passes the test for equal depth only if both draws have the same positions.
invariant gl_Position;

// The polygon is cut at the pass's clip plane and brought to clip space in double on the CPU.
void main() { gl_Position = mirrorVertices[gl_VertexIndex]; }
