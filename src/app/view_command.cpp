#include "app/view_command.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "frame/setting_fields.hpp"
#include "platform/folders.hpp"

namespace speculum {

namespace {

// The shortest text that reads as the same number.
std::string numberText(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string pointText(const glm::dvec3& point) {
  return numberText(point.x) + "," + numberText(point.y) + "," + numberText(point.z);
}

std::string quoted(const std::string& argument) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-_./:,=+%@").find(c) != std::string_view::npos;
  };
  if (!argument.empty() && std::all_of(argument.begin(), argument.end(), plain)) {
    return argument;
  }
  std::string text = "'";
  for (const char c : argument) {
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return text + "'";
}

// By name if it comes with the program.
std::string sceneText(const std::filesystem::path& file) {
  const std::filesystem::path path = std::filesystem::weakly_canonical(file);
  const std::filesystem::path name =
      path.lexically_relative(std::filesystem::weakly_canonical(dataDirectory("scenes")));
  return name.empty() || *name.begin() == ".." ? path.string() : (name.parent_path() / name.stem()).string();
}

std::vector<std::string> settingArguments(const Scene& scene, const Settings& settings) {
  const Settings own = settingsOf(scene);
  std::vector<std::string> arguments;
  for (const SettingField& field : settingFields()) {
    const std::string value = settingValue(settings, field.key);
    if (field.key != "view.continuous" && field.key.rfind("quality.", 0) != 0 &&
        value != settingValue(own, field.key)) {
      arguments.insert(arguments.end(), {"--set", std::string(field.key) + "=" + value});
    }
  }
  return arguments;
}

}  // namespace

std::string viewCommand(const Options& options, const std::filesystem::path& file, const Scene& scene,
                        const Settings& settings) {
  std::vector<std::string> arguments = {
      "speculum", "render",
      "--scene",  sceneText(file),
      "--size",   std::to_string(options.size.width) + "x" + std::to_string(options.size.height),
      "--time",   numberText(options.time)};
  if (options.camera) {
    const auto& [eye, target, up] = *options.camera;
    arguments.insert(arguments.end(),
                     {"--camera", pointText(eye) + ":" + pointText(target) + (up ? ":" + pointText(*up) : "")});
  }
  for (std::string& argument : settingArguments(scene, settings)) {
    arguments.push_back(std::move(argument));
  }
  if (!options.gpu.empty()) {
    arguments.insert(arguments.end(), {"--gpu", options.gpu});
  }
  if (options.renderPath != RenderPath::automatic) {
    arguments.insert(arguments.end(), {"--render-path", std::string(renderPathName(options.renderPath))});
  }
  if (!options.shaderDir.empty()) {
    arguments.insert(arguments.end(), {"--shader-dir", std::filesystem::absolute(options.shaderDir).string()});
  }
  arguments.insert(arguments.end(), {"--out", scene.file.stem().string() + ".png"});
  std::string text;
  for (const std::string& argument : arguments) {
    text += (text.empty() ? "" : " ") + quoted(argument);
  }
  return text;
}

}  // namespace speculum
