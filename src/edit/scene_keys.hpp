#pragma once

#include <string>
#include <vector>

#include "scene/scene_fields.hpp"

namespace speculum {

// A key of a scene file's table with its value as TOML. Equal texts stand for equal values and the other way round.
struct KeyText {
  std::string table;  // "orbit" of orbit.speed; empty for a key of the table itself
  std::string key;
  std::string text;
  bool omissible = false;  // the loader's default
};

// Every key that says something about the node: Environment, CameraSpec, Object, PointLight, Mirror or Bookmark. In the
// order of its description.
template <Described Node>
std::vector<KeyText> keyTexts(const Node& node);

}  // namespace speculum
