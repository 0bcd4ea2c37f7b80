// The part of the window that does with less where memory runs out.
#include <spdlog/spdlog.h>

#include "app/demo.hpp"

namespace speculum {

// Textures for which there is no memory are left out until a setting changes, which may have freed some.
FittedPlan Demo::planAndUpload(Frame& frame, const SceneState& state, Settings settings) {
  if (texturesRefusedWith_ != settingsKey(model_.settings)) {
    texturesRefusedWith_.reset();
    texturesProblem_.clear();
  }
  const auto plan = [&] {
    settings.effects.textures = settings.effects.textures && !texturesRefusedWith_;
    EarlierImages earlier = sceneRenderer_->earlier();
    if (watched_ && watched_->empty()) {
      earlier.main = nullptr;  // the main view is there to be shown, with its depth
    }
    return planner_.plan(loaded_->scene, state, settings, static_cast<int>(frame.extent.width),
                         static_cast<int>(frame.extent.height), earlier);
  };
  FittedPlan fitted = plan();
  try {
    sceneRenderer_->uploadTextures(frame, state, fitted.settings, fitted.plan);
  } catch (const OutOfMemoryError& error) {
    if (texturesRefusedWith_) {
      throw;  // it is not for textures
    }
    texturesRefusedWith_ = settingsKey(model_.settings);
    texturesProblem_ = "drawn without textures until a setting is changed: " + std::string(error.what());
    spdlog::warn("{}", texturesProblem_);
    fitted = plan();
    sceneRenderer_->uploadTextures(frame, state, fitted.settings, fitted.plan);
  }
  return fitted;
}

}  // namespace speculum
