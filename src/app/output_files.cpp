#include "app/output_files.hpp"

#include <spdlog/fmt/fmt.h>

#include <map>
#include <vector>

#include "app/picture_sequence.hpp"
#include "platform/files.hpp"

namespace speculum {

namespace {

namespace fs = std::filesystem;

struct NamedFile {
  std::string_view option;
  fs::path file;
};

bool isSequence(const Options& options) {
  return options.command == "render" && options.frames > 0;
}

// Returns the files that the command writes, without the pictures of a sequence.
std::vector<NamedFile> outputsOf(const Options& options) {
  std::vector<NamedFile> outputs;
  if (options.command == "accuracy") {
    for (const char* name : {"results.json", "results.csv", "index.html"}) {
      outputs.push_back({"--out", options.out / name});
    }
  } else if (!isSequence(options)) {
    outputs.push_back({"--out", options.out});
  }
  outputs.insert(outputs.end(), {{"--stats", options.stats},
                                 {"--json", options.json},
                                 {"--junit", options.junit},
                                 {"--heatmap", options.heatmap},
                                 {"--capture", options.capture.value_or("")}});
  std::erase_if(outputs, [](const NamedFile& output) { return output.file.empty(); });
  return outputs;
}

// Files in use, each with the option or the part of the scene that names it. Resolves the links of each folder only
// once.
class UsedFiles {
 public:
  void add(std::string_view name, const fs::path& file) {
    if (isFile(file)) {
      used_.emplace(resolved(file), name);
    }
  }
  void addOutputs(const Options& options) {
    for (const auto& [option, file] : outputsOf(options)) {
      if (isReplaced(file)) {
        requireUnused(option, file);
        used_.emplace(resolved(file), option);
      }
    }
    if (isSequence(options)) {
      const PictureSequence pictures(options.out, options.frames);
      for (int i = 0; i < options.frames; ++i) {
        requireUnused("--out", pictures.at(i));
      }
    }
  }

 private:
  // Devices and pipes are not.
  static bool isReplaced(const fs::path& file) {
    std::error_code error;
    return !fs::exists(file, error) || isFile(file);
  }
  void requireUnused(std::string_view option, const fs::path& file) {
    if (const auto other = used_.find(resolved(file)); other != used_.end()) {
      throw UsageError(
          fmt::format("{}: {} is the file of {} too (name another file)", option, file.string(), other->second));
    }
  }
  fs::path resolved(const fs::path& file) {
    std::error_code error;
    if (fs::is_symlink(file, error)) {
      return withoutLinks(file);
    }
    const auto [folder, isNew] = folders_.try_emplace(file.parent_path());
    if (isNew) {
      folder->second = withoutLinks(file.has_parent_path() ? file.parent_path() : fs::path("."));
    }
    return folder->second / file.filename();
  }

  std::map<fs::path, std::string> used_;
  std::map<fs::path, fs::path> folders_;
};

}  // namespace

void requireFilesOfTheirOwn(const Options& options) {
  UsedFiles used;
  for (const auto& [option, file] :
       {NamedFile{"--scene", options.scene}, NamedFile{"--sweep", options.sweep}, NamedFile{"--mask", options.mask},
        NamedFile{"--sweep-results", options.sweepResults}, NamedFile{"reference", options.reference},
        NamedFile{"test", options.test}, NamedFile{"cases", options.cases},
        NamedFile{"--against-binary", options.againstBinary}}) {
    used.add(option, file);
  }
  used.addOutputs(options);
}

void requireFilesOfTheirOwn(const Options& options, const Scene& scene) {
  UsedFiles used;
  used.add("--scene", scene.file);
  for (const Mesh& mesh : scene.meshes) {
    used.add("a model of the scene", mesh.source);
    for (const fs::path& file : mesh.materialFiles) {
      used.add("a material of the scene", file);
    }
  }
  for (const Texture& texture : scene.textures) {
    used.add("a texture of the scene", texture.source);
  }
  used.addOutputs(options);
}

}  // namespace speculum
