// Random numbers, the same on every run.
#ifndef RANDOM
#define RANDOM

uint mixedBits(uint x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

float unitInterval(uint bits) { return float(bits >> 8) * (1.0 / 16777216.0); }

vec2 randomPair(uint seed) { return vec2(unitInterval(seed), unitInterval(mixedBits(seed))); }

// Returns a seed for a position in pixels, in steps of 1/16.
uint seedAt(vec2 position) { return mixedBits(uint(position.x * 16.0) + mixedBits(uint(position.y * 16.0))); }
#endif
