#include "scene/model_scene.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "scene/input_error.hpp"
#include "scene/model_formats.hpp"
#include "scene/scene_loader.hpp"
#include "scene/toml_text.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

constexpr double kSmallest = 1e-9;  // metres, of the bounding sphere's radius
constexpr double kLargest = 1e12;
constexpr double kGap = 0.03;   // radii between the model and the mirror below it
constexpr double kStage = 3.6;  // radii that the mirror measures
constexpr double kModelFieldOfView = 36.0;

std::string disc(double radius) {
  constexpr int kCorners = 96;
  std::string corners;
  for (int i = 0; i < kCorners; ++i) {
    const double turn = glm::radians(360.0) * i / kCorners;
    corners += fmt::format("  {},\n", tomlText(glm::dvec3(radius * std::cos(turn), 0.0, -radius * std::sin(turn))));
  }
  return "[\n" + corners + "]";
}

// Writes a scene whose unit is the radius of the model's bounding sphere, with the model's centre above the origin.
std::string sceneText(const fs::path& file, const Mesh& mesh) {
  const double r = mesh.radius * mesh.unit;
  const double height = mesh.halfExtent.y * mesh.unit + kGap * r;  // of the centre
  const glm::dvec3 center(0.0, height, 0.0);
  const glm::dvec3 target = center - glm::dvec3(0.0, 0.22 * r, 0.0);
  const glm::dvec3 towards = glm::normalize(glm::dvec3(0.62, 0.36, 1.0));
  const glm::dvec3 eye = target + 1.3 * r / std::sin(glm::radians(0.5 * kModelFieldOfView)) * towards;
  std::string toml = fmt::format("# {} by itself, over a mirror of its size.\ntitle = {}\n\n",
                                 tomlText(file.filename().string()), tomlText(file.stem().string()));
  toml +=
      "[environment]\n"
      "sky     = { zenith = [0.1, 0.21, 0.45], horizon = [0.8, 0.8, 0.78], ground = [0.5, 0.5, 0.5] }\n"
      "ambient = [0.22, 0.235, 0.26]\n\n";
  toml += fmt::format("[camera]\nposition     = {}\ntarget       = {}\nvertical_fov = {}\nnear         = {}\n\n",
                      tomlText(eye), tomlText(target), kModelFieldOfView, 1e-3 * r);
  toml += fmt::format("[[object]]\nname     = {}\nmodel    = {}\nposition = {}\n\n", tomlText(file.stem().string()),
                      tomlText(file.filename().string()), tomlText(center - mesh.center));
  toml += fmt::format(
      "[[light]]\nname         = \"key\"\nposition     = {}\nintensity    = {}\nradius       = {}\n"
      "glow         = 0\ncolor        = [1, 0.95, 0.88]\ncasts_shadow = true\n\n",
      tomlText(center + r * glm::dvec3(-2.2, 3.2, 2.6)), 58.0 * r * r, 0.05 * r);
  toml += fmt::format(
      "[[light]]\nname      = \"rim\"\nposition  = {}\nintensity = {}\nradius    = {}\n"
      "glow      = 0\ncolor     = [0.75, 0.85, 1]\n\n",
      tomlText(center + r * glm::dvec3(2.8, 2.6, -2.2)), 42.0 * r * r, 0.05 * r);
  toml += fmt::format(
      "[[mirror]]\nname        = \"floor\"\npolygon     = {}\nreflectance = [0.34, 0.35, 0.36]\n"
      "base_color  = [0.2, 0.2, 0.205]\ntwo_sided   = true\n",
      disc(kStage * r));
  return toml;
}

}  // namespace

Scene modelScene(const fs::path& file, const LoadProgress& progress) {
  std::vector<Texture> textures;
  Mesh mesh = loadModel(file, textures, progress);
  const double radius = mesh.radius * mesh.unit;
  if (!(radius >= kSmallest && radius <= kLargest)) {
    throwInputError(file, 1, "v", fmt::format("the model's bounding sphere has a radius of {} m", radius),
                    "1e-9 .. 1e12 is needed, or a scene that scales the model");
  }
  Scene scene = parseScene(file, sceneText(file, mesh));
  scene.objects[0].mesh = 0;
  scene.meshes.push_back(std::move(mesh));
  scene.textures = std::move(textures);
  return scene;
}

}  // namespace speculum
