#include "app/output_files.hpp"

#include <spdlog/fmt/fmt.h>

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

void addOutputs(UsedFiles& used, const Options& options) {
  for (const auto& [option, file] : outputsOf(options)) {
    used.requireUnused(option, file);
    used.add(fmt::format("the file of {}", option), file);
  }
  if (isSequence(options)) {
    const PictureSequence pictures(options.out, options.frames);
    for (int i = 0; i < options.frames; ++i) {
      used.requireUnused("--out", pictures.at(i));
    }
  }
}

}  // namespace

void UsedFiles::add(std::string_view words, const fs::path& file) {
  if (!file.empty() && isReplaced(file)) {
    used_.emplace(resolved(file), words);
  }
}

void UsedFiles::requireUnused(std::string_view option, const fs::path& file) {
  if (const auto other = used_.find(resolved(file)); other != used_.end()) {
    throw UsageError(fmt::format("{}: {} is {} too (choose another place)", option, file.string(), other->second));
  }
}

bool UsedFiles::isReplaced(const fs::path& file) {
  std::error_code error;
  return !fs::exists(file, error) || isFile(file);
}

fs::path UsedFiles::resolved(const fs::path& file) {
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

void requireFilesOfTheirOwn(const Options& options) {
  UsedFiles used;
  for (const auto& [option, file] :
       {NamedFile{"--scene", options.scene}, NamedFile{"--sweep", options.sweep}, NamedFile{"--mask", options.mask},
        NamedFile{"--sweep-results", options.sweepResults}, NamedFile{"reference", options.reference},
        NamedFile{"test", options.test}, NamedFile{"cases", options.cases}}) {
    if (isFile(file)) {  // names of shipped scenes and sweeps are no files
      used.add(fmt::format("the file of {}", option), file);
    }
  }
  addOutputs(used, options);
}

void requireFilesOfTheirOwn(const Options& options, const Scene& scene) {
  UsedFiles used;
  used.add("the file of --scene", scene.file);
  for (const Mesh& mesh : scene.meshes) {
    used.add("a model of the scene", mesh.source);
    for (const fs::path& file : mesh.materialFiles) {
      used.add("a material of the scene", file);
    }
  }
  for (const Texture& texture : scene.textures) {
    used.add("a texture of the scene", texture.source);
  }
  addOutputs(used, options);
}

}  // namespace speculum
