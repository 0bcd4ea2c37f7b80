#include "scene/scene_effects.hpp"

#include <algorithm>

namespace speculum {

namespace {

template <typename Item, typename Uses>
void addIfUsed(const std::vector<Item>& items, const std::string& kind, const std::string& key, Uses uses,
               std::vector<std::string>& lines) {
  const auto first = std::find_if(items.begin(), items.end(), uses);
  if (first == items.end()) {
    return;
  }
  const std::string name = first->name.empty() ? std::to_string(first - items.begin()) : "'" + first->name + "'";
  const auto count = std::count_if(first, items.end(), uses);
  const std::string others = count > 1 ? " and " + std::to_string(count - 1) + " more" : "";
  lines.push_back(key + ": not drawn by this version, asked for by " + kind + " " + name + others);
}

}  // namespace

std::vector<std::string> ignoredEffects(const Scene& scene) {
  std::vector<std::string> lines;
  addIfUsed(
      scene.lights, "light", "casts_shadow", [](const PointLight& light) { return light.castsShadow; }, lines);
  addIfUsed(
      scene.mirrors, "mirror", "roughness", [](const Mirror& mirror) { return mirror.roughness > 0.0; }, lines);
  addIfUsed(
      scene.mirrors, "mirror", "ripple",
      [](const Mirror& mirror) { return mirror.ripple && mirror.ripple->amplitude != 0.0; }, lines);
  addIfUsed(
      scene.mirrors, "mirror", "casts_light", [](const Mirror& mirror) { return mirror.castsLight; }, lines);
  return lines;
}

}  // namespace speculum
