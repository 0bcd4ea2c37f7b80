#include "window/background_job.hpp"

#include <tbb/task_arena.h>

namespace speculum {

void inBackground(const std::function<void()>& work) {
  tbb::task_arena(std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / 2)).execute(work);
}

}  // namespace speculum
