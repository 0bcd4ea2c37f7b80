#pragma once

#include "app/options.hpp"

namespace speculum {

// `speculum bench --against-binary FILE` and `--against-set KEY=VALUE`: runs `bench --json` of this program and of the
// other one, or of this one with the other settings, in turn as processes of their own, and prints the ratios of their
// median times, this one's over the other's. Returns the exit code. Throws UsageError if the other one cannot be run.
int benchAgainst(const Options& options);

}  // namespace speculum
