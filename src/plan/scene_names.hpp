#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scene/scene.hpp"

namespace speculum {

// Name of a node for users: "mirror 'floor'", or "mirror 2" if it has none.
template <typename String = std::string>
String nameOf(std::string_view kind, std::string_view name, int index) {
  String text(kind);
  if (name.empty()) {
    text.append(" ").append(std::to_string(index));
  } else {
    text.append(" '").append(name).append("'");
  }
  return text;
}

// Name of a mirror for users: its `name`, or its index.
inline std::string mirrorName(const Scene& scene, int mirror) {
  const std::string& name = scene.mirror(mirror).name;
  return name.empty() ? std::to_string(mirror) : name;
}

// Name of a path for users: "floor > wall", from the eye on.
inline std::string mirrorPathName(const Scene& scene, std::span<const int> path) {
  std::string text;
  for (const int mirror : path) {
    text += (text.empty() ? "" : " > ") + mirrorName(scene, mirror);
  }
  return text;
}

}  // namespace speculum
