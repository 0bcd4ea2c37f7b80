#pragma once

#include <string>
#include <vector>

namespace speculum {

struct ProcessResult {
  int exitCode = -1;   // 127 when the program was not found
  std::string output;  // stdout and stderr, interleaved
};
// Runs a program found on PATH, without a shell. Blocks until it ends.
ProcessResult runProcess(const std::vector<std::string>& arguments);

void setEnvironment(const std::string& name, const std::string& value);
std::string environment(const std::string& name);  // empty if not set
bool isTerminal(int fileDescriptor);

// Makes Ctrl-C and a termination request only set a flag; a second Ctrl-C ends the process.
void installInterruptHandler();
bool interruptRequested();

}  // namespace speculum
