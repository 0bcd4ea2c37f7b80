// Positions of samples in a pixel: Vulkan specification, "Standard sample locations". Those of n samples begin at index
// n - 1.
const vec2 samplePositions[] = {
  vec2(0.5, 0.5),
  vec2(0.75, 0.75), vec2(0.25, 0.25),
  vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875),
  vec2(0.5625, 0.3125), vec2(0.4375, 0.6875), vec2(0.8125, 0.5625), vec2(0.3125, 0.1875),
  vec2(0.1875, 0.8125), vec2(0.0625, 0.4375), vec2(0.6875, 0.9375), vec2(0.9375, 0.0625),
  vec2(0.5625, 0.5625), vec2(0.4375, 0.3125), vec2(0.3125, 0.625), vec2(0.75, 0.4375),
  vec2(0.1875, 0.375), vec2(0.625, 0.8125), vec2(0.8125, 0.6875), vec2(0.6875, 0.1875),
  vec2(0.375, 0.875), vec2(0.5, 0.0625), vec2(0.25, 0.125), vec2(0.125, 0.75),
  vec2(0.0, 0.5), vec2(0.9375, 0.25), vec2(0.875, 0.9375), vec2(0.0625, 0.0)
};

// Returns the position of sample `i` of `count` in a pixel.
vec2 samplePosition(uint count, uint i) { return samplePositions[count - 1 + i]; }

// Returns the mean position in a pixel of the samples in the bits of `mask`; without any, the centre.
vec2 meanPosition(uint count, uint mask) {
  vec2 sum = vec2(0.0);
  for (uint i = 0; i < count; ++i) {
    sum += (mask & 1 << i) != 0 ? samplePosition(count, i) : vec2(0.0);
  }
  return mask == 0 ? vec2(0.5) : sum / float(bitCount(mask));
}
