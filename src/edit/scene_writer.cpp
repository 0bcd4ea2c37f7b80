#include "edit/scene_writer.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "edit/toml_editor.hpp"
#include "platform/files.hpp"
#include "platform/text.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_fields.hpp"
#include "scene/scene_loader.hpp"
#include "scene/toml_file.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

// Returns a path as it stands in scene files: with '/', in UTF-8, and absolute only if no relative path exists.
std::string pathFrom(const fs::path& folder, const fs::path& target) {
  const fs::path to = withoutLinks(target);
  const fs::path relative = to.lexically_relative(withoutLinks(folder.empty() ? fs::path(".") : folder));
  return utf8((relative.empty() ? to : relative).generic_string());
}

bool leadsTo(const fs::path& path, const fs::path& file) {
  std::error_code error;
  return path.lexically_normal() == file || fs::equivalent(path, file, error);
}

// Sets the models' paths for a scene in `file`. Keeps paths that are still right as the user wrote them.
void nameModels(const Scene& loaded, std::span<const Mesh> meshes, const fs::path& file, SceneContent& content) {
  const bool moved = withoutLinks(loaded.file).parent_path() != withoutLinks(file).parent_path();
  for (size_t i = 0; i < content.objects.size(); ++i) {
    Object& object = content.objects[i];
    const int origin = content.origins.objects[i];
    const Object* before = origin < 0 ? nullptr : &loaded.objects.at(origin);
    const fs::path& source = meshes[object.mesh].source;
    if (before != nullptr && before->mesh == object.mesh && (!moved || fs::path(before->model).is_absolute()) &&
        leadsTo(fileNamedBy(loaded.file, before->model), source)) {
      object.model = before->model;
    } else {
      object.model = pathFrom(file.parent_path(), source);
    }
  }
}

// Sets the maps' paths in the same way.
void nameMaps(const Scene& loaded, std::span<const Texture> textures, const fs::path& file, SceneContent& content) {
  const bool moved = withoutLinks(loaded.file).parent_path() != withoutLinks(file).parent_path();
  for (Mirror& mirror : content.mirrors) {
    if (mirror.map < 0) {
      continue;
    }
    const fs::path& source = textures[mirror.map].source;
    const std::string& before = mirror.reflectanceMap;
    if ((moved && !fs::path(before).is_absolute()) || !leadsTo(fileNamedBy(loaded.file, before), source)) {
      mirror.reflectanceMap = pathFrom(file.parent_path(), source);
    }
  }
}

template <typename Field, typename Value>
std::string textOf(const Field& field, const Value& value) {
  if constexpr (std::is_same_v<Value, glm::dvec3>) {
    if (field.uniform && value.x == value.y && value.y == value.z) {
      return tomlText(value.x);
    }
  }
  if constexpr (std::is_enum_v<Value>) {
    return tomlText(choicesOf(value)[static_cast<size_t>(value)]);
  } else {
    return tomlText(value);
  }
}

template <Described Node>
void addKeys(const Node& node, const std::string& table, std::vector<KeyText>& keys) {
  const Node usual{};
  forEachField<Node>([&](const auto& field) {
    if (!field.appliesTo(node)) {
      return;
    }
    using Value = typename std::decay_t<decltype(field)>::Value;
    const std::string key(field.key);
    const Value& value = node.*field.member;
    if constexpr (Described<Value>) {
      addKeys(value, key, keys);
    } else if constexpr (!IsOptional<Value>::value) {
      const std::string text = textOf(field, value);
      const bool omissible = !field.required && !field.alwaysSaved && text == textOf(field, usual.*field.member);
      keys.push_back({table, key, text, omissible});
    } else if constexpr (Described<typename Value::value_type>) {
      if (value) {
        addKeys(*value, key, keys);
      }
    } else if (value) {
      keys.push_back({table, key, textOf(field, *value), false});
    }
  });
}

// Returns every key that says something about the node, in the order of its description.
template <Described Node>
std::vector<KeyText> keyTexts(const Node& node) {
  std::vector<KeyText> keys;
  addKeys(node, "", keys);
  return keys;
}

