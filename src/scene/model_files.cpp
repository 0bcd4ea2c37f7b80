#include "scene/model_files.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <utility>

#include "platform/bytes.hpp"
#include "platform/files.hpp"
#include "platform/text.hpp"
#include "scene/gltf_file.hpp"
#include "scene/obj_loader.hpp"
#include "scene/text_lines.hpp"

namespace speculum {

namespace {

namespace fs = std::filesystem;

// Returns what is equal for names that differ in the case of letters of ASCII, or in being UTF-8 or Latin-1.
std::string keyOf(const fs::path& name) {
  return lowerCase(utf8(name.string()));
}

Model loadObjModel(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress) {
  return {.mesh = loadObj(file, textures, progress)};
}

constexpr std::array formats{ModelFormat{".obj", "Wavefront OBJ", &loadObjModel, &addFilesOfObj},
                             ModelFormat{".gltf", "glTF 2.0", &loadGltf, &addFilesOfGltf},
                             ModelFormat{".glb", "glTF 2.0", &loadGltf, &addFilesOfGltf}};

const ModelFormat* formatOf(const std::filesystem::path& file) {
  const auto found = std::ranges::find(formats, lowerCase(file.extension().string()), &ModelFormat::extension);
  return found == formats.end() ? nullptr : &*found;
}

// Says whether the first line that is no comment begins with one of the keywords.
bool beginsWith(std::string_view text, std::span<const std::string_view> keywords) {
  LineReader line(text, LineReader::Continuation::none);
  return line.next() && line.tokens().size() > 1 && line.tokens()[1] != "=" &&
         std::ranges::find(keywords, line.keyword()) != keywords.end();
}

const ModelFormat& formatOrFirst(const std::filesystem::path& file) {
  const ModelFormat* format = formatOf(file);
  return format == nullptr ? formats.front() : *format;
}

}  // namespace

std::optional<fs::path> ModelFiles::find(const fs::path& namingFile, std::string_view name) {
  std::string_view tried;
  std::optional<fs::path> found;
  for (const std::string_view form : {name, trimmed(name), withoutComment(name)}) {
    if (!found && form != std::exchange(tried, form)) {
      found = findWhole(namingFile, form);
    }
  }
  return found;
}

std::optional<fs::path> ModelFiles::findWhole(const fs::path& namingFile, std::string_view name) {
  std::string path(withoutQuotes(name));
  std::ranges::replace(path, '\\', '/');
  if (path.empty()) {
    return std::nullopt;
  }
  std::vector<fs::path> folders{namingFile.parent_path()};
  if (folders[0].native() != modelFolder_.native()) {
    folders.push_back(modelFolder_);
  }
  for (const fs::path& folder : folders) {
    if (fs::path file = (folder / path).lexically_normal(); isFile(file)) {
      return file;
    }
  }
  const std::string last = path.substr(path.find_last_of("/:") + 1);
  for (const fs::path& folder : folders) {
    for (const std::string& below : {path, last, "textures/" + last, "tex/" + last, "maps/" + last}) {
      if (const auto file = follow(folder, below)) {
        return file;
      }
    }
  }
  return std::nullopt;
}

std::optional<fs::path> ModelFiles::follow(fs::path folder, const fs::path& path) {
  const fs::path below = path.lexically_normal();
  if (below.empty() || below.has_root_path()) {
    return std::nullopt;
  }
  for (const fs::path& name : below.parent_path()) {
    if (name == "..") {
      folder = (folder / "..").lexically_normal();
      continue;
    }
    const Listing& here = listing(folder);
    const auto found = here.folders.find(keyOf(name));
    if (found == here.folders.end()) {
      return std::nullopt;
    }
    folder = found->second;
  }
  const Listing& here = listing(folder);
  const auto file = here.files.find(keyOf(below.filename()));
  return file == here.files.end() ? std::nullopt : std::optional(file->second);
}

const ModelFiles::Listing& ModelFiles::listing(const fs::path& folder) {
  constexpr int mostEntries = 100'000;
  const auto [known, isNew] = listings_.try_emplace(folder);
  Listing& listing = known->second;
  if (!isNew) {
    return listing;
  }
  std::error_code none;
  fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, none);
  for (int count = 0; entry != fs::directory_iterator() && count < mostEntries; entry.increment(none), ++count) {
    const fs::path name = entry->path().filename();
    auto& paths = isFolder(entry->path()) ? listing.folders : listing.files;
    // Names may differ in case alone. The one that sorts first is kept, so that the order of listing does not matter.
    const auto [other, isFirst] = paths.try_emplace(keyOf(name), folder / name);
    if (!isFirst) {
      other->second = std::min(other->second, folder / name);
    }
  }
  return listing;
}

