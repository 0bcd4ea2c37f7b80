#version 450
#extension GL_GOOGLE_include_directive : require
#include "gpu_data.h"

layout(location = 0) out uvec2 plane;

// Stores the mark of an edge. What lies between the texels' centres is not seen, but each of its edges leaves a chain of
// marks.
void main() { plane = uvec2(floatBitsToUint(gl_FragCoord.w), shadowEdge); }
