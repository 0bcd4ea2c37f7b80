#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace speculum::testing_support {

// A valid scene that joins hard cases, the same for the same seed.
struct RandomScene {
  std::string name;
  std::string text;                   // TOML, with a mark before each line that only `withEffects` has
  std::filesystem::path file;         // without shadows, ripples, rough and curved mirrors, light off mirrors
  std::filesystem::path withEffects;  // with some of them, or the same
  std::string kind;                   // of its mirrors, such as "prism"
  int maxDepth = 4;
  double time = 0.0;  // seconds
  // Settings under which no debug switch may change the picture.
  std::vector<std::pair<std::string, std::string>> settings;
};

// Mirrors that cross, face, nest or adjoin each other, tile a plane, form a prism or stand behind openings, up to
// 1e7 m from the origin; copies, motion, fields of view of 1 to 170 degrees; the eye may be 1 um from a mirror; mirrors
// with a quality of their own. Further views are bookmarks.
RandomScene randomScene(unsigned seed);

// Leaves out tables for as long as the scene `fails`, as it must at first. It fails afterwards too, but not without any
// one of its tables. Scenes that lack a table that others need are invalid: `fails` should return false.
RandomScene smallest(RandomScene scene, const std::function<bool(const RandomScene&)>& fails);

}  // namespace speculum::testing_support
