#include "systems/gpu_data.hpp"

#include <algorithm>
#include <stdexcept>

#include "geometry/affine.hpp"

namespace speculum {

glm::vec4 row(const glm::dmat3& m, int r, double w) {
  return glm::vec4(glm::dvec4(m[0][r], m[1][r], m[2][r], w));
}

glm::vec4 replacement(const std::optional<glm::dvec3>& value) {
  return value ? glm::vec4(glm::vec3(*value), 1.0f) : glm::vec4(0.0f);
}

glm::dmat3 unitNormalMatrix(const glm::dmat3& linear) {
  const glm::dmat3 normals = normalMatrix(linear);
  const double size = std::max({glm::length(normals[0]), glm::length(normals[1]), glm::length(normals[2])});
  return size > 0.0 ? normals * (1.0 / size) : normals;
}

void writeGrown(Device& device, Buffer& buffer, std::span<const std::byte> data, const std::string& name,
                const std::string& advice) {
  const uint64_t limit = device.limits().maxStorageBufferRange;
  if (data.size() > limit) {
    throw std::runtime_error("a frame has " + std::to_string(data.size() >> 20) + " MiB of " + name +
                             ", the device takes " + std::to_string(limit >> 20) + " (" + advice + ")");
  }
  if (!buffer || buffer.bytes() < data.size()) {
    buffer = Buffer(device, data.size() + data.size() / 2,
                    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, BufferPlace::host, name);
  }
  buffer.write(data);
}

}  // namespace speculum
