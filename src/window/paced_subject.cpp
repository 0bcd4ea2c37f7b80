#include "window/paced_subject.hpp"

#include <memory>

namespace speculum {

template <typename Measure>
auto PacedSubject::paced(const Settings& settings, const Measure& measure) {
  session_.renderer().setTimerDetail(TimerDetail::frame);
  const double budgetMs = path_.frames > 1 ? settings.quality.motionMs.value_or(0.0) : 0.0;
  if (budgetMs == 0.0) {
    return measure(settings);
  }
  Settings moving = settings;
  moving.view.accumulate = 1;
  const auto [pace, isNew] = paces_.try_emplace(budgetMs, session_.device().info().isCpu(),
                                                static_cast<unsigned>(session_.device().caps().sampleCounts));
  pace_ = &pace->second;
  const std::unique_ptr<PacedSubject, void (*)(PacedSubject*)> planning(this, [](PacedSubject* subject) {
    subject->session_.setPlanning({});
    subject->pace_ = nullptr;
  });
  session_.setPlanning([this, budgetMs](const FrameRequest& asked, PicturePlanner& planner) {
    pace_->begin(asked.state.camera, true, 1.0 / path_.fps);
    return pace_->plan({.frame = asked, .planner = planner, .shown = {}, .budgetMs = budgetMs, .front = {}});
  });
  if (isNew) {
    follow(moving, false);
  }
  return measure(moving);
}

std::vector<Image8> PacedSubject::pictures(const Settings& settings) {
  return paced(settings, [&](const Settings& used) { return SessionSubject::pictures(used); });
}

FrameCost PacedSubject::cost(const Settings& settings) {
  return paced(settings, [&](const Settings& used) { return SessionSubject::cost(used); });
}

void PacedSubject::drawFrame(int frame, bool capture, bool whole) {
  SessionSubject::drawFrame(frame, capture, whole);
  if (pace_) {
    const DrawnFrame& drawn = session_.lastFrame();
    pace_->drawn(drawn.number, drawn.cpuMs, 0.0, true);
    pace_->presented(0.0);
    pace_->finished({.frame = drawn.number, .gpuMs = drawn.gpuMs});
  }
}

}  // namespace speculum
