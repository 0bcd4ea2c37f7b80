#include "app/mesh_level_job.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>

#include "geometry/mesh_levels.hpp"

namespace speculum {

bool MeshLevelJob::ready(const Scene& scene, int sceneNumber) {
  if (std::exchange(scene_, sceneNumber) != sceneNumber) {
    job_.cancel();
  }
  if (job_.running()) {
    return false;
  }
  if (std::ranges::all_of(scene.meshes, levelsMade)) {
    return true;
  }
  if (const std::optional<std::string> error = job_.takeError()) {
    spdlog::debug("meshes are not simplified: {}", *error);
    failed_ = sceneNumber;
  }
  if (failed_ != sceneNumber) {
    std::vector<Mesh> missing;  // copies, because the scene may be replaced meanwhile
    std::ranges::remove_copy_if(scene.meshes, std::back_inserter(missing), levelsMade);
    job_.start(0.0, [meshes = std::move(missing)](const auto& report) {
      for (const Mesh& mesh : meshes) {
        levelsOf(mesh, [&] { return !report(0.0); });
      }
      return true;
    });
  }
  return false;
}

}  // namespace speculum