template <typename T>
void editList(TomlEditor& editor, const std::string& name, const std::vector<T>& loaded, const std::vector<T>& edited,
              const std::vector<int>& origins) {
  std::vector<bool> kept(loaded.size(), false);
  for (size_t i = 0; i < edited.size(); ++i) {
    const int origin = origins[i];
    if (origin < 0) {
      editor.addElement(name, keyTexts(edited[i]));
    } else {
      kept.at(origin) = true;
      editor.change(editor.element(name, origin), keyTexts(loaded[origin]), keyTexts(edited[i]));
    }
  }
  for (size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) {
      editor.remove(editor.element(name, i));
    }
  }
}

template <typename T>
void editTable(TomlEditor& editor, const std::string& name, const T& loaded, const T& edited) {
  if (const toml::table* table = editor.root().get_as<toml::table>(name)) {
    editor.change(*table, keyTexts(loaded), keyTexts(edited));
  } else if (!(loaded == edited)) {
    editor.addSection(name, {"environment", "camera"}, keyTexts(edited));
  }
}

// Returns the value of `key`, whose parts may be quoted together or nested; null if the table lacks it.
const toml::node* findSetting(const toml::table& table, std::string_view key) {
  for (const auto& [name, node] : table) {
    const toml::table* inner = node.as_table();
    if (!inner && name.str() == key) {
      return &node;
    }
    if (inner && key.starts_with(std::string(name.str()) + ".")) {
      if (const toml::node* found = findSetting(*inner, key.substr(name.str().size() + 1))) {
        return found;
      }
    }
  }
  return nullptr;
}

std::string settingText(const SettingChange& change) {
  const nlohmann::ordered_json usual = settingsJson(Settings())[change.key];
  if (usual.is_string()) {
    return tomlText(std::string_view(change.value));
  }
  std::string text;
  for (const char c : change.value) {
    text.append(1, c).append(c == ',' ? " " : "");
  }
  return text;
}

void editSettings(TomlEditor& editor, const Settings& loaded, std::span<const SettingChange> changes) {
  std::vector<KeyText> fresh;
  for (const SettingChange& change : changes) {
    const toml::table* settings = editor.root().get_as<toml::table>("settings");
    const toml::node* found = settings ? findSetting(*settings, change.key) : nullptr;
    if (settingValue(loaded, change.key) == change.value) {
      continue;
    }
    if (found && change.value.empty()) {
      editor.remove(*found);
    } else if (found) {
      editor.setValue(*found, settingText(change));
    } else if (settings) {
      editor.addKey(*settings, tomlKey(change.key), settingText(change));
    } else {
      fresh.push_back({"", tomlKey(change.key), settingText(change)});
    }
  }
  if (!fresh.empty()) {
    editor.addSection("settings", {"environment", "camera"}, fresh);
  }
}

template <typename T>
bool sameTexts(const T& a, const T& b) {
  return keyTexts(a) == keyTexts(b);
}

template <typename T>
bool sameLists(const std::vector<T>& a, const std::vector<T>& b) {
  return std::ranges::equal(a, b, sameTexts<T>);
}

bool readsBack(const Scene& read, const SceneContent& content) {
  return sameTexts(read.environment, content.environment) && sameTexts(read.camera, content.camera) &&
         sameLists(read.objects, content.objects) && sameLists(read.lights, content.lights) &&
         sameLists(read.mirrors, content.mirrors) && sameLists(read.bookmarks, content.bookmarks);
}

template <typename Error = SaveError>
[[noreturn]] void refuse(const fs::path& file, const std::string& what, const std::string& remedy) {
  throw Error(oneLine(file.string() + ": not saved: " + what + " (" + remedy + ")"));
}

