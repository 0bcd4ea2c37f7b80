// Identifiers of surfaces with coverage, for deferred shading. VERTEX_COLORS as in covered_draw.glsl.
#include "interface.glsl"
#include "shading.glsl"
#include "covered_draw.glsl"
#include "identifiers.glsl"

layout(constant_id = constantRepeating) const bool repeating = false;

layout(location = 2) centroid in vec2 textureUv;
layout(location = 3) flat in uint instanceIndex;

layout(location = 0) out vec4 color;

void main() {
  uint triangle = draw.firstTriangle + uint(gl_PrimitiveID);
  uint index = instances[instanceIndex].repeats + triangle;
  vec2 uv = repeating ? repeatingUv(index, view.traceOffset.xyz, rayThrough(gl_FragCoord.xy)) : textureUv;
  color = encoded(Identifier(false, false, instanceIndex, triangle));
  keepCovered(uv, instances[instanceIndex].traceInstance, triangle);
}
