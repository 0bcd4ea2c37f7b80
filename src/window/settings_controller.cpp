#include "window/settings_controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "settings/setting_fields.hpp"

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
  shown.pictures = frame.pictures;
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

SettingsController::SettingsController(const Options& options, const LoadedScene& loaded, StatusLine& status)
    : ofScene_(loaded.settings),
      accuracy_(options, loaded.settings, loaded.quality ? loaded.quality->why : ""),
      status_(status) {}

void SettingsController::setDocument(SceneDocument& document, const Settings& loaded) {
  document_ = &document;
  accuracy_.setPick({});
  split_.end();
  ofScene_ = loaded;
}

void SettingsController::set(const Settings& settings, bool continued) {
  Settings chosen = settings;
  accuracy_.followBudget(chosen);
  document_->settingsChanged(edited(), chosen, continued, split_.on() ? split_.chosen() : -1);
  edited() = chosen;
}

void SettingsController::applyPoint(int point) {
  const Settings before = chosen();
  Settings settings = before;
  accuracy_.applyPoint(point, settings);
  // A half shows the point as it was measured, whichever half is chosen.
  settings.quality.stillPictures = split_.on() ? 1 : settings.quality.stillPictures;
  set(settings);
  accuracy_.pick(before, settings);
}

bool SettingsController::toggleSplit(SplitStart start, double divider) {
  if (split_.on()) {
    endSplit();
    if (start == SplitStart::current) {
      return false;
    }
  }
  const bool point = start == SplitStart::point;
  const Settings a = point ? accuracy_.shown().own.value_or(ofScene_) : ofScene_;
  Settings b = start == SplitStart::naive ? naiveSettings(ofScene_) : ofScene_;
  b.quality.stillPictures = point ? 1 : b.quality.stillPictures;  // as it was measured
  split_.begin(a, b, divider);
  startEditing();
  if (point) {
    accuracy_.pick(a, b);
  }
  setHalfStatus();
  return true;
}

void SettingsController::beginLesson(size_t index, const Settings& loaded, double divider) {
  split_.beginLesson(index, loaded, divider);
  startEditing();
}

void SettingsController::startEditing() {
  pickOfScene_ = accuracy_.pick();
  accuracy_.setPick({});
  edit(split_.chosen());
}

void SettingsController::chooseHalf(int half) {
  if (split_.on()) {
    edit(half);
    setHalfStatus();
  }
}

void SettingsController::edit(int half) {
  if (half != split_.chosen()) {
    accuracy_.setPick({});  // it was one of the other half
  }
  split_.choose(half);
  accuracy_.acceptBudget(chosen());
  accuracy_.showAgain();
}

void SettingsController::setHalfStatus() {
  const auto [chosen, other] = split_.chosen() == 0 ? std::pair('A', 'B') : std::pair('B', 'A');
  status_.set(fmt::format("A | B: the panel changes the settings of {}. X changes to {}, Esc ends it.", chosen, other),
              [this] { return split_.on(); });
}

void SettingsController::keepHalf() {
  if (split_.on()) {
    Settings kept = chosen();
    kept.limit = ofScene_.limit;  // no user set it, and no step would take it back
    endSplit();
    accuracy_.acceptBudget(kept);
    set(kept);
  }
}

void SettingsController::endSplit() {
  split_.end();
  accuracy_.setPick(pickOfScene_);
  document_->forgetHalves();
  accuracy_.acceptBudget(ofScene_);
  accuracy_.showAgain();
}

bool SettingsController::follow(const std::optional<SettingsStep>& step, bool back) {
  if (step) {
    if (step->half >= 0 && split_.on()) {
      edit(step->half);
    }
    // Copies only the settings that the step changed, because a measurement may have chosen others since.
    Settings& settings = step->half >= 0 ? edited() : ofScene_;
    for (const SettingField& field : settingFields()) {
      if (!sameSetting(field, step->before, step->after)) {
        copySetting(field, back ? step->before : step->after, settings);
      }
    }
  }
  accuracy_.acceptBudget(chosen());
  return step && split_.on() && step->half < 0;
}

void SettingsController::update() {
  accuracy_.beforeFrame(edited());
  split_.update();
}

}  // namespace speculum
