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

bool sameThing(const Selection& a, const Selection& b) {
  return a.kind == b.kind && a.index == b.index;
}

}  // namespace speculum
