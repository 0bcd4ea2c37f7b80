#pragma once

#include "core/device.hpp"
#include "core/instance.hpp"

namespace speculum::testing_support {

// Call it before the first device. Some drivers can be loaded only some 30 times by one process; while an instance
// stays they are not unloaded. It stays to the end, because ThreadSanitizer fails a process that unloads a library
// named in a suppression.
inline void keepDriverLoaded() {
  [[maybe_unused]] static const auto* const kept = new Instance{DeviceOptions{}};
}

}  // namespace speculum::testing_support
