#include "regress/worker_pool.hpp"

#include <algorithm>
#include <chrono>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <set>

#include "platform/process.hpp"

namespace speculum {

namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t maxLogLines = 20;
constexpr double pollSeconds = 0.1;   // until the next look at whether the run was interrupted
constexpr double exitSeconds = 10.0;  // time for a worker to end by itself

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Jobs that are left. A worker keeps to one group, because loading another scene takes time.
class JobQueue {
 public:
  explicit JobQueue(const std::vector<WorkerJob>& jobs) : jobs_(jobs) {
    for (size_t i = 0; i < jobs.size(); ++i) {
      left_.insert(i);
    }
  }

  std::optional<size_t> take(std::string& group) {
    const std::lock_guard lock(mutex_);
    const auto first = [&](const auto& suits) { return std::find_if(left_.begin(), left_.end(), suits); };
    auto job = first([&](size_t i) { return jobs_[i].group == group; });
    if (job == left_.end()) {
      job = first([&](size_t i) { return !taken_.contains(jobs_[i].group); });
    }
    if (job == left_.end()) {
      job = left_.begin();
    }
    if (job == left_.end()) {
      return std::nullopt;
    }
    const size_t index = *job;
    left_.erase(job);
    group = jobs_[index].group;
    taken_.insert(group);
    return index;
  }

 private:
  const std::vector<WorkerJob>& jobs_;
  std::set<size_t> left_;
  std::set<std::string> taken_;  // groups of which a worker has begun a job
  std::mutex mutex_;
};

// Sends a job to the worker and waits for the reply; returns nothing when interrupted.
std::optional<WorkerReply> ask(ChildProcess& worker, const WorkerJob& job) {
  const Clock::time_point start = Clock::now();
  worker.write(job.request + "\n");
  WorkerReply reply;
  const auto addToLog = [&](std::string line) {
    if (reply.log.size() == maxLogLines) {
      reply.log.erase(reply.log.begin());
    }
    reply.log.push_back(std::move(line));
  };
  while (!interruptRequested()) {
    const std::optional<std::string> line = worker.readLine(std::min(pollSeconds, job.timeout));
    reply.seconds = secondsSince(start);
    if (line && line->starts_with(workerReplyMark)) {
      reply.text = line->substr(workerReplyMark.size());
      return reply;
    }
    if (line) {
      if (!line->empty()) {
        addToLog(*line);
      }
    } else if (!worker.running()) {
      const ProcessResult result = worker.wait();
      if (!result.output.empty()) {
        addToLog(result.output);
      }
      reply.end = JobEnd::crashed;
      reply.text = result.exitCode > 128 ? "the worker was ended by signal " + std::to_string(result.exitCode - 128)
                                         : "the worker ended with exit code " + std::to_string(result.exitCode) +
                                               (reply.log.empty() ? "" : ": " + reply.log.back());
      return interruptRequested() ? std::nullopt : std::optional(reply);
    }
    if (reply.seconds > job.timeout) {
      worker.kill();
      reply.end = JobEnd::timedOut;
      reply.text = "no picture within the timeout";
      return reply;
    }
  }
  return std::nullopt;
}

// Ends the worker, but leaves it time to write its caches.
void finish(ChildProcess& worker) {
  const Clock::time_point start = Clock::now();
  worker.closeInput();
  while (worker.running() && secondsSince(start) < exitSeconds) {
    worker.readLine(exitSeconds);
  }
  worker.kill();
}

}  // namespace

bool runWorkers(const std::vector<std::string>& command, int workers, const std::vector<WorkerJob>& jobs,
                const std::function<void(size_t job, const WorkerReply& reply)>& done) {
  JobQueue queue(jobs);
  std::mutex mutex;
  size_t ended = 0;
  const auto work = [&] {
    std::unique_ptr<ChildProcess> worker;
    std::string group;
    while (const std::optional<size_t> index = queue.take(group)) {
      std::optional<WorkerReply> reply;
      try {
        if (!worker) {
          worker = std::make_unique<ChildProcess>(command, ChildProcess::Input::pipe);
        }
        reply = ask(*worker, jobs[*index]);
      } catch (const std::exception& error) {
        reply = {.end = JobEnd::crashed, .text = error.what()};
      }
      if (!reply) {
        return;
      }
      if (reply->end != JobEnd::answered) {
        worker.reset();
      }
      const std::lock_guard lock(mutex);
      done(*index, *reply);
      ++ended;
    }
    if (worker) {
      finish(*worker);
    }
  };
  std::vector<std::future<void>> threads;
  for (int i = 0; i < std::clamp(workers, 1, static_cast<int>(std::max<size_t>(1, jobs.size()))); ++i) {
    threads.push_back(std::async(std::launch::async, work));
  }
  for (std::future<void>& thread : threads) {
    thread.get();
  }
  return ended == jobs.size();
}

}  // namespace speculum
