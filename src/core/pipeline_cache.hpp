#pragma once

#include <filesystem>

#include "core/device.hpp"

namespace speculum {

// The driver's compiled pipelines on disk, one file per GPU and driver. Damaged and foreign files are ignored.
class PipelineCache {
 public:
  // `directory` empty: nothing is read or written.
  PipelineCache(Device& device, const std::filesystem::path& directory);
  ~PipelineCache();  // saves
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  VkPipelineCache get() const { return cache_.get(); }
  const std::filesystem::path& file() const { return file_; }
  bool loaded() const { return loaded_; }  // whether a file was found and taken
  bool save() const;                       // true if written, or nothing was to be written

 private:
  Device& device_;
  std::filesystem::path file_;
  bool loaded_ = false;
  PipelineCacheHandle cache_;
};

}  // namespace speculum
