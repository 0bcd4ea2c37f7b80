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

}  // namespace speculum
