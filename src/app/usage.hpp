#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace speculum {

// Returns the end of a command's --help: examples of useful calls, a line each.
std::string examplesText(const std::string& command);

// Returns one line about unknown arguments and what was probably meant. `app` has failed to parse; empty if it left no
// argument over.
std::string unknownArgument(const CLI::App& app);

}  // namespace speculum
