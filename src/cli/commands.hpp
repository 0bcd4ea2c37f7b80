#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "session/options.hpp"

namespace speculum {

// Takes the text of --camera: points, or the name of a bookmark. Throws UsageError.
void setCamera(Options& options, const std::string& text);

// Parses the command line. Returns nothing when help or the version was printed. Throws UsageError.
std::optional<Options> parseOptions(int argc, const char* const* argv);

// Each of these functions runs a command and returns the process's exit code: 0 success, 1 a failed comparison or
// check. Bad usage and bad input throw UsageError or InputError, which are exit code 2.
int runDemo(const Options& options);
int runRender(const Options& options);
int runBench(const Options& options);
int runReference(const Options& options);
int runCompare(const Options& options);
int runAccuracy(const Options& options);
int runRegress(const Options& options);

// The whole of main(): parses the command line, runs the command, and turns exceptions into one line on stderr and an
// exit code.
int speculumMain(int argc, const char* const* argv);

// Progress of long work on stderr: a bar that redraws itself on a terminal, a plain line every few seconds elsewhere.
// Prints nothing for work that is done within a second.
class Progress {
 public:
  // `what` names the work. `total`: argument of set() when all is done.
  Progress(std::string_view what, double total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Report what is done. Return false after Ctrl-C: the work is to end.
  bool advance() { return set(done_ + 1.0); }
  bool set(double done);

 private:
  using Clock = std::chrono::steady_clock;
  void print(double secondsLeft);

  std::string what_;
  double total_;
  double done_ = 0.0;
  double before_ = 0.0;  // `done_` when measuring the pace began
  bool terminal_;
  bool shown_ = false;
  Clock::time_point created_;
  Clock::time_point start_;  // when measuring the pace began
  Clock::time_point last_;   // when progress was printed last
};

}  // namespace speculum
