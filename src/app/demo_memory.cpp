// The part of the window that does with less where memory runs out.
#include <spdlog/spdlog.h>

#include "app/demo.hpp"

namespace speculum {

// Textures for which there is no memory are left out until a setting changes, which may have freed some. While a widget
// is held settings may change in every frame, and each trial waits for the device.
FittedPlan Demo::planAndUpload(Frame& frame, const SceneState& state, Settings settings) {
  std::string known;
  if (texturesRefused_ && !ui_->holdsWidget() && texturesRefused_->settings != settingsKey(model_.settings)) {
    known = texturesRefused_->problem;
    texturesRefused_.reset();
  }
  const auto plan = [&] {
    settings.effects.textures = settings.effects.textures && !texturesRefused_;
    FrameCache cache = sceneRenderer_->cache();
    if (watched_ && watched_->empty()) {
      cache.main = nullptr;  // the main view is there to be shown, with its depth
    }
    return planner_.plan(loaded_->scene, state, settings, static_cast<int>(frame.extent.width),
                         static_cast<int>(frame.extent.height), cache);
  };
  FittedPlan fitted = plan();
  try {
    sceneRenderer_->uploadTextures(frame, state, fitted.settings, fitted.plan);
  } catch (const OutOfMemoryError& error) {
    if (texturesRefused_) {
      throw;  // it is not for textures
    }
    texturesRefused_ = {settingsKey(model_.settings),
                        "drawn without textures until a setting is changed: " + std::string(error.what())};
    if (texturesRefused_->problem != known) {
      spdlog::warn("{}", texturesRefused_->problem);
    }
    fitted = plan();
    sceneRenderer_->uploadTextures(frame, state, fitted.settings, fitted.plan);
  }
  return fitted;
}

}  // namespace speculum
