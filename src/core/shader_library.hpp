#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/device.hpp"
#include "platform/files.hpp"

namespace speculum {

// SPIR-V modules by the name of their GLSL file ("mirror.frag" is read from mirror.frag.spv). With a directory of
// GLSL, its files replace the built ones: compiled at start, and again when they or what they include change.
class ShaderLibrary {
 public:
  // `spirvDir` holds the built modules; `glslDir` empty: no watching.
  ShaderLibrary(Device& device, std::filesystem::path spirvDir, std::filesystem::path glslDir = {});

  // Throws std::runtime_error naming the file when there is no such module or it is not SPIR-V.
  VkShaderModule module(const std::string& name);
  // Returns a number that another content of the module would change. Throws as module() does.
  uint64_t fingerprint(const std::string& name);

  bool watching() const { return !glslDir_.empty(); }
  // Compiles files that are newer than their modules and returns the names whose SPIR-V is new, e.g. "mirror.frag". A
  // file that fails keeps its module. Replaced modules are destroyed at once: pipelines do not need theirs after
  // creation.
  std::vector<std::string> poll();
  const std::string& errors() const { return errors_; }  // messages for the files that fail at present

 private:
  struct Entry {
    ShaderModuleHandle module;
    std::vector<uint8_t> code;
    std::vector<std::filesystem::path> sources;  // GLSL the module was made from, includes too; empty: a built module
    std::filesystem::file_time_type newest;      // of the newest source seen
    std::string error;                           // why its GLSL does not compile at present
  };
  bool compile(const std::string& name, Entry& entry);  // says whether the SPIR-V changed
  void collectErrors();
  void setCode(const std::string& name, Entry& entry, std::vector<uint8_t> code);

  Device& device_;
  std::filesystem::path spirvDir_;
  std::filesystem::path glslDir_;
  std::optional<TemporaryDirectory> output_;
  std::map<std::string, Entry> entries_;
  std::string errors_;
};

}  // namespace speculum
