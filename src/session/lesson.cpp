#include "session/lesson.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "platform/files.hpp"
#include "scene/scene_loader.hpp"
#include "scene/scene_sections.hpp"
#include "scene/toml_file.hpp"

namespace speculum {

namespace fs = std::filesystem;

Settings Lesson::settingsOf(int half, Settings ofScene) const {
  for (const SettingEntry& entry : settings[static_cast<size_t>(half)]) {
    setSetting(ofScene, entry.key, entry.value);
  }
  return ofScene;
}

Lesson readLesson(const fs::path& file) {
  static constexpr std::array<std::string_view, 8> keys{"title", "scene",    "camera", "time",
                                                        "text",  "look_for", "a",      "b"};
  const toml::table root = readToml(file, "lesson");
  const TableReader reader(file, "", root, 1, keys);
  Lesson lesson{.title = reader.text("title"), .text = reader.text("text"), .lookFor = reader.text("look_for")};
  for (const auto& [key, text] :
       {std::pair("title", &lesson.title), std::pair("text", &lesson.text), std::pair("look_for", &lesson.lookFor)}) {
    if (text->empty()) {
      reader.fail(key, "is empty", "a text is needed");
    }
  }
  const std::string scene = reader.text("scene");
  const fs::path beside = file.parent_path() / scene;
  lesson.scene = isFile(beside) ? beside : shippedScene(scene).value_or("");
  if (lesson.scene.empty()) {
    reader.fail("scene", "is '" + scene + "'", "a file beside this one, or a name of speculum scenes, is needed");
  }
  if (reader.has("camera")) {
    try {
      lesson.camera = parseCamera(reader.text("camera"));
    } catch (const std::invalid_argument& error) {
      reader.fail("camera", error.what(), "position:target as --camera takes them are needed");
    }
  }
  lesson.time = reader.number("time", 0.0, {.low = 0.0, .high = timeRange.high});
  for (const auto& [key, settings] : {std::pair("a", &lesson.settings[0]), std::pair("b", &lesson.settings[1])}) {
    Scene checked;  // settingsOf() knows what each setting takes; its error names file and line
    checked.file = file;
    checked.settings = *settings = readSettings(reader, key);
    settingsOf(checked);
  }
  if (lesson.settingsOf(0, {}) == lesson.settingsOf(1, {})) {
    reader.fail("b", "has the settings of a", "two sets that differ are needed");
  }
  return lesson;
}

std::vector<Lesson> shippedLessons() {
  std::vector<fs::path> files;
  std::vector<Lesson> lessons;
  try {
    for (const auto& entry : fs::directory_iterator(dataDirectory("lessons"))) {
      if (entry.path().extension() == ".toml") {
        files.push_back(entry.path());
      }
    }
  } catch (const std::runtime_error& error) {
    spdlog::warn("no lessons: {}", error.what());
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    try {
      lessons.push_back(readLesson(file));
    } catch (const InputError& error) {
      spdlog::warn("{}", error.what());
    }
  }
  return lessons;
}

}  // namespace speculum
