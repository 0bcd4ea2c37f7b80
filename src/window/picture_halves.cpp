#include "window/picture_halves.hpp"

#include "image/image.hpp"

namespace speculum {

PictureHalf::PictureHalf(Renderer& renderer, const Scene& scene)
    : renderer(std::make_unique<SceneRenderer>(renderer, scene)),
      planner(renderer.device(), true),
      pace(renderer.device().info().isCpu(), renderer.device().caps().sampleCounts) {}

const FittedPlan& PictureHalf::plan(Frame& frame, const Pace::Request& request) {
  const FittedPlan& fitted = pace.plan(request);
  const auto upload = [&] { renderer->uploadTextures(frame, request.frame.state, fitted.settings, fitted.plan); };
  try {
    upload();
  } catch (const OutOfMemoryError& error) {
    planner.leaveOutTextures(error.what());
    pace.leaveOutTextures();
    upload();
  }
  return fitted;
}

Image8 PictureHalf::pixels() {
  return toDisplay(renderer->radiance(), pace.planned().settings.view.displayCurve());
}

std::string PictureHalf::text(const Scene& scene, const Settings& chosen, bool plays) const {
  const FittedPlan& planned = pace.planned();
  // Pausing leads to a mean, for which `auto` chooses an exact lookup where there are rays.
  const bool exact = plays && stillPictures(chosen) > 1 && planned.traces;
  const ShadowLookup lookup = exact ? ShadowLookup::hybrid : planned.settings.effects.shadowLookup;
  const std::string rest = stillText(scene, chosen, lookup);
  if (!pace.text().empty() && plays) {
    return pace.text() + ". Space: pause for the " + (rest.empty() ? "exact picture" : "whole picture (" + rest + ")");
  }
  return pace.lowers() || rest.empty()
             ? pace.text()
             : pace.text() + (pace.text().empty() ? "Approximate: " : "; approximate: ") + rest;
}

void PictureHalves::takeTurns(bool split, const Scene& scene) {
  if (!split) {
    return dropB();
  }
  if (!this->split()) {
    renderer_.waitIdle();
    halves_.emplace_back(renderer_, scene);
  }
  drawn_ = 1 - drawn_;
}

void PictureHalves::dropB() {
  if (split()) {
    renderer_.waitIdle();
    nonFinite_ += halves_.back().renderer->finiteWatch().count();
    halves_.pop_back();
  }
  drawn_ = 0;
}

void PictureHalves::useScene(const Scene& scene) {
  dropB();
  PictureHalf& half = drawn();
  renderer_.waitIdle();
  nonFinite_ = nonFinite();
  half.renderer.reset();
  half.planner.forgetScene();
  half.renderer = std::make_unique<SceneRenderer>(renderer_, scene);
  half.frame = 0;
  half.pace.sceneChanged();
}

const FrameTimings& PictureHalves::timings() const {
  static const FrameTimings none;
  const FrameTimings* found = split() ? renderer_.timingsOf(drawn().frame) : &renderer_.timings();
  return found ? *found : none;
}

uint64_t PictureHalves::finishedFrame(const PictureHalf& half) const {
  if (!split()) {
    return renderer_.timings().frame;
  }
  constexpr uint64_t turn = 2;  // frames from one that draws the half to the next
  return renderer_.timingsOf(half.frame) ? half.frame : half.frame - std::min(half.frame, turn);
}

uint64_t PictureHalves::nonFinite() const {
  uint64_t sum = nonFinite_;
  for (const PictureHalf& half : halves_) {
    sum += half.renderer ? half.renderer->finiteWatch().count() : 0;  // none if useScene() has failed
  }
  return sum;
}

std::string PictureHalves::problem() const {
  const auto prefix = [this](const PictureHalf& half) {
    return std::string(!split() ? "" : &half == &at(0) ? "A: " : "B: ");
  };
  for (const PictureHalf& half : halves_) {
    const FiniteWatch& watch = half.renderer->finiteWatch();
    if (watch.findingsFrame() > 0 && watch.findingsFrame() >= finishedFrame(half)) {
      return prefix(half) + describe(watch.findings().front());
    }
  }
  for (const PictureHalf& half : halves_) {
    if (!half.planner.message().empty()) {
      return prefix(half) + half.planner.message();
    }
  }
  return "";
}

}  // namespace speculum
