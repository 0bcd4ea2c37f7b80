#pragma once

#include "session/options.hpp"

namespace speculum {

// Takes the text of --camera: points, or the name of a bookmark. Throws UsageError.
void setCamera(Options& options, const std::string& text);

// Parses the command line. Returns nothing when help or the version was printed. Throws UsageError.
std::optional<Options> parseOptions(int argc, const char* const* argv);

// Each of these functions runs a command and returns the process's exit code: 0 success, 1 a failed comparison or
// check. Bad usage and bad input throw UsageError or InputError, which are exit code 2.
int runRender(const Options& options);
int runBench(const Options& options);
int runReference(const Options& options);
int runCompare(const Options& options);
int runAccuracy(const Options& options);
int runRegress(const Options& options);

// The whole of main(): parses the command line, runs the command, and turns exceptions into one line on stderr and an
// exit code.
int speculumMain(int argc, const char* const* argv);

}  // namespace speculum
