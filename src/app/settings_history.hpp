#pragma once

#include <string>
#include <vector>

#include "edit/scene_document.hpp"
#include "frame/settings.hpp"

namespace speculum {

enum class UndoWay { back, forward };

// Undo and redo of a scene and its settings, in the order in which they were changed.
class SettingsHistory {
 public:
  // After a change of the settings. `continued`: part of the step before.
  void changed(const Settings& before, const Settings& after, bool continued, SceneDocument& document);

  // Label of the next step that way; empty: none.
  std::string label(UndoWay way, const SceneDocument& document) const;
  // Takes the next step and returns true if it is one of the settings; returns false if it is the document's. Changes
  // only the settings of the step, because a measurement may have chosen others since.
  bool step(UndoWay way, const SceneDocument& document, Settings& settings);

 private:
  struct Step {
    Settings before;
    Settings after;
    size_t position = 0;  // steps of the document that precede it
    uint64_t revision = 0;
  };
  static std::string labelOf(const Step& step);
  bool isNext(UndoWay way, const SceneDocument& document) const;

  std::vector<Step> undo_;
  std::vector<Step> redo_;
};

}  // namespace speculum