std::optional<ForeignFile> foreignFile(std::string_view content, std::string_view readAs) {
  struct Beginning {
    std::string_view text;
    const char* wrong;
    const char* right = nullptr;  // null: another format
  };
  const std::string asModel = "save it as a " + modelFormatNames() + " file";
  static constexpr std::array beginnings{
      Beginning{"version https://git-lfs", "is a Git LFS pointer, not the model itself",
                "fetch it with 'git lfs pull'"},
      Beginning{"solid", "is an STL file"},
      Beginning{"ply\n", "is a PLY file"},
      Beginning{"ply\r", "is a PLY file"},
      Beginning{"OFF", "is an OFF file"},
      Beginning{"COFF", "is an OFF file"},
      Beginning{"glTF", "is a glTF file", "let its name end with .glb"},
      Beginning{"Kaydara FBX", "is an FBX file"},
      Beginning{"; FBX", "is an FBX file"},
      Beginning{"BLENDER", "is a Blender file"},
      Beginning{"PK\x03\x04", "is a ZIP archive", "unpack it"},
      Beginning{"\x1f\x8b", "is compressed with gzip, as Blender files may be", "unpack it"},
      Beginning{"\x28\xb5\x2f\xfd", "is compressed with Zstandard, as Blender files are", "unpack it"},
      Beginning{"7z\xbc\xaf", "is a 7z archive", "unpack it"},
      Beginning{"Rar!", "is a RAR archive", "unpack it"},
      Beginning{"MM", "is a 3DS file"},
      Beginning{"<?xml", "is an XML file"},
      Beginning{"ISO-10303", "is a STEP file"},
      Beginning{"#VRML", "is a VRML file"},
      Beginning{"#usda", "is a USD file"},
      Beginning{"PXR-USDC", "is a USD file"},
  };
  constexpr std::string_view byteOrderMark = "\xef\xbb\xbf";
  const std::string_view text = trimmed(content.substr(content.starts_with(byteOrderMark) ? byteOrderMark.size() : 0));
  if (text.empty()) {
    return ForeignFile{"is empty", "a " + modelFormatNames() + " file is needed"};
  }
  if (readAs == ".gltf" && text.starts_with("{")) {
    return std::nullopt;
  }
  if (text.starts_with("<") && text.substr(0, 4096).find("<COLLADA") != std::string_view::npos) {
    return ForeignFile{"is a COLLADA file", asModel};
  }
  const auto found =
      std::ranges::find_if(beginnings, [&](const Beginning& beginning) { return text.starts_with(beginning.text); });
  if (found != beginnings.end()) {
    return ForeignFile{found->wrong, found->right ? found->right : asModel};
  }
  if (const std::string first = lowerCase(std::string(text.substr(0, 9)));
      first == "<!doctype" || first.starts_with("<html")) {
    return ForeignFile{"is a web page", "download the file itself"};
  }
  constexpr std::array<std::string_view, 1> ofMtl{"newmtl"};
  if (beginsWith(text, ofMtl)) {
    return ForeignFile{"is a material file", "name the OBJ file that uses it"};
  }
  if (text.starts_with("{") && content.substr(0, 4096).find("\"asset\"") != std::string_view::npos) {
    return ForeignFile{"is a glTF file", "let its name end with .gltf"};
  }
  constexpr std::array<std::string_view, 9> ofObj{"mtllib", "usemtl", "o", "g", "s", "v", "vt", "vn", "f"};
  if (readAs != ".obj" && beginsWith(text, ofObj)) {
    return ForeignFile{"is a Wavefront OBJ file", "let its name end with .obj"};
  }
  // A binary STL file has 80 bytes of any text, the number of its triangles, and 50 bytes for each.
  if (content.size() >= 84 && content.size() == 84 + 50 * size_t{littleEndian(content.substr(80))}) {
    return ForeignFile{"is an STL file", asModel};
  }
  if (isUtf16(content)) {
    return ForeignFile{"is UTF-16 text", "save it as UTF-8"};
  }
  if (content.find('\0') != std::string_view::npos) {
    return ForeignFile{"is not a text file", "a " + modelFormatNames() + " file is needed", false};
  }
  return std::nullopt;
}

