#include "window/split_view.hpp"

#include <algorithm>
#include <utility>

namespace speculum {

namespace {

constexpr double narrowest = 0.02;  // share of the picture's width that each half keeps

}  // namespace

Settings naiveSettings(const Settings& settings) {
  Settings naive = settings;
  naive.reflection.scale = 0.25;
  naive.reflection.samples = naive.view.samples = 1;
  naive.reflection.maxDepth = 1;
  naive.view.accumulate = naive.quality.stillPictures = 1;
  naive.effects.shadowLookup = ShadowLookup::map;
  naive.effects.roughLookup = naive.effects.rippleLookup = ReflectionSource::image;
  naive.effects.curvedLookup = CurvedLookup::environment;
  naive.effects.environmentBox = false;
  naive.effects.castsLight = false;
  lowerLimit(settings.reflection, naive);
  return naive;
}

SplitView::SplitView(std::vector<Lesson> lessons) : lessons_(std::move(lessons)) {
  for (const Lesson& lesson : lessons_) {
    shown_.lessons.push_back({lesson.scene, lesson.title, lesson.text, lesson.lookFor});
  }
}

void SplitView::begin(const Settings& a, const Settings& b, double divider) {
  end();
  settings_ = {a, b};
  shown_.on = true;
  choose(1);
  moveDivider(divider);
}

void SplitView::beginLesson(size_t lesson, const Settings& ofScene, double divider) {
  begin(lessons_[lesson].settingsOf(0, ofScene), lessons_[lesson].settingsOf(1, ofScene), divider);
  shown_.lesson = lesson;
}

void SplitView::end() {
  comparing_.cancel();
  compared_.reset();
  still_ = {};
  shown_.on = false;
  shown_.lesson.reset();
  shown_.halves = {};
}

void SplitView::moveDivider(double share) {
  shown_.divider = std::clamp(share, narrowest, 1.0 - narrowest);
}

void SplitView::update() {
  if (!on()) {
    return;
  }
  const std::optional<std::array<double, 2>> errors = comparing_.takeResult();
  comparing_.takeError();
  for (int half = 0; half < 2; ++half) {
    ShownSplit::Half& shown = shown_.halves[static_cast<size_t>(half)];
    shown.differs = settingChanges(settings(1 - half), settings(half));
    if (errors) {
      shown.error = (*errors)[static_cast<size_t>(half)];
      shown.ofReference = compared_->second != nullptr;
    }
  }
}

void SplitView::frameDrawn(const HalfFrame& frame, const Truth& truth, const std::function<Image8(int)>& picture,
                           const std::function<Settings(int)>& drawn) {
  ShownSplit::Half& shown = shown_.halves[static_cast<size_t>(frame.half)];
  shown.gpuMs = frame.gpuMs;
  shown.picture = frame.text;
  still_[static_cast<size_t>(frame.half)] = frame.still;
  const Compared now{still_, truth};
  if (compared_ == now) {
    return;
  }
  comparing_.cancel();
  compared_.reset();
  shown_.halves[0].error.reset();
  shown_.halves[1].error.reset();
  if (!still_[0] || !still_[1]) {
    return;
  }
  compared_ = now;
  comparing_.start(0.0, [truth, pictures = std::array{picture(0), picture(1)},
                         settings = std::array{drawn(0), drawn(1)}](const auto&) {
    std::array<double, 2> errors{};
    inBackground([&] {
      if (truth) {
        errors = {errorsAgainst(*truth, pictures[0], settings[0]).whole.flip,
                  errorsAgainst(*truth, pictures[1], settings[1]).whole.flip};
      } else {
        errors.fill(compareImages(comparedImage(pictures[0]), comparedImage(pictures[1])).whole.flip);
      }
    });
    return errors;
  });
}

}  // namespace speculum
