#pragma once

#include <functional>
#include <string>
#include <vector>

namespace speculum {

struct WorkerJob {
  std::string request;   // one line
  std::string group;     // a worker prefers jobs of the group of its last job
  double timeout = 0.0;  // seconds
};

enum class JobEnd { answered, crashed, timedOut };

struct WorkerReply {
  JobEnd end = JobEnd::answered;
  std::string text;              // the reply, or how the worker ended
  std::vector<std::string> log;  // last lines that the worker wrote beside the reply
  double seconds = 0.0;
};

// Start of the line that answers a request.
constexpr std::string_view workerReplyMark = "reply ";

// Hands jobs to `workers` processes, a request at a time on their standard input. A worker that ends, or takes longer
// than a job's timeout, is killed and replaced for the next job. Calls `done` for each job, from several threads but
// one at a time. Returns false when interrupted with jobs left. Throws what `done` throws, once all workers have ended.
bool runWorkers(const std::vector<std::string>& command, int workers, const std::vector<WorkerJob>& jobs,
                const std::function<void(size_t job, const WorkerReply& reply)>& done);

}  // namespace speculum
