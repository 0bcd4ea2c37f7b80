
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <span>
#include <utility>

#include "scene/gltf_file.hpp"
#include "scene/input_error.hpp"
#include "scene/mesh_builder.hpp"
#include "scene/value_range.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

glm::dmat4 transformOf(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) {
    return glm::make_mat4(node.matrix.data());
  }
  glm::dmat4 transform(1.0);
  if (node.translation.size() == 3) {
    transform[3] = glm::dvec4(glm::make_vec3(node.translation.data()), 1.0);
  }
  if (node.rotation.size() == 4) {
    const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    transform *= glm::mat4_cast(glm::normalize(rotation));
  }
  if (node.scale.size() == 3) {
    transform = glm::scale(transform, glm::make_vec3(node.scale.data()));
  }
  return transform;
}

// Calls add(a, b, c) with the places of each triangle's corners among `count` vertices.
template <typename Add>
void forEachTriangle(int mode, size_t count, const Add& add) {
  const size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
  for (size_t i = 0; i + 2 < count; i += step) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      add(i + 1, i + 2, 0);
    } else {
      const bool turned = mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1;
      add(i, i + (turned ? 2 : 1), i + (turned ? 1 : 2));
    }
  }
}

// Reads the nodes of the default scene into one mesh in the scene's space.
class GltfReader {
 public:
  GltfReader(const fs::path& file, GltfFile& content, ModelDefects& defects)
      : file_(file), content_(content), defects_(defects), builder_(file, defects, "triangles") {
    // A small file may name the same vertices any number of times.
    constexpr uint64_t cornersOfAny = 1 << 20;
    constexpr uint64_t cornersPerByte = 16;
    constexpr uint64_t most = 1 << 28;
    cornersLeft_ = std::min(cornersOfAny + cornersPerByte * content.byteCount(), most);
  }

