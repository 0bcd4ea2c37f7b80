#pragma once

#include <functional>

#include "app/motion_controller.hpp"
#include "app/movement.hpp"
#include "core/gpu_timer.hpp"
#include "frame/memory_fit.hpp"

namespace speculum {

// Quality of the window's frames: what was chosen while nothing moves, and as much of it as fits into a budget of
// milliseconds while something does.
class Pace {
 public:
  // `sampleCounts`: those that the device has, as a sum.
  Pace(bool cpuDevice, unsigned sampleCounts)
      : cpuDevice_(cpuDevice), sampleCounts_(sampleCounts), controller_(cpuDevice) {}

  // A frame begins; its camera, and whether anything else moves in it.
  void begin(const CameraPose& camera, bool otherwise, double seconds);
  bool moving() const { return movement_.moving(); }
  // Whether another frame is needed although nothing happens.
  bool wantsFrame() const { return movement_.ending(); }

  // Plans the frame with the settings that were chosen or, while anything moves and `budgetMs` is above 0, lower ones.
  // `front`: as motionLevels takes it. `plan` is called a few times, last for the plan that is returned.
  using Planner = std::function<FittedPlan(const Settings&)>;
  FittedPlan plan(const Settings& chosen, double budgetMs, std::span<const MotionLevel> front, const Scene& scene,
                  const SceneState& state, const Planner& plan);

  // The frame was recorded: milliseconds of the CPU without waiting, and whether its times say what such a frame costs.
  void drawn(uint64_t number, double cpuMs, bool usual);
  // The GPU's times of an earlier frame.
  void finished(const FrameTimings& timings);

  // What the picture gives up for its pace, for the user; empty if nothing moves.
  const std::string& text() const { return text_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Drawn {
    uint64_t number = 0;
    double cpuMs = 0.0;
    Clock::time_point begun;
    double frameMs = 0.0;  // until the next frame began; 0: not yet
  };

  bool cpuDevice_;
  unsigned sampleCounts_;
  Movement movement_;
  MotionController controller_;
  double seconds_ = 0.0;  // since the last frame
  Clock::time_point begun_;
  std::deque<Drawn> drawn_;
  FrameWork work_;  // of the frame that was planned last
  std::string text_;
};

// quality.motion_ms, or what it is by itself: 50 on a CPU, elsewhere 0.8 of the monitor's refresh.
double motionBudget(const Settings& settings, bool cpuDevice, double refreshHz);

}  // namespace speculum
