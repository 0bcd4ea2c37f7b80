#pragma once

#include <ctime>

namespace speculum::testing_support {

// Seconds of processor time that the process has taken, with all its threads. Other programs on the machine do not add
// to it.
inline double processorSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace speculum::testing_support
