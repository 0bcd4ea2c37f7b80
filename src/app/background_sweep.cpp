#include "app/background_sweep.hpp"

#include <utility>

#include "app/background_threads.hpp"
#include "app/session_subject.hpp"
#include "app/sweep_description.hpp"

namespace speculum {

namespace {

// Enough for errors to be told apart, and done in a fraction of the time of a report's 64.
constexpr int truthSamples = 16;

// Without points if cancelled.
SweepResults measure(const SweepRequest& request, const SweepProgress& progress) {
  Session session(request.options);
  if (!progress({"starting", 1.0})) {
    return {};
  }
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
  const bool finished =
      inBackground([&] { return runSweep(plan, request.base, scene, subject, store, results, progress); });
  if (finished && session.device().validationMessages() > 0) {
    throw std::runtime_error("the measurement made validation messages");
  }
  return finished ? results : SweepResults();
}

}  // namespace

BackgroundSweep::Job::~Job() {
  cancelled = true;
  if (thread.joinable()) {
    thread.join();
  }
}

void BackgroundSweep::Job::run() {
  try {
    SweepResults measured = measure(request, [this](const SweepStatus& now) {
      const std::lock_guard lock(mutex);
      status = now;
      return !cancelled;
    });
    const std::lock_guard lock(mutex);
    if (!measured.points.empty()) {
      results = std::move(measured);
    }
  } catch (const std::exception& problem) {
    const std::lock_guard lock(mutex);
    error = problem.what();
  }
  ended = true;
}

BackgroundSweep::~BackgroundSweep() {
  cancel();
}

void BackgroundSweep::start(SweepRequest request) {
  cancel();
  request.base.quality = {};
  request.base.reflection.updateInterval = 1;  // the view stands still
  request.base.debug.checkFinite = false;      // its time is not the settings'
  request.options.settings.clear();
  request.options.sweepResults.clear();
  job_ = std::make_unique<Job>();
  job_->request = std::move(request);
  job_->thread = std::thread([job = job_.get()] { job->run(); });
}

void BackgroundSweep::cancel() {
  std::erase_if(cancelled_, [](const std::unique_ptr<Job>& job) { return job->ended.load(); });
  if (job_) {
    job_->cancelled = true;
    cancelled_.push_back(std::move(job_));
  }
}

std::optional<SweepStatus> BackgroundSweep::status() {
  if (!job_ || job_->ended) {
    return std::nullopt;
  }
  const std::lock_guard lock(job_->mutex);
  return job_->status;
}

std::optional<SweepResults> BackgroundSweep::take() {
  if (!job_) {
    return std::nullopt;
  }
  const std::lock_guard lock(job_->mutex);
  return std::exchange(job_->results, std::nullopt);
}

std::optional<std::string> BackgroundSweep::takeError() {
  if (!job_) {
    return std::nullopt;
  }
  const std::lock_guard lock(job_->mutex);
  return std::exchange(job_->error, std::nullopt);
}

}  // namespace speculum