ModelDefects::Kind& ModelDefects::add(const fs::path& file, int line, std::string_view key, std::string_view kind,
                                      std::string_view detail, std::string_view reason) {
  constexpr size_t mostKinds = 50;   // a file may give any number of reasons
  constexpr size_t mostShown = 200;  // a damaged file may have tokens of any length
  auto known = std::ranges::find_if(kinds_, [&](const Kind& other) {
    return other.kind == kind && other.key == key && other.reason == reason && other.file.native() == file.native();
  });
  if (known == kinds_.end() && kinds_.size() > mostKinds) {
    known = kinds_.end() - 1;
  } else if (known == kinds_.end()) {
    kind = kinds_.size() == mostKinds ? "has more kinds of defects, which are counted here" : kind;
    std::string text = fmt::format("{}:{}: {}: ", file.string(), line, key);
    text += fmt::format(fmt::runtime(kind),
                        std::string(detail.substr(0, mostShown)) + (detail.size() > mostShown ? "..." : ""));
    kinds_.push_back({file, std::string(key), kind, std::string(reason), oneLine(std::move(text))});
    known = kinds_.end() - 1;
  }
  ++known->count;
  return *known;
}

namespace {

std::string warningOf(const ModelDefects::Kind& kind) {
  return kind.count > 1 ? fmt::format("{} (and {} more)", kind.text, kind.count - 1) : kind.text;
}

}  // namespace

std::vector<std::string> ModelDefects::report() const {
  std::vector<std::string> texts;
  std::ranges::transform(kinds_, std::back_inserter(texts), warningOf);
  return texts;
}

std::optional<std::string> ModelDefects::lostTriangles() const {
  const auto found = std::ranges::find_if(kinds_, &Kind::costsTriangles);
  return found == kinds_.end() ? std::nullopt : std::optional(warningOf(*found));
}

bool isModelFile(const std::filesystem::path& file) {
  return formatOf(file) != nullptr;
}

Model loadModel(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress,
                std::span<const Mesh> others) {
  const size_t known = textures.size();
  Model model = formatOrFirst(file).load(file, textures, progress);
  for (const std::string& defect : model.mesh.defects) {
    const auto hasIt = [&](const Mesh& mesh) { return std::ranges::find(mesh.defects, defect) != mesh.defects.end(); };
    if (std::ranges::none_of(others, hasIt)) {
      spdlog::warn("{}", defect);
    }
  }
  for (size_t i = known; i < textures.size(); ++i) {
    if (!textures[i].shrinkage.empty()) {
      model.mesh.defects.push_back(textures[i].shrinkage);
    }
  }
  return model;
}

void addModelFiles(const std::filesystem::path& model, std::set<std::filesystem::path>& files) {
  formatOrFirst(model).addFiles(model, files);
}

std::string modelFormatNames() {
  std::string names;
  for (const ModelFormat& format : formats) {
    if (names.find(format.name) == std::string::npos) {
      names.append(names.empty() ? "" : " or ").append(format.name);
    }
  }
  return names;
}

std::string modelPatterns() {
  std::string patterns;
  for (const ModelFormat& format : formats) {
    std::string upper(format.extension);
    std::ranges::transform(upper, upper.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    patterns.append(patterns.empty() ? "*" : " *").append(format.extension).append(" *").append(upper);
  }
  return patterns;
}

}  // namespace speculum
