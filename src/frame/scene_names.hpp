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
std::string mirrorName(const Scene& scene, int mirror);
// Name of a path for users: "floor > wall", from the eye on.
std::string mirrorPathName(const Scene& scene, std::span<const int> path);

}  // namespace speculum
