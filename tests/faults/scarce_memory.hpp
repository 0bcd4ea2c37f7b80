#pragma once

#include <cstdint>

namespace speculum::testing_support {

// Makes buffers and images of `fewest` to `most` bytes get no device memory, as on a device without free memory. For
// test programs that link scarce_memory.cpp, which wraps functions of Vulkan.
void refuseMemory(uint64_t fewest, uint64_t most);
void stopRefusingMemory();  // allocations succeed as usual again
int refusedAllocations();   // so far

}  // namespace speculum::testing_support
