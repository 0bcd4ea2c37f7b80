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

bool SettingsHistory::nextUndone(const SceneDocument& document) const {
  return !undo_.empty() && undo_.back().position >= document.position();
}

// A new step of the document makes the ones that were undone stale: they follow steps that it lacks.
bool SettingsHistory::nextRedone(const SceneDocument& document) const {
  return !redo_.empty() && redo_.back().position == document.position() && redo_.back().revision == document.changes();
}

std::string SettingsHistory::undoLabel(const SceneDocument& document) const {
  return nextUndone(document) ? labelOf(undo_.back()) : document.undoLabel();
}

std::string SettingsHistory::redoLabel(const SceneDocument& document) const {
  return nextRedone(document) ? labelOf(redo_.back()) : document.redoLabel();
}

bool SettingsHistory::undo(const SceneDocument& document, Settings& settings) {
  if (!nextUndone(document)) {
    return false;
  }
  redo_.push_back(std::move(undo_.back()));
  redo_.back().revision = document.changes();
  undo_.pop_back();
  settings = redo_.back().before;
  return true;
}

bool SettingsHistory::redo(const SceneDocument& document, Settings& settings) {
  if (!nextRedone(document)) {
    return false;
  }
  undo_.push_back(std::move(redo_.back()));
  redo_.pop_back();
  settings = undo_.back().after;
  return true;
}

}  // namespace speculum