void check(const fs::path& file, const std::string& text, const SceneContent& content, std::span<const Mesh> meshes,
           std::span<const Texture> textures, const Settings& settings) {
  const std::string remedy = "undo the last changes; the file is as it was";
  try {
    const Scene read = parseScene(file, text);
    if (!readsBack(read, content) || settingsOf(read) != settings) {
      refuse(file, "what was written does not read back as the scene", remedy);
    }
  } catch (const InputError& error) {
    refuse(file, "the scene is not one that can be read: " + std::string(error.what()), remedy);
  }
  const auto checkFound = [&](const std::string& kind, const fs::path& source, const std::string& name) {
    std::error_code error;
    if (isFolder(wholePath(file).parent_path()) && !fs::equivalent(fileNamedBy(file, name), source, error)) {
      refuse(file, "its " + kind + " " + source.string() + " would not be found as '" + name + "'",
             "put the " + kind + " back, or save into another folder");
    }
  };
  for (const Object& object : content.objects) {
    checkFound("model", meshes[object.mesh].source, object.model);
  }
  for (const Mirror& mirror : content.mirrors) {
    if (mirror.map >= 0) {
      checkFound("map", textures[mirror.map].source, mirror.reflectanceMap);
    }
  }
}

// Returns the meshes or textures that a node uses and whose files are not below the folder.
template <typename Source, typename Node>
std::vector<size_t> sourcesOutside(const std::vector<Source>& sources, const std::vector<Node>& nodes, int Node::*index,
                                   const fs::path& folder) {
  const fs::path inside = withoutLinks(folder);
  std::vector<size_t> outside;
  for (size_t i = 0; i < sources.size(); ++i) {
    if (std::ranges::count(nodes, static_cast<int>(i), index) > 0 &&
        !isBelow(withoutLinks(sources[i].source), inside)) {
      outside.push_back(i);
    }
  }
  return outside;
}

// Says whether the folder holds copies of exactly these files below `root`. Any other file there could be found in the
// place of one that a model names.
bool holdsCopies(const fs::path& folder, const std::set<fs::path>& files, const fs::path& root) {
  std::error_code error;
  size_t count = 0;
  fs::recursive_directory_iterator entry(folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (entry->symlink_status(error).type() == fs::file_type::directory) {
      continue;
    }
    const fs::path from = root / entry->path().lexically_relative(folder);
    if (!files.contains(from) || !isFile(*entry) || fs::file_size(from, error) != entry->file_size(error) ||
        readFile(from) != readFile(*entry)) {
      return false;
    }
    ++count;
  }
  return !error && count == files.size();
}

// Leaves no folder behind if a file cannot be copied.
void makeCopies(const fs::path& folder, const std::set<fs::path>& files, const fs::path& root) {
  std::error_code none;
  try {
    for (const fs::path& file : files) {
      const fs::path copy = folder / file.lexically_relative(root);
      fs::create_directories(copy.parent_path(), none);
      replaceFile(copy, readFile(file));
    }
  } catch (const FileError&) {
    fs::remove_all(folder, none);
    throw;
  }
}

// Copies files below `root`, keeping their relative paths, by which they name each other. Returns the copies' folder.
fs::path copyTogether(const std::set<fs::path>& files, const fs::path& root, const fs::path& folder) {
  constexpr int mostFolders = 1000;
  bool exists = true;
  for (int number = 1; exists && number <= mostFolders; ++number) {
    const fs::path target = folder / (number == 1 ? "models" : "models-" + std::to_string(number));
    std::error_code none;
    exists = fs::exists(fs::symlink_status(target, none));
    if (!exists) {
      makeCopies(target, files, root);
    }
    if (holdsCopies(target, files, root)) {
      return target;
    }
  }
  throw FileError(folder, "has no place for copies of the models", "save into another folder");
}

}  // namespace

std::vector<size_t> modelsOutside(const Scene& scene, const fs::path& folder) {
  return sourcesOutside(scene.meshes, scene.objects, &Object::mesh, folder);
}

std::vector<size_t> mapsOutside(const Scene& scene, const fs::path& folder) {
  return sourcesOutside(scene.textures, scene.mirrors, &Mirror::map, folder);
}

