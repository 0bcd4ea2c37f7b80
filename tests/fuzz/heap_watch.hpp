#pragma once

#include <cstddef>

namespace speculum::fuzz {

// Largest number of bytes that operator new had handed out at one time since the last restart, in the whole program.
void restartHeapPeak();
size_t heapPeak();

}  // namespace speculum::fuzz
