#include "session/options.hpp"

#include <spdlog/fmt/ranges.h>

#include "platform/files.hpp"
#include "platform/process.hpp"

namespace speculum {

namespace {

// Writes numbers as the shortest texts that read back the same.
std::string pointText(const glm::dvec3& point) {
  return fmt::format("{},{},{}", point.x, point.y, point.z);
}

std::string cameraText(const Bookmark& camera, const CameraSpec& usual) {
  std::string text = pointText(camera.position) + ":" + pointText(camera.target);
  if (camera.up || camera.verticalFov) {
    text += ":" + pointText(camera.up.value_or(usual.up));
  }
  return text + (camera.verticalFov ? fmt::format(":{}", *camera.verticalFov) : "");
}

// Returns the name of a scene that comes with the program, else the path.
std::string sceneText(const std::filesystem::path& file) {
  const std::filesystem::path path = withoutLinks(file);
  const std::filesystem::path scenes = withoutLinks(dataDirectory("scenes"));
  return isBelow(path, scenes) ? path.lexically_relative(scenes).replace_extension().generic_string() : path.string();
}

}  // namespace

void addSettings(std::span<const std::pair<std::string, std::string>> settings, std::vector<std::string>& arguments) {
  for (const auto& [key, value] : settings) {
    arguments.insert(arguments.end(), {"--set", key + "=" + value});
  }
}

void addDevice(const Options& options, std::vector<std::string>& arguments) {
  if (!options.gpu.empty()) {
    arguments.insert(arguments.end(), {"--gpu", options.gpu});
  }
  if (options.renderPath != RenderPath::automatic) {
    arguments.insert(arguments.end(), {"--render-path", std::string(renderPathName(options.renderPath))});
  }
  if (!options.shaderDir.empty()) {
    arguments.insert(arguments.end(), {"--shader-dir", wholePath(options.shaderDir).string()});
  }
}

std::string viewCommand(const Options& options, const std::filesystem::path& file, const Scene& scene,
                        const Settings& settings) {
  std::vector<std::string> arguments = {
      "speculum", "render",
      "--scene",  sceneText(file),
      "--size",   std::to_string(options.size.width) + "x" + std::to_string(options.size.height),
      "--time",   fmt::to_string(options.time)};
  if (options.camera) {
    arguments.insert(arguments.end(), {"--camera", cameraText(*options.camera, scene.camera)});
  }
  for (const SettingChange& change : settingChanges(settingsOf(scene), settings)) {
    if (change.key != "view.continuous" && !change.key.starts_with("quality.") && !change.key.starts_with("ui.")) {
      arguments.insert(arguments.end(), {"--set", change.key + "=" + change.value});
    }
  }
  addDevice(options, arguments);
  arguments.insert(arguments.end(), {"--out", scene.file.stem().string() + ".view.png"});
  std::ranges::transform(arguments, arguments.begin(), shellWord);
  return fmt::format("{}", fmt::join(arguments, " "));
}

}  // namespace speculum
