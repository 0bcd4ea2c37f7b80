#include "scene/scene_loader.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "platform/files.hpp"
#include "platform/text.hpp"
#include "scene/material_mirrors.hpp"
#include "scene/materials.hpp"
#include "scene/scene_sections.hpp"
#include "scene/text_lines.hpp"
#include "scene/toml_file.hpp"
#include "scene/value_range.hpp"

namespace speculum {

namespace {

namespace fs = std::filesystem;

// Turns the progress of each model into the progress of all models, weighted by their bytes.
class ModelProgress {
 public:
  ModelProgress(const Scene& scene, const LoadProgress& progress) : progress_(progress) {
    if (!progress) {
      return;
    }
    std::set<fs::path> files;
    for (const Object& object : scene.objects) {
      const fs::path file = fileNamedBy(scene.file, object.model);
      total_ += files.insert(file).second ? sizeOf(file) : 0.0;
    }
  }

  LoadProgress ofOne(const fs::path& model) {
    const double size = sizeOf(model);
    const double before = std::exchange(done_, done_ + size);
    return [this, before, size](const fs::path& file, double part) {
      if (progress_) {
        progress_(file, (before + part * size) / total_);
      }
    };
  }

 private:
  static double sizeOf(const fs::path& file) {
    std::error_code error;
    const uintmax_t size = fs::file_size(file, error);
    return error ? 1.0 : static_cast<double>(size) + 1.0;
  }

