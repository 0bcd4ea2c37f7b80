// Lists the surfaces that a pass identified. Each is shaded once for all samples of a pixel that see it, or once for
// each of these samples. SURFACES is the type of the pass's color target.
#include "gpu_data.h"
#include "identifiers.glsl"
#define SHADED_SET 0
#define SHADED_ACCESS writeonly
#include "shaded.glsl"
#include "requests.glsl"

const uint groupSide = 8;
const uint groupSize = groupSide * groupSide;
const uint mostSamples = 16;

layout(local_size_x = groupSide, local_size_y = groupSide) in;

layout(constant_id = constantPerSample) const bool perSample = false;

layout(set = 0, binding = 0) uniform SURFACES surfaces;

shared uint found[groupSize * mostSamples];
shared uint foundCount;
shared uint first;  // index of the group's first request

vec4 colorAt(uvec2 pixel, uint i) { return texelFetch(surfaces, area.corner + ivec2(pixel), int(i)); }

// Reflections in planar mirrors are shaded for each sample: edges in them need antialiasing.
bool shadesEachSample(vec4 color) {
  Identifier id = decoded(color);
  return perSample || (id.mirror && !id.baseOnly);
}

void collect(uvec2 pixel) {
  uint number = pixelNumber(pixel);
  for (uint i = 0; i < samples; ++i) {
    vec4 color = colorAt(pixel, i);
    bool identified = isIdentifier(color);
    shaded[sampleNumber(number, i)] =
        identified ? uvec2(packHalf2x16(color.rg), packHalf2x16(color.ba)) : uvec2(notShaded);
    if (identified) {
      bool alone = shadesEachSample(color);
      uint seenBy = 0;
      for (uint j = 0; j < samples; ++j) {
        bool same = j == i || (!alone && colorAt(pixel, j) == color);
        seenBy |= uint(same) << j;
      }
      if (findLSB(seenBy) == int(i)) {
        found[atomicAdd(foundCount, 1)] = number << samples | seenBy;
      }
    }
  }
}

void main() {
  if (gl_LocalInvocationIndex == 0) {
    foundCount = 0;
  }
  barrier();
  if (all(lessThan(gl_GlobalInvocationID.xy, area.size))) {
    collect(gl_GlobalInvocationID.xy);
  }
  barrier();
  if (gl_LocalInvocationIndex == 0) {
    first = atomicAdd(requestCount, foundCount);
    atomicMax(requestGroups, (first + foundCount + requestsPerGroup - 1) / requestsPerGroup);
  }
  barrier();
  for (uint i = gl_LocalInvocationIndex; i < foundCount; i += groupSize) {
    requests[first + i] = found[i];
  }
}
