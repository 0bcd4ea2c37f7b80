#pragma once

#include <optional>
#include <string>

#include "app/session.hpp"

namespace speculum {

// Plans the frames of the window so that they fit the device's memory. Leaves out textures if there is no memory for
// them, until a setting changes, which may free memory.
class FramePlanner {
 public:
  explicit FramePlanner(const Device& device) : planner_(device, true) {}

  // Plans a frame for picture number `picture` of a mean, and uploads its textures. With `rendersMain` the main view is
  // not reused. While `settingsMove`, as with a slider that is held, textures are not tried again, because each trial
  // waits for the device.
  FittedPlan plan(Frame& frame, SceneRenderer& sceneRenderer, const Scene& scene, const SceneState& state,
                  Settings settings, int picture, bool rendersMain, bool settingsMove);
  void forgetScene() { refused_.reset(); }
  std::string message() const;  // what was lowered or left out; empty if nothing was

 private:
  struct Refused {
    Settings settings;  // settings at which there was no memory for textures
    std::string problem;
  };

  BudgetPlanner planner_;
  std::optional<Refused> refused_;
};

}  // namespace speculum
