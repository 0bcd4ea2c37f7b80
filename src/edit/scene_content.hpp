#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace speculum {

// What of a scene can be edited.
struct SceneContent {
  // Where things stand in the file that the scene was loaded from; -1 for what was added since. Those that were loaded
  // stand in their order before those that were added.
  struct Origins {
    std::vector<int> objects;
    std::vector<int> lights;
    std::vector<int> mirrors;
    std::vector<int> bookmarks;

    bool operator==(const Origins&) const = default;
  };

  Environment environment;
  CameraSpec camera;
  std::vector<Object> objects;
  std::vector<PointLight> lights;
  std::vector<Mirror> mirrors;
  std::vector<Bookmark> bookmarks;
  Origins origins;

  bool operator==(const SceneContent&) const = default;
};

// Of a scene as it was loaded.
SceneContent contentOf(const Scene& scene);

}  // namespace speculum
