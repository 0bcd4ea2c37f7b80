#include "window/scene_browser.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "core/vulkan_result.hpp"
#include "edit/recovery.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"
#include "scene/fingerprint.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

constexpr size_t mostListed = 64;  // files of one folder
constexpr size_t mostRecent = 10;
constexpr glm::ivec2 thumbnailSize(192, 108);  // pixels; scripts/thumbnails makes none of another size
constexpr size_t mostThumbnails = 200;         // in the user's cache

bool mayBeScene(const fs::path& file) {
  return file.extension() == ".toml";
}

std::vector<fs::path> filesIn(const fs::path& folder, bool (*wanted)(const fs::path& file)) {
  std::error_code none;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? fs::path(".") : folder, none)) {
    if (wanted(entry.path())) {
      files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  files.resize(std::min(files.size(), mostListed));
  return files;
}

fs::path recentFile() {
  return userConfigDir() / "recent";
}

fs::path shippedThumbnail(const fs::path& scene) {
  return scene.parent_path() / "thumbnails" / (scene.stem().string() + ".jpg");
}

fs::path storedThumbnail(const fs::path& scene) {
  Fingerprint path;
  path.add(std::string_view(withoutLinks(scene).string()));
  return userCacheDir() / "thumbnails" / (path.hex() + ".jpg");
}

// Returns where the scene's thumbnail is, or would be stored.
fs::path thumbnailOf(const fs::path& scene) {
  const fs::path shipped = shippedThumbnail(scene);
  return isFile(shipped) ? shipped : storedThumbnail(scene);
}

// Returns the middle of the picture, shrunk by averages of its 8-bit codes.
Image8 shrunk(const Image8& picture) {
  const glm::dvec2 size(picture.width, picture.height);
  const double scale = std::min(size.x / thumbnailSize.x, size.y / thumbnailSize.y);
  const glm::dvec2 corner = 0.5 * (size - scale * glm::dvec2(thumbnailSize));
  Image8 small(thumbnailSize.x, thumbnailSize.y);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      const glm::ivec2 low = glm::clamp(glm::ivec2(corner + scale * glm::dvec2(x, y)), {0, 0}, glm::ivec2(size) - 1);
      const glm::ivec2 high = glm::max(glm::ivec2(corner + scale * glm::dvec2(x + 1, y + 1)), low + 1);
      glm::ivec4 sum(0);
      for (int v = low.y; v < high.y; ++v) {
        for (int u = low.x; u < high.x; ++u) {
          const uint8_t* code = picture.at(u, v);
          sum += glm::ivec4(code[0], code[1], code[2], 1);
        }
      }
      for (int i = 0; i < 3; ++i) {
        small.at(x, y)[i] = static_cast<uint8_t>(sum[i] / sum.w);
      }
    }
  }
  return small;
}

}  // namespace

std::vector<fs::path> SceneBrowser::shippedModels() {
  return filesIn(dataDirectory("scenes").parent_path() / "models", isModelFile);
}

fs::path SceneBrowser::newScene() {
  return dataDirectory("scenes") / "new" / "untitled.toml";
}

bool SceneBrowser::isNew(const fs::path& scene) {
  std::error_code none;
  return fs::equivalent(scene, newScene(), none);
}

SceneBrowser::SceneBrowser() {
  readRecent();
}

// Reads what this window and others have stored, without files that are gone. Where nothing can be stored, what this
// window opened before is known to it alone, and stays behind the others.
void SceneBrowser::readRecent() {
  const std::vector<fs::path> before = std::exchange(shown_.recent, {});
  const auto add = [&](const fs::path& file) {
    if (shown_.recent.size() < mostRecent && isFile(file) && std::ranges::count(shown_.recent, file) == 0) {
      shown_.recent.push_back(file);
    }
  };
  std::istringstream lines(readTextIfAny(recentFile(), 1u << 16));
  for (std::string line; std::getline(lines, line);) {
    add(line);
  }
  std::ranges::for_each(before, add);
}

void SceneBrowser::remember(const fs::path& file) {
  if (isNew(file) || Recovery::isCopy(file)) {
    return;
  }
  readRecent();
  const fs::path whole = wholePath(file).lexically_normal();
  std::erase_if(shown_.recent, [&](const fs::path& one) { return withoutLinks(one) == withoutLinks(whole); });
  shown_.recent.insert(shown_.recent.begin(), whole);
  shown_.recent.resize(std::min(shown_.recent.size(), mostRecent));
  std::string text;
  for (const fs::path& recent : shown_.recent) {
    text += recent.string() + "\n";
  }
  storeFile(recentFile(), text, Links::follow);
}

