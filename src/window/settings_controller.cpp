#include "window/settings_controller.hpp"

#include "settings/setting_fields.hpp"

namespace speculum {

SettingsController::SettingsController(const Options& options, const LoadedScene& loaded)
    : ofScene_(loaded.settings), accuracy_(options, loaded.settings, loaded.quality ? loaded.quality->why : "") {}

void SettingsController::setDocument(SceneDocument& document, const Settings& loaded) {
  document_ = &document;
  accuracy_.forgetPick();
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

void SettingsController::beginSplit(bool naive, double divider) {
  split_.begin(ofScene_, naive ? naiveSettings(ofScene_) : ofScene_, divider);
  chooseHalf(split_.chosen());
}

void SettingsController::beginLesson(size_t index, const Settings& loaded, double divider) {
  split_.beginLesson(index, loaded, divider);
  chooseHalf(split_.chosen());
}

void SettingsController::chooseHalf(int half) {
  if (split_.on()) {
    if (half != split_.chosen()) {
      accuracy_.forgetPick();  // it was one of the other half
    }
    split_.choose(half);
    accuracy_.acceptBudget(chosen());
    accuracy_.showAgain();
  }
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
  accuracy_.forgetPick();
  document_->forgetHalves();
  accuracy_.acceptBudget(ofScene_);
  accuracy_.showAgain();
}

bool SettingsController::follow(const std::optional<SettingsStep>& step, bool back) {
  if (step) {
    if (step->half >= 0) {
      chooseHalf(step->half);
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
