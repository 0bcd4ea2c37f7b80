#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"

// A mirror drawn in two layers passes the test for equal depth only if its positions are the same.
invariant gl_Position;

// The polygon is cut at the pass's clip plane and brought to clip space in double on the CPU.
void main() { gl_Position = mirrorVertices[gl_VertexIndex]; }
