#include "edit/selection.hpp"

#include <array>

#include "plan/view.hpp"

namespace speculum {

constexpr std::array kindNames = {"", "object", "light", "mirror"};  // by Selection::Kind

std::string describe(const Scene& scene, const Selection& selection) {
  std::string text = "nothing";
  withNodes(scene, selection.kind, [&](const auto& nodes, const auto&) {
    text = nameOf(kindNames[static_cast<size_t>(selection.kind)], nodes.at(selection.index).name, selection.index);
  });
  return text;
}

std::string describe(const Scene& scene, std::span<const Selection> nodes) {
  return nodes.size() == 1 ? describe(scene, nodes.front()) : std::to_string(nodes.size()) + " nodes";
}

SceneNode nodeOf(const Scene& scene, const Selection& selection) {
  SceneNode node;
  withNodes(scene, selection.kind, [&](const auto& nodes, const auto&) {
    if (selection.index >= 0 && static_cast<size_t>(selection.index) < nodes.size()) {
      node = nodes[selection.index];
    }
  });
  return node;
}

Selection mirrorNode(const Scene& scene, int mirror) {
  const auto index = static_cast<size_t>(mirror);
  if (index < scene.mirrors.size()) {
    return {Selection::Kind::mirror, mirror};
  }
  if (index >= scene.mirrorCount()) {
    return {};  // an index from before an edit
  }
  const MaterialMirror& made = scene.materialMirrors[index - scene.mirrors.size()];
  return {Selection::Kind::object, made.object, made.copy};
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

bool sameNode(const Selection& a, const Selection& b) {
  return a.kind == b.kind && a.index == b.index;
}

}  // namespace speculum
