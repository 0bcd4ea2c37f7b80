#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace speculum {

// A key of a scene file's table with its value as TOML. Equal texts stand for equal values and the other way round.
struct KeyText {
  std::string table;  // "orbit" of orbit.speed; empty for a key of the table itself
  std::string key;
  std::string text;
  bool omissible = false;  // the loader's default
};

// Every key that says something about the thing, in the order of docs/scene_format.md.
std::vector<KeyText> keyTexts(const Environment& environment);
std::vector<KeyText> keyTexts(const CameraSpec& camera);
std::vector<KeyText> keyTexts(const Object& object);
std::vector<KeyText> keyTexts(const PointLight& light);
std::vector<KeyText> keyTexts(const Mirror& mirror);
std::vector<KeyText> keyTexts(const Bookmark& bookmark);

}  // namespace speculum
