#include "app/settings_history.hpp"

#include "frame/setting_fields.hpp"

namespace speculum {

void SettingsHistory::changed(const Settings& before, const Settings& after, bool continued, SceneDocument& document) {
  if (before == after) {
    return;
  }
  if (continued && !undo_.empty()) {
    undo_.back().after = after;
  } else {
    undo_.push_back({before, after, document.position()});
  }
  redo_.clear();
  document.clearRedo();
}

std::string SettingsHistory::labelOf(const Step& step) {
  std::string label;
  for (const SettingField& field : settingFields()) {
    if (!sameSetting(field, step.before, step.after)) {
      label = label.empty() ? std::string("change ") + field.label : "change settings";
    }
  }
  return label;
}

// Says whether the next step is one of the settings. Undone steps are stale after a new step of the document, because
// they follow steps that it lacks.
bool SettingsHistory::isNext(UndoWay way, const SceneDocument& document) const {
  if (way == UndoWay::back) {
    return !undo_.empty() && undo_.back().position >= document.position();
  }
  return !redo_.empty() && redo_.back().position == document.position() && redo_.back().revision == document.changes();
}

std::string SettingsHistory::label(UndoWay way, const SceneDocument& document) const {
  const bool back = way == UndoWay::back;
  if (isNext(way, document)) {
    return labelOf((back ? undo_ : redo_).back());
  }
  return back ? document.undoLabel() : document.redoLabel();
}

bool SettingsHistory::step(UndoWay way, const SceneDocument& document, Settings& settings) {
  if (!isNext(way, document)) {
    return false;
  }
  const bool back = way == UndoWay::back;
  std::vector<Step>& from = back ? undo_ : redo_;
  Step& step = (back ? redo_ : undo_).emplace_back(std::move(from.back()));
  from.pop_back();
  step.revision = document.changes();
  for (const SettingField& field : settingFields()) {
    if (!sameSetting(field, step.before, step.after)) {
      copySetting(field, back ? step.before : step.after, settings);
    }
  }
  return true;
}

}  // namespace speculum
