#pragma once

#include <cstdint>

namespace speculum::testing_support {

// From now on allocations of device memory of so many bytes, the last number included, fail as those of a device that
// has no more. For the test programs that link scarce_memory.cpp, whose vkAllocateMemory then takes the loader's place.
void refuseMemory(uint64_t fewest, uint64_t most);
void giveMemory();         // as usual again
int refusedAllocations();  // so far

}  // namespace speculum::testing_support
