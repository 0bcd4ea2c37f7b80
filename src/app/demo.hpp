#pragma once

#include "app/options.hpp"

namespace speculum {

// The window, until it is closed or --frames are drawn. Exit code 1 if the validation layer had anything to say.
int runDemo(const Options& options);

}  // namespace speculum