void SceneBrowser::list(const fs::path& file) {
  const std::vector<SceneEntry> before = std::exchange(shown_.scenes, {});
  indices_.clear();
  for (const fs::path& own : filesIn(file.parent_path(), mayBeScene)) {
    if (isSceneFile(own)) {
      add(own);
    }
  }
  add(file);
  for (const fs::path& shipped : filesIn(dataDirectory("scenes"), mayBeScene)) {
    add(shipped);
  }
  addSaved(before);
  shown_.shown = add(file);
}

void SceneBrowser::addSaved(const std::vector<SceneEntry>& scenes) {
  for (const SceneEntry& entry : scenes) {
    if (!isNew(entry.file)) {
      add(entry.file);
    }
  }
}

size_t SceneBrowser::add(const fs::path& file) {
  const auto [known, isNew] = indices_.try_emplace(withoutLinks(file), shown_.scenes.size());
  if (isNew) {
    const bool model = isModelFile(file);
    shown_.scenes.push_back({.name = (model ? file.filename() : file.stem()).string(),
                             .title = model ? std::string() : sceneTitle(file),
                             .file = wholePath(file).lexically_normal()});
  }
  return known->second;
}

void SceneBrowser::show(const fs::path& file, bool withFolder) {
  remember(file);
  const bool leavesNew = isNew(shown_.scenes[shown_.shown].file) && !isNew(file);
  if (leavesNew) {
    indices_.clear();
    addSaved(std::exchange(shown_.scenes, {}));
  }
  const size_t known = shown_.scenes.size();
  shown_.shown = add(file);
  const bool fresh = shown_.scenes.size() > known;
  if (fresh && withFolder) {
    list(file);
  }
  listed_ = listed_ || fresh || leavesNew;
}

std::vector<Image8> SceneBrowser::thumbnails() {
  std::vector<Image8> pictures;
  for (const SceneEntry& entry : shown_.scenes) {
    pictures.push_back(readThumbnail(entry.file));
  }
  return pictures;
}

Image8 SceneBrowser::readThumbnail(const fs::path& scene) {
  const fs::path file = thumbnailOf(scene);
  Image8 picture;
  try {
    picture = isFile(file) ? readImage8(file) : Image8();
  } catch (const std::runtime_error& error) {
    if (broken_.insert(file).second) {
      spdlog::warn("{}", error.what());
    }
  }
  // Drops a large picture, which would leave too little of the shared texture for the fonts.
  const bool fits = picture.width <= thumbnailSize.x && picture.height <= thumbnailSize.y;
  return fits ? picture : Image8();
}

void SceneBrowser::storeThumbnail(const std::function<Image8()>& picture) {
  const fs::path& scene = shown_.scenes[shown_.shown].file;
  if (isNew(scene) || isFile(shippedThumbnail(scene))) {
    return;
  }
  try {
    const fs::path file = storedThumbnail(scene);
    listed_ = storeFile(file, encodeJpeg(shrunk(picture()), 80)) || listed_;
    keepNewest(file.parent_path(), mostThumbnails);
  } catch (const OutOfMemoryError& error) {  // of the GPU, where the picture is read
    spdlog::info("no thumbnail of {}: {}", scene.string(), error.what());
  }
}

void SceneBrowser::open(const fs::path& file, const Options& options) {
  load_.start({file, 0.0}, [file, options](const auto& report) {
    const auto progress = [&](const fs::path& now, double done) {
      if (!report({now, done})) {
        throw std::runtime_error("cancelled");
      }
    };
    return std::make_unique<LoadedScene>(loadSceneWithSettings(file, options, progress));
  });
}

fs::path SceneBrowser::choose(const std::vector<fs::path>& files) {
  const auto file = std::ranges::find_if(
      files, [](const fs::path& candidate) { return isModelFile(candidate) || mayBeScene(candidate); });
  if (file == files.end()) {
    throw InputError((files.empty() ? std::string("nothing") : files.front().string()) +
                     ": not a scene (a .toml scene or a " + modelFormatNames() + " model is needed)");
  }
  return *file;
}

void SceneBrowser::updateView() {
  const std::optional<Progress> progress = load_.progress();
  shown_.loading = progress ? progress->file.filename().string() : "";
  shown_.loaded = progress ? progress->done : 0.0;
}

}  // namespace speculum
