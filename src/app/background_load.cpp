#include "app/background_load.hpp"

#include <utility>

namespace speculum {

namespace {

struct Cancelled {};

}  // namespace

BackgroundLoad::Job::~Job() {
  cancelled = true;
  if (thread.joinable()) {
    thread.join();
  }
}

void BackgroundLoad::Job::run() {
  try {
    const auto progress = [this](const std::filesystem::path& now, double done) {
      if (cancelled) {
        throw Cancelled();
      }
      const std::lock_guard lock(mutex);
      status = {now, done};
    };
    auto loaded = std::make_unique<LoadedScene>(loadSceneWithSettings(file, options, progress));
    const std::lock_guard lock(mutex);
    scene = std::move(loaded);
  } catch (const Cancelled&) {
    // There is nothing to tell.
  } catch (const std::exception& problem) {
    const std::lock_guard lock(mutex);
    error = problem.what();
  }
  ended = true;
}

BackgroundLoad::~BackgroundLoad() {
  cancel();
}

void BackgroundLoad::start(const std::filesystem::path& file, const Options& options) {
  cancel();
  job_ = std::make_unique<Job>();
  job_->file = file;
  job_->status.file = file;
  job_->options = options;
  job_->thread = std::thread([job = job_.get()] { job->run(); });
}

void BackgroundLoad::cancel() {
  std::erase_if(cancelled_, [](const std::unique_ptr<Job>& job) { return job->ended.load(); });
  if (job_) {
    job_->cancelled = true;
    cancelled_.push_back(std::move(job_));
  }
}

std::optional<LoadStatus> BackgroundLoad::status() {
  if (!running()) {
    return std::nullopt;
  }
  const std::lock_guard lock(job_->mutex);
  return job_->status;
}

bool BackgroundLoad::arrived() {
  if (!job_) {
    return false;
  }
  const std::lock_guard lock(job_->mutex);
  return job_->scene != nullptr;
}

std::unique_ptr<LoadedScene> BackgroundLoad::take() {
  if (!job_) {
    return nullptr;
  }
  const std::lock_guard lock(job_->mutex);
  return std::move(job_->scene);
}

std::optional<std::string> BackgroundLoad::takeError() {
  if (!job_) {
    return std::nullopt;
  }
  const std::lock_guard lock(job_->mutex);
  return std::exchange(job_->error, std::nullopt);
}

}  // namespace speculum
