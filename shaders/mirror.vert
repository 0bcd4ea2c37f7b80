#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl"

// A mirror drawn in two layers meets its own depth again.
invariant gl_Position;

// The polygon is cut at the pass's clip plane and brought to clip space in double on the CPU.
void main() { gl_Position = mirrorVertices[gl_VertexIndex]; }
