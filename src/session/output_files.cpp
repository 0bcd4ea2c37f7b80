#include "session/output_files.hpp"

#include <spdlog/fmt/fmt.h>

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
  outputs.insert(outputs.end(), {{"--stats", options.render.stats},
                                 {"--json", options.json},
                                 {"--junit", options.regress.junit},
                                 {"--heatmap", options.compare.heatmap},
                                 {"--capture", options.render.capture.value_or("")}});
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
       {NamedFile{"--scene", options.scene}, NamedFile{"--sweep", options.sweep}, NamedFile{"--motion", options.motion},
        NamedFile{"--mask", options.compare.mask}, NamedFile{"--sweep-results", options.sweepResults},
        NamedFile{"reference", options.compare.reference}, NamedFile{"test", options.compare.test},
        NamedFile{"cases", options.regress.cases}}) {
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

std::shared_ptr<const void> claimFolder(const fs::path& out) {
  std::error_code error;
  fs::create_directories(out, error);
  if (!isFolder(out)) {
    throw UsageError("--out: " + out.string() + " cannot be made (a folder for the report)");
  }
  std::shared_ptr<const void> lock = lockFolder(withoutLinks(out));
  if (!lock) {
    throw UsageError("--out: " + out.string() + " is in use (another command writes there: choose another folder)");
  }
  return lock;
}

PictureSequence::PictureSequence(const std::filesystem::path& pattern, int count) {
  if (isFolder(pattern)) {
    throw UsageError("--out: '" + pattern.string() + "' is a folder (name a file that ends with .png or .exr)");
  }
  const std::string extension = pattern.extension().string();
  if (extension != ".png" && extension != ".exr") {
    throw UsageError("--out: '" + pattern.string() + "' has no known ending (.png or .exr)");
  }
  const std::string text = pattern.string();
  before_ = text;
  for (size_t at = count == 0 ? text.npos : text.find('%'); at != text.npos; at = text.find('%', at + 1)) {
    const bool padded = at + 2 < text.size() && text[at + 1] == '0' && text[at + 2] >= '1' && text[at + 2] <= '9';
    const size_t end = at + (padded ? 3 : 1);
    if (end < text.size() && text[end] == 'd') {
      before_ = text.substr(0, at);
      after_ = text.substr(end + 1);
      digits_ = padded ? text[at + 2] - '0' : 1;
      return;
    }
  }
  if (count > 1) {
    throw UsageError("--out: '" + text + "' names one file for " + std::to_string(count) +
                     " pictures (a pattern such as dir/%04d.png)");
  }
}

std::filesystem::path PictureSequence::at(int index) const {
  return digits_ > 0 ? fmt::format("{}{:0{}}{}", before_, index, digits_, after_) : before_;
}

}  // namespace speculum
