#include "edit/selection.hpp"

#include "frame/scene_names.hpp"

namespace speculum {

std::string describe(const Scene& scene, const Selection& selection) {
  const int index = selection.index;
  switch (selection.kind) {
    case Selection::Kind::object:
      return nameOf("object", scene.objects.at(index).name, index);
    case Selection::Kind::mirror:
      return nameOf("mirror", scene.mirrors.at(index).name, index);
    case Selection::Kind::light:
      return nameOf("light", scene.lights.at(index).name, index);
    default:
      return "nothing";
  }
}

std::string describe(const Scene& scene, std::span<const Selection> things) {
  return things.size() == 1 ? describe(scene, things.front()) : std::to_string(things.size()) + " things";
}

std::vector<Selection> allNodes(const Scene& scene) {
  std::vector<Selection> nodes;
  const auto add = [&](Selection::Kind kind, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      nodes.push_back({kind, static_cast<int>(i)});
    }
  };
  add(Selection::Kind::mirror, scene.mirrors.size());
  add(Selection::Kind::light, scene.lights.size());
  add(Selection::Kind::object, scene.objects.size());
  return nodes;
}

bool sameThing(const Selection& a, const Selection& b) {
  return a.kind == b.kind && a.index == b.index;
}

}  // namespace speculum
