#pragma once

#include "accuracy/sweep_plan.hpp"
#include "app/session.hpp"

namespace speculum {

// The settings that a sweep over the session's scene can vary.
SweepContext sweepContext(Session& session);

// Results with all that is known before anything is measured: scene, machine, device, date, base settings.
SweepResults describeSweep(Session& session, const SweepPlan& plan, double time);

// Of everything but the settings that pictures and times depend on: this build with its shaders, scene, device,
// machine, size, time, validation.
std::string sweepIdentity(Session& session, const Options& options);

}  // namespace speculum
