// Rounding to the half floats of color targets: devices may round what they store as they like.

// Returns the noise of a pixel, moved by `turn`, -1/2 .. 1/2: Jimenez, "Next Generation Post Processing in Call of Duty:
// Advanced Warfare" (2014), interleaved gradient noise.
float storeNoise(vec2 pixel, float turn) {
  return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))) + turn) - 0.5;
}

// Returns v >= 0 plus `part` steps of half floats at the nearest half float, a tie at the even one. `large` is 2^13 times
// the power of two below v: floats there are one step of v apart, so that a sum with it is rounded to a step.
vec4 nearestHalf(vec4 v, vec4 part) {
  vec4 large = uintBitsToFloat(max(floatBitsToUint(v) & 0x7f800000u, uvec4(0x38800000u)) + 0x06800000u);
  precise vec4 sum = v + large * (part * exp2(-23.0)) + large;
  precise vec4 rounded = sum - large;
  // Noise must not lead beyond the largest half float; NaN stays what it is.
  return mix(rounded, vec4(65504.0), greaterThan(rounded, vec4(65504.0)));
}
