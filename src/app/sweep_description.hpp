#pragma once

#include "accuracy/sweep_plan.hpp"
#include "app/session.hpp"

namespace speculum {

// Returns the settings that a sweep over the session's scene can vary.
SweepContext sweepContext(Session& session);

// Returns results without measurements: scene, machine, device, date, base settings.
SweepResults describeSweep(Session& session, const SweepPlan& plan, double time);

// Returns a fingerprint of everything but the settings that pictures and times depend on: this build with its shaders,
// scene, device, machine, size, time, validation.
std::string sweepIdentity(Session& session, const Options& options);

std::string utcNow();  // ISO 8601, with seconds

}  // namespace speculum