  const LoadProgress& progress_;
  double done_ = 0.0;
  double total_ = 0.0;
};

// Returns the index of the object's mesh. `known` has the meshes by the paths of their files without symbolic links.
int meshIndex(const TableReader& object, Scene& scene, std::map<std::string, int>& known, ModelProgress& progress) {
  const std::string model = object.text("model");
  const fs::path file = fileNamedBy(scene.file, model);
  if (model.empty() || !isFile(file)) {
    std::error_code none;
    const bool isOther = !model.empty() && fs::exists(file, none) && !isFolder(file);
    object.fail("model",
                isOther ? "'" + file.string() + "' is a device or pipe" : "there is no file '" + file.string() + "'",
                "name a " + modelFormatNames() + " file, relative to the scene file");
  }
  const auto [entry, isNew] = known.try_emplace(withoutLinks(file).string(), static_cast<int>(scene.meshes.size()));
  if (isNew) {
    scene.meshes.push_back(loadModel(file, scene.textures, progress.ofOne(file), scene.meshes).mesh);
  }
  return entry->second;
}

// Reads the reflectance maps of the file's mirrors.
void addMaps(const TableReader& reader, Scene& scene) {
  size_t index = 0;
  for (const TableReader& table : reader.tables("mirror", keysOf<Mirror>())) {
    Mirror& mirror = scene.mirrors[index++];
    if (mirror.reflectanceMap.empty()) {
      continue;
    }
    const fs::path file = fileNamedBy(scene.file, mirror.reflectanceMap);
    try {
      mirror.map = linearTextureIndex(file, scene.textures);
    } catch (const FileError& error) {
      table.fail("reflectance_map", fmt::format("{}: {}", file.string(), error.problem()), error.remedy());
    }
  }
}

// Bounds the memory that copies take in every frame.
constexpr int mostInstances = 1'000'000;

// Returns what is needed of an object that is too large; nothing if its projected vertices are still floats. Rays to
// and from a curved mirror square the vertices' coordinates.
std::optional<std::string> extentRemedy(const Object& object, const Mesh& mesh) {
  const double largest = object.mirror ? 1e18 : 1e35;  // metres
  const glm::dvec3& c = mesh.center;
  const glm::dvec3 center = object.up == UpAxis::z ? glm::dvec3(c.x, c.z, c.y) : c;
  if (glm::compMax(glm::abs(object.scale) * (glm::abs(center) + mesh.radius * mesh.unit)) <= largest) {
    return std::nullopt;
  }
  return fmt::format("at most {:g} m are needed{}", largest, object.mirror ? " of a curved mirror" : "");
}

constexpr std::array<std::string_view, 8> keys{"title",  "environment", "camera", "settings",
                                               "object", "light",       "mirror", "bookmark"};

void addBookmarks(const TableReader& reader, Scene& scene) {
  std::set<std::string> names;
  for (const TableReader& table : reader.tables("bookmark", keysOf<Bookmark>())) {
    Bookmark bookmark = readBookmark(table, scene.camera);
    if (!names.insert(bookmark.name).second) {
      table.fail("name", "'" + bookmark.name + "' is another bookmark's", "names that differ are needed");
    }
    scene.bookmarks.push_back(std::move(bookmark));
  }
}

// Reads everything but the models.
Scene readScene(const TableReader& reader, const fs::path& file, std::string text) {
  Scene scene;
  scene.file = file;
  scene.text = std::move(text);
  scene.title = reader.text("title", "");
  scene.environment = readEnvironment(reader);
  scene.camera = readCamera(reader);
  scene.settings = readSettings(reader);
  for (const TableReader& table : reader.tables("light", keysOf<PointLight>())) {
    scene.lights.push_back(readLight(table));
  }
  for (const TableReader& table : reader.tables("mirror", keysOf<Mirror>())) {
    scene.mirrors.push_back(readMirror(table));
  }
  addBookmarks(reader, scene);
  int instances = 0;
  for (const TableReader& table : reader.tables("object", keysOf<Object>())) {
    Object object = readObject(table);
    if (object.copies.count > mostInstances - instances) {
      table.fail("copies", "makes more than 1000000 objects of the scene", "fewer copies are needed");
    }
    instances += object.copies.count;
    scene.objects.push_back(std::move(object));
  }
  return scene;
}

void addMaterialMirrors(Scene& scene) {
  cutMirrorParts(scene, 0);
  placeMaterialMirrors(scene);
  logMaterialMirrors(scene);
}

// Returns nothing for a file that cannot be read.
toml::table tomlIfAny(const fs::path& file) {
  try {
    return readToml(file, "scene file");
  } catch (const InputError&) {
    return {};
  }
}

constexpr double smallest = 1e-9;  // metres, of the bounding sphere's radius
constexpr double largest = 1e12;
constexpr double gap = 0.003;  // space between the model and the mirror below it, in radii of the model
constexpr double stage = 3.6;  // radius of the mirror, in radii of the model
constexpr double modelFieldOfView = 36.0;

std::string disc(double radius) {
  constexpr int count = 96;
  std::string corners;
  for (int i = 0; i < count; ++i) {
    const double turn = glm::radians(360.0) * i / count;
    corners += fmt::format("  {},\n", tomlText(glm::dvec3(radius * std::cos(turn), 0.0, -radius * std::sin(turn))));
  }
  return "[\n" + corners + "]";
}

// Returns the camera of the model, or one that sees it from above.
CameraSpec cameraOf(const Model& model, const glm::dvec3& center) {
  CameraSpec camera{.verticalFov = modelFieldOfView};
  if (model.camera) {
    camera = *model.camera;
    camera.position += center - model.mesh.center;
    camera.target += center - model.mesh.center;
  } else {
    const double r = model.mesh.radius * model.mesh.unit;
    const glm::dvec3 towards = glm::normalize(glm::dvec3(0.62, 0.36, 1.0));
    camera.target = center - glm::dvec3(0.0, 0.22 * r, 0.0);
    camera.position = camera.target + 1.3 * r / std::sin(glm::radians(0.5 * modelFieldOfView)) * towards;
  }
  return camera;
}

// Returns the lights of the model, or two that leave no side of it dark.
std::vector<PointLight> lightsOf(const Model& model, const glm::dvec3& center) {
  std::vector<PointLight> lights = model.lights;
  for (PointLight& light : lights) {
    light.position += center - model.mesh.center;
  }
  if (lights.empty()) {
    const double r = model.mesh.radius * model.mesh.unit;
    lights = {{.name = "key",
               .position = center + r * glm::dvec3(-2.2, 3.2, 2.6),
               .color = {1.0, 0.95, 0.88},
               .intensity = 58.0 * r * r,
               .radius = 0.05 * r,
               .castsShadow = true},
              {.name = "rim",
               .position = center + r * glm::dvec3(2.8, 2.6, -2.2),
               .color = {0.75, 0.85, 1.0},
               .intensity = 42.0 * r * r,
               .radius = 0.05 * r}};
  }
  return lights;
}

// Dims lights that reach the model with far more than the usual irradiance, of about 4, to this. glTF files give
// intensities in candela, so that every lamp in real units is such a light. The added sky keeps its brightness.
void dimLights(const fs::path& file, Model& model) {
  constexpr double usual = 4.0;
  constexpr double most = 24.0;
  double irradiance = 0.0;
  for (const PointLight& light : model.lights) {
    const double distance =
        std::max(glm::distance(light.position, model.mesh.center), model.mesh.radius * model.mesh.unit);
    irradiance += glm::compMax(light.color) * light.intensity / (distance * distance);
  }
  if (irradiance > most) {
    for (PointLight& light : model.lights) {
      light.intensity *= usual / irradiance;
    }
    spdlog::warn(oneLine(fmt::format("{}: its lights are very bright, their intensities are divided by {:.1f}",
                                     file.string(), irradiance / usual)));
  }
}

// Returns the text of a scene whose lengths scale with the radius of the model's bounding sphere, with the model's
// centre above the origin.
std::string sceneText(const fs::path& file, const Model& model) {
  const Mesh& mesh = model.mesh;
  const double r = mesh.radius * mesh.unit;
  const glm::dvec3 center(0.0, mesh.halfExtent.y * mesh.unit + gap * r, 0.0);
  std::string toml =
      fmt::format("# {} by itself, over a mirror of its size unless the camera is below it.\ntitle = {}\n\n",
                  tomlText(file.filename().string()), tomlText(file.stem().string()));
  toml +=
      "[environment]\n"
      "sky     = { zenith = [0.1, 0.21, 0.45], horizon = [0.8, 0.8, 0.78], ground = [0.5, 0.5, 0.5] }\n"
      "ambient = [0.22, 0.235, 0.26]\n\n";
  const CameraSpec camera = cameraOf(model, center);
  toml += fmt::format("[camera]\nposition     = {}\ntarget       = {}\nvertical_fov = {}\nnear         = {}\n",
                      tomlText(camera.position), tomlText(camera.target), camera.verticalFov, 1e-3 * r);
  toml += fmt::format("{}\n", model.camera ? "up           = " + tomlText(camera.up) + "\n" : "");
  toml += fmt::format("[[object]]\nname     = {}\nmodel    = {}\nposition = {}\n\n", tomlText(file.stem().string()),
                      tomlText(file.filename().string()), tomlText(center - mesh.center));
  for (const PointLight& light : lightsOf(model, center)) {
    toml += fmt::format(
        "[[light]]\nname         = {}\nposition     = {}\nintensity    = {}\nradius       = {}\n"
        "glow         = 0\ncolor        = {}\ncasts_shadow = {}\n\n",
        tomlText(light.name), tomlText(light.position), light.intensity, light.radius, tomlText(light.color),
        tomlText(light.castsShadow));
  }
  if (camera.position.y > 0.0) {  // the floor would hide the model from below
    toml += fmt::format(
        "[[mirror]]\nname        = \"floor\"\npolygon     = {}\nreflectance = [0.34, 0.35, 0.36]\n"
        "base_color  = [0.2, 0.2, 0.205]\ntwo_sided   = true\n",
        disc(stage * r));
  }
  return toml;
}

// Parses lists of numbers. Commas separate numbers, colons separate lists. Returns nothing for any other text.
std::optional<std::vector<std::vector<double>>> parseLists(std::string_view text) {
  std::vector<std::vector<double>> lists(1);
  const char* end = text.data() + text.size();
  for (const char* at = text.data();;) {
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value) || (next != end && *next != ',' && *next != ':')) {
      return std::nullopt;
    }
    lists.back().push_back(value);
    if (next == end) {
      return lists;
    }
    if (*next == ':') {
      lists.emplace_back();
    }
    at = next + 1;
  }
}

}  // namespace

