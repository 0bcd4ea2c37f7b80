#pragma once

#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>

namespace speculum {

// Runs `work` with half of the processor's threads; the rest stays with the window.
template <typename Work>
auto inBackground(const Work& work) {
  tbb::task_arena arena(std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / 2));
  return arena.execute(work);
}

}  // namespace speculum
