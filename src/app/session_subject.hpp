#pragma once

#include <vector>

#include "accuracy/sweep.hpp"
#include "app/session.hpp"

namespace speculum {

// A session's scene at one time, for a sweep to measure.
class SessionSubject : public SweepSubject {
 public:
  // Keeps the session, which must outlive it.
  SessionSubject(Session& session, double time) : session_(session), time_(time) {}

  // Frames of update intervals are 1/30 s apart; the last one is at the sweep's time.
  std::vector<Image8> pictures(const Settings& settings) override;
  FrameCost cost(const Settings& settings) override;

 private:
  // Draws a `whole` mean, or its first picture.
  void drawEarlierFrame(int framesBefore, bool capture, bool whole);

  Session& session_;
  double time_;
};

// The sample counts among 1, 2, 4 and 8 that the device has.
std::vector<int> sampleCountsOf(const Device& device);

}  // namespace speculum
