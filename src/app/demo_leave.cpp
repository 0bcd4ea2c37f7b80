// What leaving means in the window: closing what is on top, another scene, the end; and what is lost by it.
#include <algorithm>
#include <utility>

#include "app/demo.hpp"

namespace speculum {

// One thing at a time; nothing in the end.
void Demo::closeTop() {
  if (editor_->dragging()) {
    return editor_->cancelDrag();
  }
  if (ui_->holdsEscape() || (ui_->visible() && ui_->closeTop(model_))) {
    return;
  }
  if (editor_->document().selection()) {
    return editor_->select({});
  }
  model_.status.text.clear();
}

// Settings are in the scene's file too.
bool Demo::hasUnsaved() const {
  return editor_->document().modified() || settingsChanged();
}

// With what unsaved changes were asked about for.
void Demo::goOn() {
  discarded_ = editor_->document().revision();
  discardedSettings_ = model_.settings;
  const std::optional<std::filesystem::path> file = std::exchange(nextFile_, std::nullopt);
  if (std::exchange(closing_, false)) {
    leaves_ = true;
    return window_.requestClose();
  }
  if (file) {
    openFile(*file);
  }
}

// Whether the scene may be left as it is: unsaved changes are asked about, those that were given up only once.
bool Demo::mayLeave() {
  const bool given =
      discarded_ == editor_->document().revision() && settingChanges(discardedSettings_, model_.settings).empty();
  if (given || options_.frames > 0 || !hasUnsaved()) {
    return true;
  }
  model_.edit.asksSave = !model_.edit.asksWhere;
  return false;
}

// Whether the window may go: it stays while unsaved changes are asked about.
bool Demo::closes() {
  if (!window_.shouldClose()) {
    return false;
  }
  if (leaves_ || options_.frames > 0 || !hasUnsaved()) {
    return true;
  }
  window_.refuseClose();
  if (window_.iconified()) {
    window_.restore();
  }
  closing_ = true;
  model_.edit.asksSave = !model_.edit.asksWhere;
  framesDue_ = std::max(framesDue_, 4);
  return false;
}

}  // namespace speculum
