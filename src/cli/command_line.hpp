#pragma once

#include "session/options.hpp"

namespace speculum {

// Takes the text of --camera: points, or the name of a bookmark. Throws UsageError.
void setCamera(Options& options, const std::string& text);

// Parses the command line. Returns nothing when help or the version was printed. Throws UsageError.
std::optional<Options> parseOptions(int argc, const char* const* argv);

}  // namespace speculum
