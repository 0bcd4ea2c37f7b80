#pragma once

#include "core/device.hpp"
#include "core/instance.hpp"

namespace speculum::testing_support {

// Call it before the first device. Some drivers can be loaded only some 30 times by one process; while an instance
// stays they are not unloaded.
inline void keepDriverLoaded() {
  static const Instance kept{DeviceOptions{}};
}

}  // namespace speculum::testing_support
