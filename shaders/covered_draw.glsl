// Keeps or discards the samples of surfaces with coverage. With VERTEX_COLORS the alpha of the vertices' colors counts
// too. Needs interface.glsl, object_values.glsl and bilinearTexels() of shading.glsl.
#include "coverage.glsl"
#include "sample_positions.glsl"

layout(constant_id = constantSamples) const uint samples = 1;
layout(constant_id = constantClamps) const bool clamps = false;

layout(push_constant) uniform Draw {
  DrawConstants draw;
  float opacity;
  float cutoff;
};

layout(set = 3, binding = 0) uniform sampler2D opacityTexture;

#ifdef VERTEX_COLORS
layout(constant_id = constantVertexAlpha) const bool hasVertexAlpha = false;
float alphaHere() { return hasVertexAlpha ? vertexColor.a : 1.0; }
#else
float alphaHere() { return 1.0; }
#endif

float opacityAt(vec2 uv) {
  BilinearTexels at = bilinearTexels(uv, textureSize(opacityTexture, 0), clamps);
  float a = texelFetch(opacityTexture, at.low, 0).a;
  float b = texelFetch(opacityTexture, ivec2(at.high.x, at.low.y), 0).a;
  float c = texelFetch(opacityTexture, ivec2(at.low.x, at.high.y), 0).a;
  float d = texelFetch(opacityTexture, at.high, 0).a;
  return opacity * mix(mix(a, b, at.weight.x), mix(c, d, at.weight.x), at.weight.y);
}

// Keeps the samples at which the surface is there. Needs uniform control flow.
void keepCovered(vec2 uv, uint instance, uint triangle) {
  vec2 across = dFdx(uv);
  vec2 down = dFdy(uv);
  float alpha = alphaHere();
  vec2 growth = vec2(dFdx(alpha), dFdy(alpha));
  // A mirror's image begins at the view's corner if the mirror covers it. With the depth, what shows through a surface
  // there does not depend on what shows through its image.
  uint seed = seedAt(gl_FragCoord.xy) + mixedBits(view.depth);
  int mask = 0;
  for (uint i = 0; i < samples; ++i) {
    vec2 offset = samplePosition(samples, i) - 0.5;
    float here = (alpha + dot(offset, growth)) * opacityAt(uv + offset.x * across + offset.y * down);
    mask |= int(isThere(here, cutoff, view.picture * samples + i, seed, instance, triangle)) << i;
  }
  if (mask == 0) {
    discard;
  }
  gl_SampleMask[0] = mask;
}
