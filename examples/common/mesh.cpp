#include "mesh.hpp"

#include "scene/obj_loader.hpp"

namespace speculum::examples {

Mesh::Mesh(Uploader& uploader, const std::filesystem::path& file) {
  std::vector<Texture> textures;  // the examples have none
  const speculum::Mesh model = loadObj(file, textures);
  std::vector<MeshVertex> vertices;
  const ShadedVertices shaded(model);
  shaded.forEach([&](const Vertex& vertex, uint32_t) {
    vertices.push_back({glm::vec3(model.unit * (model.center + vertex.position)), glm::vec3(vertex.normal)});
  });
  indexCount_ = static_cast<uint32_t>(model.indices.size());
  vertices_ = uploader.buffer(vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, file.filename().string());
  indices_ = uploader.buffer(shaded.indices(), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, file.filename().string());
}

void Mesh::draw(VkCommandBuffer commands) const {
  const VkBuffer buffer = vertices_.get();
  const VkDeviceSize offset = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &offset);
  vkCmdBindIndexBuffer(commands, indices_.get(), 0, VK_INDEX_TYPE_UINT32);
  vkCmdDrawIndexed(commands, indexCount_, 1, 0, 0, 0);
}

}  // namespace speculum::examples
