#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace speculum {

// The part of a scene that can be edited.
struct SceneContent {
  // Index of each node in the file that the scene was loaded from, -1 if it was added since. Loaded nodes come first,
  // in their order.
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

// Content of a scene as it was loaded.
SceneContent contentOf(const Scene& scene);

}  // namespace speculum
