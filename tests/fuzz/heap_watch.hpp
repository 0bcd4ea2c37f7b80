#pragma once

#include <cstddef>

namespace speculum::fuzz {

// Largest number of bytes that operator new had handed out at one time since the last restart, in the whole program.
void restartHeapPeak();
size_t heapPeak();
// Number of calls of operator new so far, in the whole program.
size_t allocations();

}  // namespace speculum::fuzz
