#pragma once

#include "app/background_job.hpp"
#include "scene/scene.hpp"

namespace speculum {

// Makes the levels of a scene's meshes on a thread of its own, so that no frame of the window waits for them.
class MeshLevelJob {
 public:
  // Says whether the levels of all meshes are made, and starts to make missing ones. A call with another scene cancels
  // the work for the last one.
  bool ready(const Scene& scene, int sceneNumber);

 private:
  BackgroundJob<bool> job_;
  int scene_ = 0;
  std::optional<int> failed_;  // scene whose meshes could not be simplified, for lack of memory
};

}  // namespace speculum
