// Coverage: the share of a surface that is there; the rest shows what is behind. A random threshold decides it for each
// sample of each picture, and the mean of the pictures shows the share. Needs interface.glsl.
#include "random.glsl"

// Laine, Karras, "Stratified Sampling for Stochastic Transparency" (2011), with the constants of Vegdahl.
uint permutedUpwards(uint bits, uint seed) {
  bits += seed;
  bits ^= bits * 0x6c50b47cu;
  bits ^= bits * 0xb82f1e52u;
  bits ^= bits * 0xc7afe638u;
  return bits ^ (bits * 0x8d22f6e6u);
}

// Returns number `index` of a seed's sequence in 0 .. 1, both excluded. Each aligned run of 2^n numbers has one in each
// of 2^n intervals. Sequences of different seeds are shuffled independently, so that the surfaces behind each other
// cover independently: Burley, "Practical Hash-based Owen Scrambling" (2020).
float thresholdAt(uint index, uint seed) {
  uint shuffled = bitfieldReverse(permutedUpwards(bitfieldReverse(index), seed));
  uint bits = bitfieldReverse(permutedUpwards(shuffled, mixedBits(seed)));
  return (float(bits >> 8) + 0.5) * (1.0 / 16777216.0);
}

// Says whether a surface is there. `cutoff` is Material::leastOpacity(), `seed` that of the ray or pixel.
bool isThere(float opacity, float cutoff, uint index, uint seed, uint instance, uint triangle) {
  float random = thresholdAt(index, mixedBits(seed + mixedBits(instance * 0x9e3779b9u + triangle)));
  return opacity >= (cutoff < 0.0 ? random : cutoff);
}