fs::path fileNamedBy(const fs::path& scene, const std::string& name) {
  const fs::path named = scene.parent_path() / name;
  fs::path file = named.lexically_normal();
  std::error_code error;
  // The paths name different files if ".." follows a symbolic link to a folder.
  if (fs::exists(named, error) && !fs::equivalent(named, file, error)) {
    file = named;
  }
  return fs::exists(file, error) ? file : ModelFiles(scene).follow(scene.parent_path(), name).value_or(file);
}

Scene parseScene(const fs::path& file, std::string text) {
  const toml::table root = parseToml(file, text, "scene file");
  return readScene({file, "", root, 1, keys}, file, std::move(text));
}

Scene loadScene(const fs::path& file, const LoadProgress& progress) {
  if (isModelFile(file)) {
    return modelScene(file, progress);
  }
  if (lowerCase(file.extension().string()) != ".toml") {
    const std::string content = readInputText(file, "a scene file is needed");
    if (const auto foreign = content.empty() ? std::nullopt : foreignFile(content, "")) {
      throwInputError(file, 1, "file", foreign->wrong, foreign->right);
    }
  }
  std::string text = readTomlText(file, "scene file");
  const toml::table root = parseToml(file, text, "scene file");
  const TableReader reader(file, "", root, 1, keys);
  // Reads the file first, so that its errors are reported before models are loaded, which takes long.
  Scene scene = readScene(reader, file, std::move(text));
  ModelProgress models(scene, progress);
  std::map<std::string, int> known;
  size_t index = 0;
  for (const TableReader& table : reader.tables("object", keysOf<Object>())) {
    Object& object = scene.objects[index++];
    object.mesh = meshIndex(table, scene, known, models);
    if (const std::optional<std::string> remedy = extentRemedy(object, scene.meshes[object.mesh])) {
      table.fail("scale", "makes the model too large", *remedy);
    }
  }
  addMaps(reader, scene);
  addMaterialMirrors(scene);
  return scene;
}

