#include "core/pipeline_cache.hpp"

#include <spdlog/spdlog.h>

#include <cstring>
#include <optional>
#include <span>

#include "platform/bytes.hpp"
#include "platform/files.hpp"

namespace speculum {

namespace {

// Precedes the driver's data in the file. Drivers check their own header only, and some trust what follows it.
struct FileHeader {
  char magic[8] = {'S', 'P', 'E', 'C', 'P', 'C', '0', '1'};
  uint64_t bytes = 0;
  uint64_t hash = 0;
};

std::string fileName(const VkPhysicalDeviceProperties& properties) {
  std::string name = "pipelines_";
  for (const uint8_t byte : properties.pipelineCacheUUID) {
    constexpr const char* digits = "0123456789abcdef";
    name += {digits[byte >> 4], digits[byte & 15]};
  }
  return name + "_" + std::to_string(properties.driverVersion) + ".bin";
}

bool madeBy(const VkPhysicalDeviceProperties& properties, std::span<const uint8_t> data) {
  VkPipelineCacheHeaderVersionOne header{};
  if (data.size() < sizeof header) {
    return false;
  }
  std::memcpy(&header, data.data(), sizeof header);
  return header.headerSize == sizeof header && header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
         header.vendorID == properties.vendorID && header.deviceID == properties.deviceID &&
         std::memcmp(header.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE) == 0;
}

// Returns the driver's part of a whole and undamaged file of this GPU; empty otherwise.
std::span<const uint8_t> payload(const VkPhysicalDeviceProperties& properties, std::span<const uint8_t> file) {
  FileHeader header;
  const FileHeader expected;
  if (file.size() < sizeof header) {
    return {};
  }
  std::memcpy(&header, file.data(), sizeof header);
  const std::span<const uint8_t> data = file.subspan(sizeof header);
  const bool whole = std::memcmp(header.magic, expected.magic, sizeof header.magic) == 0 &&
                     header.bytes == data.size() && header.hash == fnv1a(std::as_bytes(data));
  return whole && madeBy(properties, data) ? data : std::span<const uint8_t>{};
}

}  // namespace

PipelineCache::PipelineCache(Device& device, const std::filesystem::path& directory) : device_(device) {
  std::vector<uint8_t> content;
  std::span<const uint8_t> data;
  if (!directory.empty()) {
    file_ = directory / fileName(device.properties());
    if (std::optional<std::vector<uint8_t>> found = readFileIfAny(file_)) {
      content = std::move(*found);
      data = payload(device.properties(), content);
      loaded_ = !data.empty();
      if (!loaded_) {
        spdlog::info("pipeline cache {} is damaged or of another GPU and is not used", file_.string());
      }
    }
  }
  cache_ = device.create(vkCreatePipelineCache,
                         {.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                          .initialDataSize = data.size(),
                          .pInitialData = data.data()},
                         "pipeline cache");
}

PipelineCache::~PipelineCache() {
  if (!save()) {
    spdlog::warn("pipeline cache {} could not be written", file_.string());
  }
}

bool PipelineCache::save() const {
  if (file_.empty()) {
    return true;
  }
  size_t bytes = 0;
  if (vkGetPipelineCacheData(device_.get(), cache_.get(), &bytes, nullptr) != VK_SUCCESS) {
    return false;
  }
  FileHeader header;
  std::vector<uint8_t> content(sizeof header + bytes);
  if (vkGetPipelineCacheData(device_.get(), cache_.get(), &bytes, content.data() + sizeof header) != VK_SUCCESS) {
    return false;
  }
  content.resize(sizeof header + bytes);
  header.bytes = bytes;
  header.hash = fnv1a(std::as_bytes(std::span(content).subspan(sizeof header)));
  std::memcpy(content.data(), &header, sizeof header);
  return storeFile(file_, content);
}

}  // namespace speculum
