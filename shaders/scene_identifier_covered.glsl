// Identifiers of surfaces with coverage, for deferred shading. VERTEX_COLORS as in covered_draw.glsl.
#define HANDED in
#include "interface.glsl"
#include "object_values.glsl"
#include "shading.glsl"
#include "covered_draw.glsl"
#include "identifiers.glsl"

layout(constant_id = constantRepeating) const bool repeating = false;

layout(location = 0) out vec4 color;

void main() {
  uint triangle = draw.firstTriangle + uint(gl_PrimitiveID);
  uint index = instances[indexAndReach.x].repeats + triangle;
  vec2 uv = repeating ? repeatingUv(index, view.traceOffset.xyz, rayThrough(gl_FragCoord.xy))
                      : vec2(positionAndU.w, normalAndV.w);
  color = encoded(Identifier(false, false, indexAndReach.x, triangle));
  keepCovered(uv, instances[indexAndReach.x].traceInstance, triangle);
}
