#pragma once

#include <memory>

#include "core/off_screen.hpp"
#include "frame/frame_plan.hpp"

namespace speculum {

// Target of the main view. While its tiles are drawn, the display shows the main view of an earlier frame, which then
// has a target of its own.
class MainTargets {
 public:
  explicit MainTargets(Device& device) : device_(device) {}

  // Begins a picture of the plan. `displayed`: the display shows drawn(). If the plan has tiles, that target then stays
  // shown() until finish(), and drawn() is another one.
  void begin(const Settings& settings, const FramePlan& plan, bool displayed, RetireQueue& retired);
  // Shows the picture, whose last tile is drawn.
  void finish(RetireQueue& retired) { retired.take(earlier_); }

  OffScreen& drawn() { return *drawn_; }
  OffScreen& shown() { return earlier_ ? *earlier_ : *drawn_; }

 private:
  Device& device_;
  std::unique_ptr<OffScreen> drawn_;
  std::unique_ptr<OffScreen> earlier_;  // null if drawn_ is shown
};

}  // namespace speculum