int addModel(Scene& scene, const fs::path& file, const LoadProgress& progress) {
  const auto known = std::ranges::find_if(scene.meshes, [&](const Mesh& mesh) {
    std::error_code error;
    return mesh.source == file || fs::equivalent(mesh.source, file, error);
  });
  if (known != scene.meshes.end()) {
    return static_cast<int>(known - scene.meshes.begin());
  }
  const size_t textures = scene.textures.size();
  try {
    Mesh mesh = loadModel(file, scene.textures, progress, scene.meshes).mesh;
    if (const std::optional<std::string> remedy = extentRemedy({}, mesh)) {
      throwInputError(file, 1, "v", "makes the model too large", *remedy);
    }
    scene.meshes.push_back(std::move(mesh));
  } catch (...) {
    scene.textures.resize(textures);
    throw;
  }
  const size_t added = scene.meshes.size() - 1;
  cutMirrorParts(scene, added);
  return static_cast<int>(added);
}

std::string sceneTitle(const fs::path& file) {
  return tomlIfAny(file)["title"].value_or(std::string());
}

std::set<fs::path> filesNamedBy(const fs::path& file) {
  std::set<fs::path> files{file};
  std::set<fs::path> models;
  if (isModelFile(file)) {
    models = files;
  }
  const toml::table root = models.empty() ? tomlIfAny(file) : toml::table();
  for (size_t i = 0; root["object"][i]; ++i) {
    models.insert(fileNamedBy(file, root["object"][i]["model"].value_or(std::string())));
  }
  for (const fs::path& model : models) {
    addModelFiles(model, files);
  }
  for (size_t i = 0; root["mirror"][i]; ++i) {
    const fs::path map = fileNamedBy(file, root["mirror"][i]["reflectance_map"].value_or(std::string()));
    if (isFile(map)) {
      files.insert(map);
    }
  }
  return files;
}

