#pragma once

#include <string>
#include <vector>

namespace speculum {

struct ProcessResult {
  int exitCode = -1;   // 127 when the program was not found
  std::string output;  // stdout and stderr, interleaved
};
// Searches PATH and uses no shell. Blocks until the program ends.
ProcessResult runProcess(const std::vector<std::string>& arguments);

void setEnvironment(const std::string& name, const std::string& value);
std::string environment(const std::string& name);  // empty if not set
bool isTerminal(int fileDescriptor);

// After the call, Ctrl-C and a termination request only set a flag.
void installInterruptHandler();
bool interruptRequested();

}  // namespace speculum
