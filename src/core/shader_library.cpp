#include "core/shader_library.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <stdexcept>

#include "platform/bytes.hpp"
#include "platform/process.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

constexpr uint32_t spirvMagic = 0x07230203;

bool isSpirv(const std::vector<uint8_t>& code) {
  uint32_t magic = 0;
  if (code.size() < 20 || code.size() % 4 != 0) {
    return false;
  }
  std::memcpy(&magic, code.data(), sizeof magic);
  return magic == spirvMagic;
}

// Returns the sources in a make rule "output: source include include" whose lines are joined by backslashes. Finds
// each by the folder that it begins with, because blanks in the folder's name are not escaped.
std::vector<fs::path> sourcesIn(const fs::path& depfile, const fs::path& folder) {
  const std::string text = readTextIfAny(depfile);
  std::vector<fs::path> sources;
  const std::string prefix = (folder / "").string();
  for (size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at + prefix.size())) {
    sources.emplace_back(text.substr(at, text.find_first_of(" \\\n", at + prefix.size()) - at));
  }
  return sources;
}

bool holdsAnyShader(const fs::path& glslDir, const fs::path& spirvDir) {
  return std::ranges::any_of(fs::directory_iterator(spirvDir), [&](const fs::directory_entry& spirv) {
    return spirv.path().extension() == ".spv" && isFile(glslDir / spirv.path().stem());
  });
}

fs::file_time_type newest(const std::vector<fs::path>& files) {
  fs::file_time_type time = fs::file_time_type::min();
  for (const fs::path& file : files) {
    std::error_code missing;
    time = std::max(time, fs::last_write_time(file, missing));
  }
  return time;
}

}  // namespace

ShaderLibrary::ShaderLibrary(Device& device, fs::path spirvDir, fs::path glslDir)
    : device_(device), spirvDir_(std::move(spirvDir)), glslDir_(std::move(glslDir)) {
  if (watching()) {
    if (!holdsAnyShader(glslDir_, spirvDir_)) {
      throw FileError(glslDir_, "holds no file with the name of a shader", "give --shader-dir a copy of shaders/");
    }
    output_.emplace();
  }
}

VkShaderModule ShaderLibrary::module(const std::string& name) {
  Entry& entry = entries_[name];
  if (entry.module) {
    return entry.module.get();
  }
  if (watching() && isFile(glslDir_ / name)) {
    entry.sources = {glslDir_ / name};
    compile(name, entry);
    collectErrors();
  }
  if (!entry.module) {
    const fs::path file = spirvDir_ / (name + ".spv");
    std::optional<std::vector<uint8_t>> code = readFileIfAny(file);
    if (!code) {
      throw std::runtime_error("shader " + file.string() + " cannot be read (build the target 'shaders')");
    }
    if (!isSpirv(*code)) {
      throw std::runtime_error("shader " + file.string() + " is not SPIR-V (build the target 'shaders' anew)");
    }
    setCode(name, entry, std::move(*code));
  }
  return entry.module.get();
}

uint64_t ShaderLibrary::fingerprint(const std::string& name) {
  module(name);
  return fnv1a(std::as_bytes(std::span(entries_[name].code)));
}

std::vector<std::string> ShaderLibrary::poll() {
  std::vector<std::string> changed;
  if (watching()) {
    for (auto& [name, entry] : entries_) {
      const bool touched = !entry.sources.empty() && newest(entry.sources) > entry.newest;
      if (touched && compile(name, entry)) {
        changed.push_back(name);
      }
    }
    collectErrors();
  }
  return changed;
}

// Compiles with the flags of the build, so that an unchanged file gives unchanged SPIR-V.
bool ShaderLibrary::compile(const std::string& name, Entry& entry) {
  entry.newest = newest(entry.sources);
  const fs::path output = output_->path() / (name + ".spv");
  const fs::path depfile = output.string() + ".d";
  const ProcessResult result =
      runProcess({"glslangValidator", "--quiet", "-V", "--target-env", "vulkan1.1", "-I" + glslDir_.string(),
                  "--depfile", depfile.string(), "-o", output.string(), (glslDir_ / name).string()});
  std::optional<std::vector<uint8_t>> code = readFileIfAny(output);
  if (result.exitCode != 0 || !code || !isSpirv(*code)) {
    entry.error = result.exitCode == 127  ? "glslangValidator was not found (install glslang-tools)"
                  : result.output.empty() ? "glslangValidator failed without a message"
                                          : result.output;
    spdlog::warn("shader {} did not compile:\n{}", name, entry.error);
    return false;
  }
  entry.error.clear();
  // A file that was written to during the compilation stays newer than what was seen, and is compiled again.
  if (std::vector<fs::path> sources = sourcesIn(depfile, glslDir_); !sources.empty() && sources != entry.sources) {
    entry.sources = std::move(sources);
    entry.newest = newest(entry.sources);
  }
  if (*code == entry.code) {
    return false;
  }
  setCode(name, entry, std::move(*code));
  return true;
}

void ShaderLibrary::collectErrors() {
  errors_.clear();
  for (const auto& [name, entry] : entries_) {
    if (!entry.error.empty()) {
      errors_ += name + ": " + entry.error + (entry.error.ends_with('\n') ? "" : "\n");
    }
  }
}

void ShaderLibrary::setCode(const std::string& name, Entry& entry, std::vector<uint8_t> code) {
  std::vector<uint32_t> words(code.size() / sizeof(uint32_t));
  std::memcpy(words.data(), code.data(), code.size());
  entry.module = device_.create(
      vkCreateShaderModule,
      {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = code.size(), .pCode = words.data()}, name);
  entry.code = std::move(code);
}

}  // namespace speculum
