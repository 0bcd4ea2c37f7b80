#include "app/background_sweep.hpp"

#include <tbb/task_arena.h>

#include <algorithm>

#include "app/session_subject.hpp"
#include "app/sweep_description.hpp"

namespace speculum {

namespace {

// Enough for errors to be told apart, and done in a fraction of the time of a report's 64.
constexpr int truthSamples = 16;

// Half of the processor stays with the window.
int backgroundThreads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / 2);
}

SweepResults measure(const SweepRequest& request, const SweepProgress& progress) {
  Session session(request.options);
  session.setCamera(request.camera);
  session.setSettings(request.base);
  SceneState state = evaluate(session.scene(), request.time);
  state.camera = request.camera;
  const SweepPlan plan = viewSweep(sweepContext(session));
  SessionSubject subject(session, request.time);
  SweepStore store;
  const SweepScene scene{.scene = session.scene(),
                         .state = state,
                         .width = request.options.size.width,
                         .height = request.options.size.height,
                         .truthSamples = truthSamples};
  SweepResults results = describeSweep(session, plan, request.time);
  tbb::task_arena arena(backgroundThreads());
  const bool finished =
      arena.execute([&] { return runSweep(plan, request.base, scene, subject, store, results, progress); });
  if (finished && session.device().validationMessages() > 0) {
    throw std::runtime_error("the measurement made validation messages");
  }
  return finished ? results : SweepResults();
}

}  // namespace

void BackgroundSweep::start(SweepRequest request) {
  cancel();
  cancelled_ = false;
  error_.clear();
  status_ = SweepStatus{"starting", 0.0};
  request.base.quality = {};
  request.base.reflection.updateInterval = 1;  // the view stands still
  request.base.debug.checkFinite = false;      // its time is not the settings'
  request.options.settings.clear();
  request.options.sweepResults.clear();
  thread_ = std::thread([this, request = std::move(request)] { run(request); });
}

void BackgroundSweep::cancel() {
  cancelled_ = true;
  if (thread_.joinable()) {
    thread_.join();
  }
}

void BackgroundSweep::run(const SweepRequest& request) {
  std::string error;
  SweepResults results;
  try {
    results = measure(request, [this](const SweepStatus& status) {
      const std::lock_guard lock(mutex_);
      status_ = status;
      return !cancelled_;
    });
  } catch (const std::exception& problem) {
    error = problem.what();
  }
  const std::lock_guard lock(mutex_);
  status_.reset();
  error_ = error;
  if (!results.points.empty()) {
    results_ = std::move(results);
  }
}

std::optional<SweepStatus> BackgroundSweep::status() {
  const std::lock_guard lock(mutex_);
  return status_;
}

std::optional<SweepResults> BackgroundSweep::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(results_, std::nullopt);
}

std::string BackgroundSweep::error() {
  const std::lock_guard lock(mutex_);
  return error_;
}

}  // namespace speculum
