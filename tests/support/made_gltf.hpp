#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

// A glTF file in the making: a document, and the bytes of its buffer 0.
struct MadeGltf {
  nlohmann::json root = {{"asset", {{"version", "2.0"}}}};
  std::string bytes;

  // Appends bytes as a view; returns its index.
  int addView(std::string_view content, int stride = 0) {
    while (bytes.size() % 4 != 0) {
      bytes += '\0';
    }
    nlohmann::json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", content.size()}};
    if (stride > 0) {
      view["byteStride"] = stride;
    }
    bytes += content;
    return add("bufferViews", view);
  }

  // Appends numbers as a view and an accessor; returns the accessor's index.
  template <typename T>
  int addNumbers(const std::vector<T>& numbers, const char* type, bool normalized = false) {
    static const std::map<std::string, size_t> components{
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    return add("accessors", {{"bufferView", addView(bytesOf(numbers))},
                             {"componentType", componentType<T>()},
                             {"count", numbers.size() / components.at(type)},
                             {"type", type},
                             {"normalized", normalized}});
  }

  // Appends a mesh of one primitive; returns its index.
  int addMesh(nlohmann::json attributes, nlohmann::json others = nlohmann::json::object()) {
    others["attributes"] = std::move(attributes);
    return add("meshes", {{"primitives", {others}}});
  }

  // Appends the mesh of a triangle in the plane z = 0.
  int addTriangle() { return addMesh({{"POSITION", addNumbers<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3")}}); }

  int add(const char* key, const nlohmann::json& entry) {
    root[key].push_back(entry);
    return static_cast<int>(root[key].size()) - 1;
  }

  template <typename T>
  static std::string bytesOf(const std::vector<T>& numbers) {
    std::string content(numbers.size() * sizeof(T), '\0');
    std::memcpy(content.data(), numbers.data(), content.size());
    return content;
  }

  template <typename T>
  static constexpr int componentType() {
    if constexpr (std::is_same_v<T, float>) {
      return 5126;
    }
    return std::is_same_v<T, int8_t>     ? 5120
           : std::is_same_v<T, uint8_t>  ? 5121
           : std::is_same_v<T, int16_t>  ? 5122
           : std::is_same_v<T, uint16_t> ? 5123
                                         : 5125;
  }

  static std::string base64(std::string_view content) {
    static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < content.size(); i += 3) {
      uint32_t bits = 0;
      for (size_t k = 0; k < 3; ++k) {
        bits = bits << 8 | (i + k < content.size() ? static_cast<uint8_t>(content[i + k]) : 0u);
      }
      for (size_t k = 0; k < 4; ++k) {
        text += i + k <= content.size() ? digits[bits >> (18 - 6 * k) & 63u] : '=';
      }
    }
    return text;
  }

  // Returns the text of a .gltf file whose buffer 0 has this URI; a data URI if it is empty.
  std::string text(const std::string& uri = "") const {
    nlohmann::json whole = root;
    if (!bytes.empty()) {
      whole["buffers"][0] = {{"byteLength", bytes.size()},
                             {"uri", uri.empty() ? "data:application/octet-stream;base64," + base64(bytes) : uri}};
    }
    return whole.dump();
  }

  // Returns the content of a .glb file.
  std::string binary() const {
    nlohmann::json whole = root;
    if (!bytes.empty()) {
      whole["buffers"][0] = {{"byteLength", bytes.size()}};
    }
    const std::string chunks =
        chunk("JSON", whole.dump(), ' ') + (bytes.empty() ? "" : chunk({"BIN\0", 4}, bytes, '\0'));
    return "glTF" + bytesOf<uint32_t>({2, static_cast<uint32_t>(12 + chunks.size())}) + chunks;
  }

 private:
  static std::string chunk(std::string_view type, std::string content, char padding) {
    content.resize((content.size() + 3) / 4 * 4, padding);
    return bytesOf<uint32_t>({static_cast<uint32_t>(content.size())}).append(type) + content;
  }
};

}  // namespace speculum
