// Surfaces with coverage in a shadow map. VERTEX_COLORS as in covered_draw.glsl.
#include "interface.glsl"
#include "shading.glsl"
#include "covered_draw.glsl"
#include "shadow_plane.glsl"

layout(location = 2) centroid in vec2 textureUv;
layout(location = 3) flat in uint instanceIndex;

void main() {
  storePlane();
  keepCovered(textureUv, instances[instanceIndex].traceInstance, draw.firstTriangle + uint(gl_PrimitiveID));
}
