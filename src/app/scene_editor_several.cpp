// The part of the editor that is about several things at once: what is selected, and what all of it does together.
#include <algorithm>

#include "app/scene_editor.hpp"

namespace speculum {

std::vector<Selection> SceneEditor::selected() const {
  std::vector<Selection> things;
  if (document_.selection()) {
    things.push_back(document_.selection());
    things.insert(things.end(), others_.begin(), others_.end());
  }
  return things;
}

void SceneEditor::clickAlso(const Look& look, const glm::dvec2& pixel) {
  const std::vector<Picked> found = picker().at(look.state, look.picture, pixel, look.limits);
  if (!found.empty()) {
    toggle(found.back().what);
  }
}

void SceneEditor::toggle(const Selection& thing) {
  release();
  document_.endGesture();
  forgetPath();
  const Selection first = document_.selection();
  const auto other =
      std::find_if(others_.begin(), others_.end(), [&](const Selection& other) { return sameThing(other, thing); });
  if (!first) {
    document_.select(thing);
  } else if (other != others_.end()) {
    others_.erase(other);
  } else if (!sameThing(first, thing)) {
    others_.push_back({.kind = thing.kind, .index = thing.index});
  } else {
    document_.select(others_.empty() ? Selection() : others_.front());
    others_.erase(others_.begin(), others_.begin() + (others_.empty() ? 0 : 1));
  }
}

// As far as the handle was dragged. A light does not turn, but goes round what does.
Thing SceneEditor::dragged(const Held& held) const {
  const GizmoDrag::Change& change = drag_->change;
  const glm::dvec3& pivot = drag_->held.front().pivot;
  if (drag_->gizmo.handle() < Grip::turnX) {
    return moved(held.start, change.translation, drag_->time);
  }
  if (change.degrees == 0.0) {
    return held.start;
  }
  if (held.what.kind == Selection::Kind::light) {
    return moved(held.start, pivot + change.rotation * (held.pivot - pivot) - held.pivot, drag_->time);
  }
  return turned(held.start, change.rotation, pivot, held.what.copy, drag_->time);
}

void SceneEditor::duplicate() {
  const std::vector<Selection> things = selected();
  if (things.empty()) {
    return;
  }
  release();
  beforeChange_();
  if (things.size() == 1) {
    return select(document_.duplicate(things.front()));
  }
  const std::vector<Selection> copies = document_.duplicate(std::span(things));
  select(copies.front());
  others_.assign(copies.begin() + 1, copies.end());
}

void SceneEditor::remove() {
  const std::vector<Selection> things = selected();
  if (things.empty()) {
    return;
  }
  release();
  beforeChange_();
  others_.clear();
  things.size() == 1 ? document_.remove(things.front()) : document_.remove(std::span(things));
  forgetPath();
}

void SceneEditor::undo() {
  release();
  if (!document_.undoLabel().empty()) {
    step(&SceneDocument::undo);
  }
}

void SceneEditor::redo() {
  release();
  if (!document_.redoLabel().empty()) {
    step(&SceneDocument::redo);
  }
}

// What is selected together stays so as long as all of it stands in its place.
void SceneEditor::step(void (SceneDocument::*way)()) {
  beforeChange_();
  const uint64_t structure = document_.structureRevision();
  const Selection first = document_.selection();
  (document_.*way)();
  forgetPath();
  if (document_.structureRevision() != structure || !sameThing(document_.selection(), first)) {
    others_.clear();
  }
}

}  // namespace speculum
