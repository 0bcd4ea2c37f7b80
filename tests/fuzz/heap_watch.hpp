#pragma once

#include <cstddef>

namespace speculum::fuzz {

// Bytes that operator new has given and not got back: at most, since the last call of restart. The whole program's.
void restartHeapPeak();
size_t heapPeak();

}  // namespace speculum::fuzz
