#pragma once

#include <vector>

#include "accuracy/sweep.hpp"
#include "accuracy/sweep_planner.hpp"
#include "session/session.hpp"

namespace speculum {

// A session's scene at one time, for a sweep to measure.
class SessionSubject : public SweepSubject {
 public:
  // Keeps a reference to the session.
  SessionSubject(Session& session, double time) : session_(session), time_(time) {}

  // With an update interval, frames are 1/30 s apart, and the last one is at the sweep's time.
  std::vector<Image8> pictures(const Settings& settings) override;
  std::string work() const override;
  FrameCost cost(const Settings& settings) override;

 private:
  // Draws the frame that comes `framesBefore` frames before the last one: the `whole` mean, or only its first picture.
  void drawEarlierFrame(int framesBefore, bool capture, bool whole);

  Session& session_;
  double time_;
};

// Returns the sample counts among 1, 2, 4 and 8 that the device has.
std::vector<int> sampleCountsOf(const Device& device);

// Returns the settings that a sweep over the session's scene can vary.
SweepContext sweepContext(Session& session);

// Returns results without measurements: scene, machine, device, date, base settings.
SweepResults describeSweep(Session& session, const SweepPlan& plan, double time);

// Returns a fingerprint of everything that pictures and times depend on, except the settings: this build with its
// shaders, scene, device, machine, size, time, validation.
std::string sweepIdentity(Session& session, const Options& options);

std::string utcNow();  // ISO 8601, with seconds

}  // namespace speculum
