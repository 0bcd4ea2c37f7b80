#pragma once

#include <cstdint>
#include <string>

namespace speculum {

std::string machineDescription();  // processor, its threads, operating system
uint64_t peakResidentBytes();      // of this process
double millisecondsSinceStart();   // of this process, to 10 ms; 0 if the system does not say

// Keeps up to 64 MiB of freed memory a thread in the process. A Vulkan driver that draws on the CPU (lavapipe)
// allocates and frees the vertices of every draw; the C library would hand them back to the system each time and fault
// the same pages in again at the next draw. The user's own MALLOC_ variables take precedence.
void keepFreedMemory();

// Makes what() of each std::bad_alloc that operator new throws from now on say what would help. If the process's
// address space is limited, also turns an abort or fault into that line and exit code 2: drivers abort or fault where
// memory is short.
void explainLackOfMemory();
// Returns advice to raise the limit of the address space, as ` (...)`; an empty text if there is no limit.
std::string memoryLimitAdvice();

// Gives the memory that is freed so far back to the system. Takes some milliseconds.
void releaseFreedMemory();

}  // namespace speculum
