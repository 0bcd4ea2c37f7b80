#include "app/frame_planner.hpp"

#include <spdlog/spdlog.h>

namespace speculum {

FittedPlan FramePlanner::plan(Frame& frame, SceneRenderer& sceneRenderer, const Scene& scene, const SceneState& state,
                              Settings settings, int picture, bool rendersMain, bool settingsMove) {
  const Settings asked = settings;
  std::string known;
  if (refused_ && !settingsMove && refused_->settings != asked) {
    known = refused_->problem;
    refused_.reset();
  }
  const auto planNow = [&] {
    settings.effects.textures = settings.effects.textures && !refused_;
    FrameCache cache = sceneRenderer.cache(state);
    if (rendersMain) {
      cache.main = nullptr;
    }
    return planner_.plan(scene, state, settings, static_cast<int>(frame.extent.width),
                         static_cast<int>(frame.extent.height), cache, picture);
  };
  FittedPlan fitted = planNow();
  try {
    sceneRenderer.uploadTextures(frame, state, fitted.settings, fitted.plan);
  } catch (const OutOfMemoryError& error) {
    if (refused_) {
      throw;  // textures are left out already, so the memory is missing for something else
    }
    refused_ = {asked, "drawn without textures until a setting is changed: " + std::string(error.what())};
    if (refused_->problem != known) {
      spdlog::warn("{}", refused_->problem);
    }
    fitted = planNow();
    sceneRenderer.uploadTextures(frame, state, fitted.settings, fitted.plan);
  }
  return fitted;
}

std::string FramePlanner::message() const {
  std::string message = refused_ ? refused_->problem : "";
  message += !message.empty() && !planner_.message().empty() ? "; " : "";
  return message + planner_.message();
}

}  // namespace speculum
