#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace speculum {

struct ProcessResult {
  int exitCode = -1;   // 127 when the program was not found
  std::string output;  // stdout and stderr, interleaved
};
// Runs a program found on PATH, without a shell. Blocks until it ends.
ProcessResult runProcess(const std::vector<std::string>& arguments);

std::filesystem::path findProgram(const std::string& name);  // in PATH; empty if it is not there

// A program that runs beside this one. Destruction ends it.
class ChildProcess {
 public:
  explicit ChildProcess(const std::vector<std::string>& arguments);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  ProcessResult wait();
  // wait() without waiting: nothing while the program runs. Call neither afterwards.
  std::optional<ProcessResult> poll();

 private:
  bool read();  // false at the end of the output

  int child_ = 0;       // 0: there is none
  int descriptor_ = 0;  // of its output
  ProcessResult result_;
};

void setEnvironment(const std::string& name, const std::string& value);
std::string environment(const std::string& name);  // empty if not set
bool isTerminal(int fileDescriptor);

// Makes Ctrl-C, a closed terminal and a termination request only set a flag; a second Ctrl-C ends the process.
void installInterruptHandler();
bool interruptRequested();

}  // namespace speculum
