#pragma once

#include <vector>

#include "accuracy/sweep.hpp"
#include "accuracy/sweep_planner.hpp"
#include "session/session.hpp"

namespace speculum {

// A session's scene at one time, for a sweep to measure.
class SessionSubject : public SweepSubject {
 public:
  // Keeps the session, which must outlive it.
  SessionSubject(Session& session, double time) : session_(session), time_(time) {}

  // Frames of update intervals are 1/30 s apart; the last one is at the sweep's time.
  std::vector<Image8> pictures(const Settings& settings) override;
  std::string work() const override;
  FrameCost cost(const Settings& settings) override;

 private:
  // Draws a `whole` mean, or its first picture.
  void drawEarlierFrame(int framesBefore, bool capture, bool whole);

  Session& session_;
  double time_;
};

// The sample counts among 1, 2, 4 and 8 that the device has.
std::vector<int> sampleCountsOf(const Device& device);

// Returns the settings that a sweep over the session's scene can vary.
SweepContext sweepContext(Session& session);

// Returns results without measurements: scene, machine, device, date, base settings.
SweepResults describeSweep(Session& session, const SweepPlan& plan, double time);

// Returns a fingerprint of everything but the settings that pictures and times depend on: this build with its shaders,
// scene, device, machine, size, time, validation.
std::string sweepIdentity(Session& session, const Options& options);

std::string utcNow();  // ISO 8601, with seconds

}  // namespace speculum
