#pragma once

#include <mutex>
#include <shared_mutex>

namespace speculum {

// Returns the mutex that guards the loader's list of instances and devices, which threads with devices of their own
// share. Lock it exclusively to make or destroy one. Lock it shared to look up a function, to name an object and to
// make a surface or a swapchain: loaders (at least 1.3.239) search the list for that while another thread may free what
// they look at.
inline std::shared_mutex& loaderMutex() {
  static std::shared_mutex mutex;
  return mutex;
}

}  // namespace speculum