SourceFiles copyModels(const Scene& scene, const fs::path& folder) try {
  SourceFiles copied;
  std::ranges::transform(scene.meshes, std::back_inserter(copied.meshes), &Mesh::source);
  std::ranges::transform(scene.textures, std::back_inserter(copied.textures), &Texture::source);
  struct Together {
    std::set<fs::path> files;
    std::vector<fs::path*> sources;
  };
  std::map<fs::path, Together> roots;
  const auto add = [&](fs::path& source, std::span<const fs::path> named) {
    source = wholePath(source).lexically_normal();
    std::vector<fs::path> files{source};
    fs::path root = source.parent_path();
    for (const fs::path& name : named) {
      files.push_back((source.parent_path() / name).lexically_normal());
      while (!isBelow(files.back(), root)) {
        root = root.parent_path();
      }
    }
    Together& together = roots[root];
    together.files.insert(files.begin(), files.end());
    together.sources.push_back(&source);
  };
  for (const size_t i : modelsOutside(scene, folder)) {
    add(copied.meshes[i], scene.meshes[i].namedFiles);
  }
  for (const size_t i : mapsOutside(scene, folder)) {
    add(copied.textures[i], {});
  }
  for (const auto& [root, together] : roots) {
    const fs::path target = copyTogether(together.files, root, withoutLinks(folder));
    for (fs::path* source : together.sources) {
      *source = target / source->lexically_relative(root);
    }
  }
  return copied;
} catch (const FileError& error) {
  throw SaveError("not saved: " + std::string(error.what()));
}

std::string editedText(const Scene& loaded, const SceneContent& edited, std::span<const Mesh> meshes,
                       std::span<const Texture> textures, std::span<const SettingChange> settings, const fs::path& file,
                       ReadBack readBack) {
  SceneContent content = edited;
  nameModels(loaded, meshes, file, content);
  nameMaps(loaded, textures, file, content);
  Settings wanted = settingsOf(loaded);
  const Settings before = wanted;
  for (const SettingChange& change : settings) {
    if (const auto problem = setSetting(wanted, change.key, change.value)) {
      throw SaveError(*problem);
    }
  }
  TomlEditor editor(loaded.text);
  editTable(editor, "environment", loaded.environment, content.environment);
  editTable(editor, "camera", loaded.camera, content.camera);
  editSettings(editor, before, settings);
  editList(editor, "object", loaded.objects, content.objects, content.origins.objects);
  editList(editor, "light", loaded.lights, content.lights, content.origins.lights);
  editList(editor, "mirror", loaded.mirrors, content.mirrors, content.origins.mirrors);
  editList(editor, "bookmark", loaded.bookmarks, content.bookmarks, content.origins.bookmarks);
  std::string text = editor.text();
  if (readBack == ReadBack::required) {
    check(file, text, content, meshes, textures, wanted);
  }
  return text;
}

void requireOwnFile(const fs::path& file, const std::optional<std::string>& expected) try {
  std::error_code error;
  if (fs::exists(file, error) && (!expected || readText(file) != *expected)) {
    refuse<OverwriteError>(
        file, expected ? "another program has changed the file since it was read" : "there is such a file already",
        "save under another name, or overwrite it");
  }
} catch (const FileError& problem) {
  throw SaveError(oneLine("not saved: " + std::string(problem.what())));
}

void writeSceneFile(const fs::path& file, const std::string& text) try {
  replaceFile(file, text);
} catch (const FileError& problem) {
  throw SaveError(oneLine("not saved: " + std::string(problem.what())));
}

fs::path sceneFileNamed(const fs::path& file) {
  if (!file.has_filename()) {
    refuse(file, "there is no file name", "add one such as scene.toml");
  }
  return file.extension() == ".toml" || isModelFile(file) ? file : fs::path(file) += ".toml";
}

void requireFolder(const fs::path& file) {
  std::error_code none;
  fs::path missing;
  fs::path folder = fs::absolute(file, none).parent_path();  // empty if the working folder was deleted
  for (; !folder.empty() && !fs::is_directory(folder, none); folder = folder.parent_path()) {
    missing = folder;
  }
  if (folder.empty()) {
    refuse(file, "the working folder does not exist any more", "name a whole path");
  }
  if (!missing.empty()) {
    refuse(file, "there is no folder " + missing.string(), "create it, or name a file in another");
  }
}

}  // namespace speculum
