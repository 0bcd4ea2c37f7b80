// Surfaces with coverage in a shadow map. VERTEX_COLORS as in covered_draw.glsl.
#define HANDED in
#define OBJECT
#include "interface.glsl"
#include "object_values.glsl"
#include "shading.glsl"
#include "covered_draw.glsl"
#include "shadow_plane.glsl"

void main() {
  storePlane();
  bool hidesNothing = holdsLight();
  keepCovered(vec2(positionAndU.w, normalAndV.w), instances[indexAndReach.x].traceInstance, draw.firstTriangle + uint(gl_PrimitiveID));
  if (hidesNothing) {
    discard;
  }
}
