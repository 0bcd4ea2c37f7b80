#pragma once

#include <optional>
#include <string>

#include "core/device.hpp"
#include "plan/fitted_plan.hpp"
#include "systems/trace_scene.hpp"

namespace speculum {

// Plans the frames of commands and of the window, so that they fit a device. The window also leaves out textures if
// there is no memory for them, until a setting changes, which may free memory.
class FramePlanner : public PicturePlanner {
 public:
  // `keepsPicture` as in TargetLimits.
  explicit FramePlanner(const Device& device, bool keepsPicture = false);

  // Call before the plans of a frame. With `rendersMirrors` no mirror shows the image of an earlier frame. With
  // `leavesOutTextures` textures that were left out are not tried again, because each trial waits for the device.
  // `planners`: number of planners whose pictures share the device's memory.
  void begin(bool rendersMirrors, bool leavesOutTextures, unsigned planners = 1);
  // Logs when it begins to lower settings. Throws UsageError for a picture that is larger than the device draws.
  FittedPlan plan(const FrameRequest& request) override;
  // Call in the handler of the OutOfMemoryError if the textures of the last plan could not be uploaded: plans leave
  // them out from now on. Throws the error again if they are left out already, so that memory is missing for something
  // else.
  void leaveOutTextures(const std::string& why);
  void forgetScene() { refused_.reset(); }  // textures are tried again
  std::string message() const;              // what was lowered or left out; empty if nothing was

 private:
  struct Refused {
    Settings settings;  // settings at which there was no memory for textures
    std::string problem;
  };

  const Device& device_;
  TargetLimits limits_;
  uint64_t budgetBytes_ = 0;  // for the targets of all planners
  bool warnedOfCoverage_ = false;
  bool rendersMirrors_ = false;
  bool leavesOutTextures_ = false;
  Settings asked_;  // settings of the last plan, before any was lowered
  std::optional<Refused> refused_;
  std::string retried_;  // problem after which textures are tried again
  std::string lowered_;  // what the last plan lowered; empty: nothing
};

}  // namespace speculum
