#include "app/output_files.hpp"

#include <spdlog/fmt/fmt.h>

#include <array>
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

std::vector<NamedFile> outputsOf(const Options& options) {
  std::vector<NamedFile> outputs;
  if (options.command == "accuracy") {
    for (const char* name : {"results.json", "results.csv", "index.html"}) {
      outputs.push_back({"--out", options.out / name});
    }
  } else if (options.command == "render" && options.frames > 0) {
    const PictureSequence pictures(options.out, options.frames);
    for (int i = 0; i < options.frames; ++i) {
      outputs.push_back({"--out", pictures.at(i)});
    }
  } else {
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

// Files by what names them. Follows the links of each folder once.
class UsedFiles {
 public:
  void add(std::string_view name, const fs::path& file) {
    if (isFile(file)) {
      used_.emplace(placeOf(file), name);
    }
  }
  void addOutput(const NamedFile& output) {
    std::error_code error;
    if (fs::exists(output.file, error) && !isFile(output.file)) {
      return;
    }
    if (const auto [other, isNew] = used_.emplace(placeOf(output.file), output.option); !isNew) {
      throw UsageError(fmt::format("{}: {} is the file of {} too (name another file)", output.option,
                                   output.file.string(), other->second));
    }
  }

 private:
  fs::path placeOf(const fs::path& file) {
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
  for (const NamedFile& output : outputsOf(options)) {
    used.addOutput(output);
  }
}

void requireFilesOfTheirOwn(const Options& options, const Scene& scene) {
  UsedFiles used;
  for (const Mesh& mesh : scene.meshes) {
    used.add("a model of the scene", mesh.source);
    for (const fs::path& file : mesh.materialFiles) {
      used.add("a material of the scene", file);
    }
  }
  for (const Texture& texture : scene.textures) {
    used.add("a texture of the scene", texture.source);
  }
  for (const NamedFile& output : outputsOf(options)) {
    used.addOutput(output);
  }
}

}  // namespace speculum
