#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "core/pipeline.hpp"
#include "core/uploader.hpp"

namespace speculum::examples {

struct MeshVertex {
  glm::vec3 position;
  glm::vec3 normal;
};

// The triangles of an OBJ file on the GPU, counter-clockwise seen from outside.
class Mesh {
 public:
  Mesh(Uploader& uploader, const std::filesystem::path& file);

  // The vertex shader's inputs: location 0 is the position, 1 the normal.
  static std::vector<VkVertexInputBindingDescription> bindings() {
    return {{0, sizeof(MeshVertex), VK_VERTEX_INPUT_RATE_VERTEX}};
  }
  static std::vector<VkVertexInputAttributeDescription> attributes() {
    return {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(MeshVertex, position)},
            {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(MeshVertex, normal)}};
  }
  void draw(VkCommandBuffer commands) const;

 private:
  uint32_t indexCount_ = 0;
  Buffer vertices_;
  Buffer indices_;
};

}  // namespace speculum::examples