  void read(const LoadProgress& progress) {
    constexpr double readShare = 0.65;  // of the time that loading takes; the rest sorts the triangles
    const std::vector<tinygltf::Node>& nodes = content_.model().nodes;
    std::vector<GltfPlaced> open;
    std::vector<GltfPlaced> visible;
    addRoots(open);
    sceneFromNode_.resize(nodes.size());
    while (!open.empty()) {
      const GltfPlaced placed = open.back();
      open.pop_back();
      if (!isIndex(placed.index, nodes.size()) || sceneFromNode_[placed.index]) {
        add("nodes", "node {} is not there, or has two parents, it is left out here", placed.index).costsTriangles =
            true;
        continue;
      }
      const tinygltf::Node& node = nodes[placed.index];
      const glm::dmat4 sceneFromNode = placed.transform * transformOf(node);
      sceneFromNode_[placed.index] = sceneFromNode;
      if (const tinygltf::Value& visible = extensionMember(node.extensions, "KHR_node_visibility", "visible");
          visible.IsBool() && !visible.Get<bool>()) {
        continue;
      }
      if (node.mesh != -1 && node.extensions.contains("EXT_mesh_gpu_instancing")) {
        add("nodes", "node {} has instances by EXT_mesh_gpu_instancing, it is drawn once", placed.index);
      }
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
        open.push_back({*child, sceneFromNode});
      }
      visible.push_back({placed.index, sceneFromNode});
    }
    for (size_t i = 0; i < visible.size(); ++i) {
      addNode(nodes[visible[i].index], visible[i].transform);
      if (progress) {
        progress(file_, readShare * static_cast<double>(i) / static_cast<double>(visible.size()));
      }
    }
  }

  Model finish(GltfMaterials& materials) {
    Model model{.mesh = builder_.finish([&](int index) {
      return materials.material(index, builder_.hasColors(), builder_.hasAlpha(index), builder_.meanColor(index));
    })};
    if (!model.mesh.indices.empty()) {
      addView(file_, content_.model(), camera_, lights_, model, defects_);
    }
    return model;
  }

 private:
  ModelDefects::Kind& add(std::string_view key, std::string_view kind, int index) {
    return defects_.add(file_, 1, key, kind, std::to_string(index));
  }

  // Lists the roots of the default scene, the last first. A file without scenes has those that are no children.
  void addRoots(std::vector<GltfPlaced>& roots) const {
    const tinygltf::Model& model = content_.model();
    if (!model.scenes.empty()) {
      for (const int node : model.scenes[std::max(model.defaultScene, 0)].nodes) {
        roots.push_back({node});
      }
    } else {
      std::vector<bool> isChild(model.nodes.size());
      for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) {
          if (isIndex(child, isChild.size())) {
            isChild[child] = true;
          }
        }
      }
      for (size_t i = 0; i < isChild.size(); ++i) {
        if (!isChild[i]) {
          roots.push_back({static_cast<int>(i)});
        }
      }
    }
    std::ranges::reverse(roots);
  }

  void addNode(const tinygltf::Node& node, const glm::dmat4& sceneFromNode) {
    const tinygltf::Model& model = content_.model();
    if (isIndex(node.mesh, model.meshes.size())) {
      const auto [known, isNew] = skins_.try_emplace(node.skin);
      if (isNew) {
        known->second = jointMatrices(node.skin);
      }
      skin_ = known->second;
      for (const tinygltf::Primitive& primitive : model.meshes[node.mesh].primitives) {
        addPrimitive(primitive, node.mesh, skin_.empty() ? sceneFromNode : skin_[0]);
      }
    } else if (node.mesh != -1) {
      add("nodes", "there is no mesh {}, it is left out", node.mesh).costsTriangles = true;
    }
    if (camera_.index == -1 && isIndex(node.camera, model.cameras.size()) &&
        model.cameras[node.camera].type == "perspective") {
      camera_ = {node.camera, sceneFromNode};
    }
    if (const tinygltf::Value& light = extensionMember(node.extensions, lightsExtension, "light"); light.IsInt()) {
      lights_.push_back({light.GetNumberAsInt(), sceneFromNode});
    }
  }

  void addPrimitive(const tinygltf::Primitive& primitive, int mesh, const glm::dmat4& sceneFromNode) {
    const auto leaveOut = [&](std::string_view kind) { add("meshes", kind, mesh).costsTriangles = true; };
    if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode <= TINYGLTF_MODE_LINE_STRIP) {
      leaveOut("mesh {} has lines or points, they are left out");
      return;
    }
    const auto position = primitive.attributes.find("POSITION");
    if (primitive.mode < 0 || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN || position == primitive.attributes.end()) {
      leaveOut("mesh {} has a primitive of an unknown mode or without POSITION, it is left out");
      return;
    }
    const std::vector<tinygltf::Accessor>& accessors = content_.model().accessors;
    if (primitive.extensions.contains("KHR_draco_mesh_compression") && isIndex(position->second, accessors.size()) &&
        accessors[position->second].bufferView == -1) {
      leaveOut("mesh {} is compressed by KHR_draco_mesh_compression, it is left out");
      return;
    }
    if (!primitive.targets.empty()) {
      add("meshes", "mesh {} has morph targets, they are left out", mesh);
    }
    const uint64_t count = content_.countOf(position->second);
    const auto indexed = primitive.attributes.find(indicesAttribute);
    const bool hasIndices = indexed != primitive.attributes.end();
    const uint64_t corners = hasIndices ? content_.countOf(indexed->second) : count;
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES && corners % 3 != 0) {
      leaveOut("mesh {} has a last triangle of fewer than three vertices, it is left out");
    }
    const uint64_t taken = (primitive.mode == TINYGLTF_MODE_TRIANGLES ? 1 : 3) * corners;
    if (std::max(corners, taken) > cornersLeft_) {
      leaveOut("mesh {} has, as often as it is drawn, too many vertices for a file of this size, it is left out");
      return;
    }
    cornersLeft_ -= taken;
    // Primitives often share their vertices, which are read once for those that follow each other.
    if (positions_ != position->second) {
      positions_ = position->second;
      read_.clear();
    }
    const std::vector<double>* positions = numbers(positions_, 3, true);
    const auto indices = hasIndices ? content_.numbers(indexed->second, 1, true) : std::nullopt;
    if (positions && (indices || !hasIndices)) {
      placeOf_.resize(std::max<size_t>(placeOf_.size(), count), -1);
      std::vector<size_t> named;
      std::vector<int> places(corners, -1);  // among `named`; -1: not there
      for (size_t i = 0; i < corners; ++i) {
        const double vertex = indices ? (*indices)[i] : static_cast<double>(i);
        if (vertex >= 0.0 && vertex < static_cast<double>(count)) {
          places[i] = placeOf_[static_cast<size_t>(vertex)];
          if (places[i] < 0) {
            places[i] = placeOf_[static_cast<size_t>(vertex)] = static_cast<int>(named.size());
            named.push_back(static_cast<size_t>(vertex));
          }
        }
      }
      std::ranges::for_each(named, [&](size_t vertex) { placeOf_[vertex] = -1; });
      const FaceCorner first = addVertices(primitive, *positions, named, sceneFromNode);
      addTriangles(primitive, mesh, first, glm::determinant(glm::dmat3(sceneFromNode)) < 0.0, places);
    }
  }

  // Returns the numbers of an accessor of vertices; null if it is not usable.
  const std::vector<double>* numbers(int accessor, int components, bool ofTriangles = false) {
    const auto [known, isNew] = read_.try_emplace({accessor, components});
    const uint64_t count = content_.countOf(accessor);
    if (isNew && count > cornersLeft_) {
      add("accessors", "{} has, as often as it is read, too many vertices for a file of this size, it is left out",
          accessor)
          .costsTriangles |= ofTriangles;
    } else if (isNew) {
      cornersLeft_ -= count;
      known->second = content_.numbers(accessor, components, ofTriangles);
    }
    return known->second ? &*known->second : nullptr;
  }

  // Returns the transforms to the scene's space of what a skin's joints move, as the file places these; none for no
  // skin.
  std::vector<glm::dmat4> jointMatrices(int index) {
    if (!isIndex(index, content_.skins().size())) {
      if (index != -1) {
        add("nodes", "there is no skin {}, the mesh stands where its node does", index);
      }
      return {};
    }
    const auto& [joints, accessor] = content_.skins()[index];
    const bool given = accessor != -1 && content_.countOf(accessor) >= joints.size();
    const auto inverse = given ? content_.numbers(accessor, 16) : std::nullopt;
    std::vector<glm::dmat4> matrices;
    for (size_t i = 0; i < joints.size(); ++i) {
      const bool placed = isIndex(joints[i], sceneFromNode_.size()) && sceneFromNode_[joints[i]];
      matrices.push_back((placed ? *sceneFromNode_[joints[i]] : glm::dmat4(1.0)) *
                         (inverse ? glm::make_mat4(&(*inverse)[16 * i]) : glm::dmat4(1.0)));
    }
    return matrices;
  }

  // Adds the named vertices of a primitive. Returns the first of them.
  FaceCorner addVertices(const tinygltf::Primitive& primitive, const std::vector<double>& positions,
                         const std::vector<size_t>& named, const glm::dmat4& sceneFromNode) {
    const size_t count = positions.size() / 3;
    FaceCorner first{.position = static_cast<int>(builder_.positionCount())};
    const auto* joints = skin_.empty() ? nullptr : attribute(primitive, "JOINTS_0", 4, count);
    const auto* weights = skin_.empty() ? nullptr : attribute(primitive, "WEIGHTS_0", 4, count);
    // A skin moves each vertex by a mean of matrices, and the node does not.
    const auto matrixOf = [&](size_t i) {
      glm::dmat4 sum(0.0);
      double whole = 0.0;
      for (size_t k = 4 * i; joints && weights && k < 4 * i + 4; ++k) {
        if ((*weights)[k] > 0.0 && (*joints)[k] >= 0.0 && (*joints)[k] < static_cast<double>(skin_.size())) {
          sum += (*weights)[k] * skin_[static_cast<size_t>((*joints)[k])];
          whole += (*weights)[k];
        }
      }
      return whole > 0.0 ? sum / whole : sceneFromNode;
    };
    const int channels = colorChannels(primitive);
    const auto* colors = attribute(primitive, colorName, channels, count);
    for (const size_t i : named) {
      std::optional<glm::vec4> color;
      if (colors) {
        const double* given = &(*colors)[channels * i];
        const double alpha = channels == 4 && std::isfinite(given[3]) ? std::clamp(given[3], 0.0, 1.0) : 1.0;
        const glm::dvec3 rgb = glm::make_vec3(given);
        color = glm::vec4(isFinite(rgb) ? glm::clamp(rgb, 0.0, 1.0) : glm::dvec3(1.0), alpha);
      }
      const glm::dvec3 position = glm::make_vec3(&positions[3 * i]);
      builder_.addPosition(glm::dvec3(matrixOf(i) * glm::dvec4(position, 1.0)), color);
    }
    if (const auto* normals = attribute(primitive, "NORMAL", 3, count)) {
      first.normal = static_cast<int>(builder_.normalCount());
      for (const size_t i : named) {
        // The inverse transpose but for its length, also where there is no inverse.
        const glm::dmat3 m(matrixOf(i));
        const double side = glm::determinant(m) < 0.0 ? -1.0 : 1.0;
        const glm::dmat3 turn(side * glm::cross(m[1], m[2]), side * glm::cross(m[2], m[0]),
                              side * glm::cross(m[0], m[1]));
        builder_.addNormal(turn * glm::make_vec3(&(*normals)[3 * i]));
      }
    }
    if (isIndex(primitive.material, content_.model().materials.size())) {
      addTexcoords(primitive, content_.model().materials[primitive.material].pbrMetallicRoughness.baseColorTexture,
                   count, named, first);
    }
    return first;
  }

  void addTexcoords(const tinygltf::Primitive& primitive, const tinygltf::TextureInfo& texture, size_t count,
                    const std::vector<size_t>& named, FaceCorner& first) {
    const TexturePlacement placement(texture);
    const auto* texcoords = texture.index == -1 ? nullptr : attribute(primitive, placement.texcoords(), 2, count);
    if (!texcoords) {
      if (texture.index != -1) {
        add("textures", "texture {} is on a mesh without its texture coordinates, which count as 0", texture.index);
      }
      return;
    }
    first.texcoord = static_cast<int>(builder_.texcoordCount());
    glm::bvec2 leavesPicture(false);
    for (const size_t i : named) {
      const glm::dvec2 uv = placement.apply(glm::make_vec2(&(*texcoords)[2 * i]));
      leavesPicture = leavesPicture || glm::greaterThan(glm::abs(uv - 0.5), glm::dvec2(0.501));
      builder_.addTexcoord(uv);
    }
    const glm::ivec2 ways = waysToWrap(content_.model(), texture.index);
    const glm::bvec2 repeats = glm::equal(ways, glm::ivec2(TINYGLTF_TEXTURE_WRAP_REPEAT));
    if (ways != clampingWays && glm::any(leavesPicture && glm::not_(repeats))) {
      add("samplers", "texture {} is mirrored, or clamped in one direction, it is drawn repeated", texture.index);
    }
  }

  // Returns the components of each color: 4 with alpha, else 3.
  int colorChannels(const tinygltf::Primitive& primitive) const {
    const std::vector<tinygltf::Accessor>& accessors = content_.model().accessors;
    const auto found = primitive.attributes.find(colorName);
    const bool hasAlpha = found != primitive.attributes.end() && isIndex(found->second, accessors.size()) &&
                          accessors[found->second].type == TINYGLTF_TYPE_VEC4;
    return hasAlpha ? 4 : 3;
  }

  // Returns the numbers of an attribute; null if it is missing or not usable.
  const std::vector<double>* attribute(const tinygltf::Primitive& primitive, const std::string& name, int components,
                                       size_t count) {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) {
      return nullptr;
    }
    if (content_.countOf(found->second) != count) {
      add("accessors", "{} has not as many elements as POSITION, it counts as missing", found->second);
      return nullptr;
    }
    return numbers(found->second, components);
  }

  void addTriangles(const tinygltf::Primitive& primitive, int mesh, const FaceCorner& first, bool mirrored,
                    const std::vector<int>& places) {
    const bool hasMaterial = isIndex(primitive.material, content_.model().materials.size());
    if (!hasMaterial && primitive.material != -1) {
      add("meshes", "there is no material {}, its triangles get the default one", primitive.material);
    }
    builder_.setMaterial(hasMaterial ? primitive.material : -1);
    const auto cornerOf = [&](size_t i) {
      return FaceCorner{.position = first.position + places[i],
                        .texcoord = first.texcoord < 0 ? -1 : first.texcoord + places[i],
                        .normal = first.normal < 0 ? -1 : first.normal + places[i]};
    };
    forEachTriangle(primitive.mode, places.size(), [&](size_t a, size_t b, size_t c) {
      if (std::min({places[a], places[b], places[c]}) < 0) {
        add("meshes", "mesh {} has a triangle with a vertex that is not there, it is left out", mesh).costsTriangles =
            true;
        return;
      }
      const std::array<FaceCorner, 3> face{cornerOf(a), cornerOf(mirrored ? c : b), cornerOf(mirrored ? b : c)};
      // Strips repeat vertices where they turn.
      const bool turns = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP &&
                         (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]);
      if (!turns) {
        builder_.addFace(face, 1);
      }
    });
  }

  static constexpr const char* lightsExtension = "KHR_lights_punctual";
  static constexpr const char* colorName = "COLOR_0";

  const fs::path& file_;
  GltfFile& content_;
  ModelDefects& defects_;
  MeshBuilder builder_;
  uint64_t cornersLeft_ = 0;
  std::vector<std::optional<glm::dmat4>> sceneFromNode_;  // by node; nothing: not in the scene
  std::map<int, std::vector<glm::dmat4>> skins_;          // jointMatrices() by skin
  std::span<const glm::dmat4> skin_;                      // of the present node; empty: it has none
  int positions_ = -1;                                    // accessor of the last primitive's positions
  std::map<std::pair<int, int>, std::optional<std::vector<double>>> read_;  // with it, by accessor and components
  std::vector<int> placeOf_;  // by vertex, among those that a primitive names; -1 between primitives
  GltfPlaced camera_;
  std::vector<GltfPlaced> lights_;
};

}  // namespace

Model loadGltf(const fs::path& file, std::vector<Texture>& textures, const LoadProgress& progress) {
  if (progress) {
    progress(file, 0.0);
  }
  ModelDefects defects;
  GltfFile content(file, defects);
  GltfReader reader(file, content, defects);
  reader.read(progress);
  GltfMaterials materials(file, content, defects, textures);
  Model model = reader.finish(materials);
  Mesh& mesh = model.mesh;
  mesh.materialFiles.assign(content.bufferFiles().begin(), content.bufferFiles().end());
  for (const fs::path& named : content.namedFiles()) {
    mesh.namedFiles.push_back(named.lexically_relative(file.lexically_normal().parent_path()));
  }
  if (content.hasMotion() && !mesh.indices.empty()) {
    defects.add(file, 1, "animations", "animations are left out, the model stands still");
  }
  mesh.defects = defects.report();
  if (mesh.indices.empty()) {
    if (const auto lost = defects.lostTriangles()) {
      throw InputError(*lost + " (no triangle is left to draw)");
    }
    throwInputError(file, 1, "meshes", "the model has no triangle", "at least one triangle with an area is needed");
  }
  return model;
}

}  // namespace speculum
