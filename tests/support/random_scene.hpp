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
  std::filesystem::path withEffects;  // with some of these effects, or the same scene
  std::string kind;                   // of its mirrors, such as "prism"
  int maxDepth = 4;
  double time = 0.0;  // seconds
  // Settings under which no debug switch may change the picture.
  std::vector<std::pair<std::string, std::string>> settings;
};

// Makes a scene with mirrors that cross, face, nest or adjoin each other, tile a plane, form a prism or stand behind
// openings, up to 1e7 m from the origin; with copies, motion, fields of view of 1 to 170 degrees, and mirrors with a
// quality of their own. The eye may be 1 um from a mirror. Further views are bookmarks.
RandomScene randomScene(unsigned seed);

// Leaves out tables of the scene for as long as `fails` returns true, as it must for the whole scene. The result still
// fails, but would not without any one of its tables. Scenes that lack a table that others need are invalid: `fails`
// should return false for them.
RandomScene smallest(RandomScene scene, const std::function<bool(const RandomScene&)>& fails);

}  // namespace speculum::testing_support
