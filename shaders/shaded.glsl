// The samples of the area that a pass draws, in deferred shading. SHADED_SET and SHADED_ACCESS qualify the buffer. With
// SHADED_BY_DRAWS the shader declares `samples` and `area` itself. Needs gpu_data.h.

// An identifier (identifiers.glsl), afterwards radiance and disparity: half floats of each sample of each pixel, row by
// row.
layout(set = SHADED_SET, binding = 1, std430) SHADED_ACCESS buffer Shaded { uvec2 shaded[]; };

const uint notShaded = 0xffffffff;  // the sample's color is no identifier

#ifndef SHADED_BY_DRAWS
layout(constant_id = constantSamples) const uint samples = 1;

layout(push_constant) uniform Area { ShadeConstants area; };
#endif

uint pixelNumber(uvec2 pixel) { return pixel.y * area.size.x + pixel.x; }
uint sampleNumber(uint pixel, uint i) { return pixel * samples + i; }
