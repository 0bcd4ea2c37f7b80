#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace speculum {

// The end of a command's --help: calls of the program that do something useful, a line each.
std::string examplesText(const std::string& command);

// What is wrong with arguments that nothing takes, and what was probably meant: one line. `app` has failed to parse;
// empty if it left no argument over.
std::string unknownArgument(const CLI::App& app);

}  // namespace speculum