bool isSceneFile(const fs::path& file) {
  const toml::table root = tomlIfAny(file);
  return root.contains("camera") || root.contains("object") || root.contains("mirror");
}

std::optional<fs::path> shippedScene(const fs::path& wanted) {
  if (wanted.is_relative()) {
    const fs::path scenes = dataDirectory("scenes");
    for (const fs::path& candidate : {scenes / wanted, scenes.parent_path() / wanted,
                                      scenes / (wanted.string() + ".toml"), scenes.parent_path() / "models" / wanted}) {
      if (isFile(candidate)) {
        return candidate;
      }
    }
  }
  return std::nullopt;
}

std::vector<std::string> shippedSceneNames() {
  const fs::path folder = dataDirectory("scenes");
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") {
      names.push_back(entry.path().lexically_relative(folder).replace_extension().generic_string());
    }
  }
  std::ranges::sort(names);
  return names;
}

Scene modelScene(const fs::path& file, const LoadProgress& progress) {
  std::vector<Texture> textures;
  Model model = loadModel(file, textures, progress);
  Mesh& mesh = model.mesh;
  const double radius = mesh.radius * mesh.unit;
  if (!(radius >= smallest && radius <= largest)) {
    throwInputError(file, 1, "model", fmt::format("the model's bounding sphere has a radius of {} m", radius),
                    "1e-9 .. 1e12 is needed, or a scene that scales the model");
  }
  dimLights(file, model);
  Scene scene = parseScene(file, sceneText(file, model));
  scene.objects[0].mesh = 0;
  scene.meshes.push_back(std::move(mesh));
  scene.textures = std::move(textures);
  addMaterialMirrors(scene);
  return scene;
}

bool meansPoints(const std::string& text) {
  const bool number = !text.empty() && std::string_view("+-.0123456789").find(text.front()) != std::string_view::npos;
  return number && text.find(',') != std::string::npos &&
         (text.find(':') != std::string::npos || text.find_first_not_of("+-.,0123456789eE \t") == std::string::npos);
}

Bookmark parseCamera(const std::string& text) {
  const auto lists = parseLists(text).value_or(std::vector<std::vector<double>>());
  const size_t count = lists.size();
  const auto vectors = std::span(lists).first(std::min<size_t>(count, 3));
  const bool points = std::ranges::all_of(vectors, [](const auto& list) { return list.size() == 3; });
  const bool angle = count < 4 || (lists[3].size() == 1 && fieldOfViewRange.contains(lists[3][0]));
  if (count < 2 || count > 4 || !points || !angle) {
    throw std::invalid_argument(
        "'" + text +
        "' is not a camera (position:target, position:target:up or position:target:up:FOV with a vertical "
        "field of view of 1 .. 170 degrees, such as 0,1,4:0,1,0)");
  }
  for (const std::vector<double>& vector : vectors) {
    for (const double value : vector) {
      if (!coordinateRange.contains(value)) {
        throw std::invalid_argument(fmt::format("{} is out of range ({})", value, coordinateRange.text()));
      }
    }
  }
  const auto point = [&](size_t i) { return glm::dvec3(lists[i][0], lists[i][1], lists[i][2]); };
  return {.position = point(0),
          .target = point(1),
          .up = count > 2 ? std::optional(point(2)) : std::nullopt,
          .verticalFov = count > 3 ? std::optional(lists[3][0]) : std::nullopt};
}

}  // namespace speculum
