// Searches an image of radiance and disparity for values that are not finite or not within 0 .. 65504; a disparity may
// be negative, down to -65504: MaskSystem::markOutside(). CHECKED_IMAGE is the image's type. A first dispatch over all
// pixels finds the first such value and counts them all. A second dispatch of one group, with LOOK_UP, reads the first
// value, because only after all invocations of the first dispatch is it certain which value comes first.
#include "gpu_data.h"

layout(local_size_x = 16, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform CHECKED_IMAGE checkedImage;

layout(set = 0, binding = 1, std430) buffer Search { CheckSearch search; };

layout(push_constant) uniform Constants { CheckConstants part; };

int sampleCount(sampler2D image) { return 1; }
int sampleCount(sampler2DMS image) { return textureSamples(image); }
vec4 valueOf(sampler2D image, ivec2 texel, int i) { return texelFetch(image, texel, 0); }
vec4 valueOf(sampler2DMS image, ivec2 texel, int i) { return texelFetch(image, texel, i); }

// Says whether a target may hold the value. Compares bits, because some compilers take isnan() for false: as unsigned
// integers, floats from 0 up keep their order, and infinity, NaN and all floats with the sign bit follow. -0 counts as
// 0.
bool storable(vec4 value) {
  uvec4 bits = floatBitsToUint(value);
  bits.w &= 0x7fffffffu;
  bvec4 zero = equal(bits, uvec4(0x80000000u));
  bvec4 inRange = lessThanEqual(bits, uvec4(floatBitsToUint(65504.0)));
  return all(bvec4(zero.x || inRange.x, zero.y || inRange.y, zero.z || inRange.z, zero.w || inRange.w));
}

#ifdef LOOK_UP
layout(set = 0, binding = 2, std430) writeonly buffer Found { CheckFound found; };

void main() {
  if (gl_LocalInvocationIndex != 0 || search.any == 0) {
    return;
  }
  ivec2 texel = ivec2(search.pixel % part.size.x, search.pixel / part.size.x);
  int i = 0;
  while (i + 1 < sampleCount(checkedImage) && storable(valueOf(checkedImage, texel, i))) {
    ++i;
  }
  found.value = valueOf(checkedImage, texel, i);
  found.sampleIndex = i;
}
#else
void main() {
  uvec2 at = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(at, part.size))) {
    return;
  }
  uint count = 0;
  for (int i = 0; i < sampleCount(checkedImage); ++i) {
    count += storable(valueOf(checkedImage, ivec2(at), i)) ? 0 : 1;
  }
  if (count > 0) {
    atomicMin(search.pixel, at.y * part.size.x + at.x);
    atomicAdd(search.count, count);
    search.any = 1;
  }
}
#endif
