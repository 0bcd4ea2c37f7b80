#pragma once

#include <cstdlib>
#include <vector>

namespace speculum::testing_support {

// Says whether random sets run whole and scenes in full size, as in scripts/test-long: SPECULUM_FULL_TESTS=1 in the
// environment.
inline bool fullTests() {
  const char* value = std::getenv("SPECULUM_FULL_TESTS");
  return value != nullptr && *value == '1';
}

// The seeds 0 to count - 1 in a full run, else every `step`th of them.
inline std::vector<unsigned> sampledSeeds(unsigned count, unsigned step) {
  std::vector<unsigned> seeds;
  for (unsigned seed = 0; seed < count; seed += fullTests() ? 1 : step) {
    seeds.push_back(seed);
  }
  return seeds;
}

}  // namespace speculum::testing_support
