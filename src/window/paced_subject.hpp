#pragma once

#include <map>

#include "session/session_subject.hpp"
#include "window/pace.hpp"

namespace speculum {

// A session's scene along a path, for a sweep to measure. If there are several frames and quality.motion_ms is a number
// above 0, the window's Pace chooses the settings of each frame, with the times of this device. It goes on learning, so
// the frames that are timed may have other settings than those whose error is measured.
class PacedSubject : public SessionSubject {
 public:
  // Keeps a reference to the session.
  using SessionSubject::SessionSubject;

  std::vector<Image8> pictures(const Settings& settings) override;
  FrameCost cost(const Settings& settings) override;

 protected:
  void drawFrame(int frame, bool capture, bool whole) override;

 private:
  // Calls `measure` with the settings of a moving window, and lets the settings' Pace plan meanwhile. A new Pace first
  // follows the path once, to learn what frames cost.
  template <typename Measure>
  auto paced(const Settings& settings, const Measure& measure);

  std::map<double, Pace> paces_;  // by budget, milliseconds
  Pace* pace_ = nullptr;          // plans the frames; null: they have the settings
};

}  // namespace speculum
