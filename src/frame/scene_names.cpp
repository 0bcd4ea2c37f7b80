#include "frame/scene_names.hpp"

namespace speculum {

std::string mirrorName(const Scene& scene, int mirror) {
  const std::string& name = scene.mirrors[mirror].name;
  return name.empty() ? std::to_string(mirror) : name;
}

std::string mirrorPathName(const Scene& scene, std::span<const int> path) {
  std::string text;
  for (const int mirror : path) {
    text += (text.empty() ? "" : " > ") + mirrorName(scene, mirror);
  }
  return text;
}

}  // namespace speculum
