#include "app/pace.hpp"

#include <algorithm>

namespace speculum {

namespace {

constexpr double cpuBudgetMs = 50.0;
constexpr double refreshShare = 0.8;
constexpr size_t mostDrawn = 4;  // frames whose times are awaited

}  // namespace

void Pace::begin(const CameraPose& camera, bool otherwise, double seconds) {
  movement_.update(camera, otherwise, seconds);
  seconds_ = seconds;
  begun_ = Clock::now();
  if (!drawn_.empty() && drawn_.back().frameMs == 0.0) {
    drawn_.back().frameMs = std::chrono::duration<double, std::milli>(begun_ - drawn_.back().begun).count();
  }
}

FittedPlan Pace::plan(const Settings& chosen, double budgetMs, std::span<const MotionLevel> front, const Scene& scene,
                      const SceneState& state, const Planner& plan) {
  FittedPlan fitted;
  const auto planned = [&](const Settings& settings) {
    fitted = plan(settings);
    return work_ = workOf(fitted.plan, scene, state, fitted.settings);
  };
  if (!moving() || budgetMs <= 0.0) {
    controller_.stand();
    planned(chosen);
    text_.clear();
    return fitted;
  }
  const std::vector<MotionLevel> levels = motionLevels(chosen, front, sampleCounts_);
  const size_t level = controller_.choose(levels, budgetMs, seconds_, planned);
  text_ = "moving: " + motionText(chosen, levels[level]);
  return fitted;
}

void Pace::drawn(uint64_t number, double cpuMs, bool usual) {
  if (usual) {
    controller_.drawn(number, work_);
  }
  drawn_.push_back({.number = number, .cpuMs = cpuMs, .begun = begun_});
  if (drawn_.size() > mostDrawn) {
    drawn_.pop_front();
  }
}

// On a CPU device drawing competes with the program for the cores: its frames take what both need, or less where they
// overlap. Elsewhere the slower one decides. Waiting for the monitor counts nowhere.
void Pace::finished(const FrameTimings& timings) {
  const auto found = std::ranges::find(drawn_, timings.frame, &Drawn::number);
  if (found == drawn_.end() || !timings.passes.empty()) {
    return;
  }
  const double sum = found->cpuMs + timings.gpuMs;
  const double ms = !cpuDevice_           ? std::max(found->cpuMs, timings.gpuMs)
                    : found->frameMs == 0 ? sum
                                          : std::min(found->frameMs, sum);
  controller_.finished(timings.frame, ms);
  drawn_.erase(drawn_.begin(), found + 1);
}

double motionBudget(const Settings& settings, bool cpuDevice, double refreshHz) {
  return settings.quality.motionMs.value_or(cpuDevice ? cpuBudgetMs : refreshShare * 1000.0 / refreshHz);
}

}  // namespace speculum
