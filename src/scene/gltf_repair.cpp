#include "scene/gltf_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/input_error.hpp"
#include "scene/value_range.hpp"

namespace speculum {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* lightsList = "/extensions/KHR_lights_punctual/lights";

// Returns the elements of an object's array; none if there is no such array.
std::span<json> elementsOf(json& object, const char* key) {
  const auto found = object.find(key);
  auto* array = found == object.end() ? nullptr : found->get_ptr<json::array_t*>();
  return array ? std::span(*array) : std::span<json>();
}

std::span<json> elementsOf(json& root, const json::json_pointer& list) {
  return root.contains(list) ? elementsOf(root[list.parent_pointer()], list.back().c_str()) : std::span<json>();
}

// Reads a model by the library. Returns what it says against it, in one line; nothing if it is read.
std::string faultOf(const json& root, tinygltf::Model& model) {
  constexpr size_t mostShown = 200;
  const std::string text = root.dump();
  std::string errors;
  std::string warnings;
  try {
    model = {};
    if (tinygltf::TinyGLTF().LoadASCIIFromString(&model, &errors, &warnings, text.data(),
                                                 static_cast<unsigned>(text.size()), "")) {
      return {};
    }
  } catch (const json::exception& error) {  // some values of a wrong type
    errors = jsonFault(error);
  }
  return errors.substr(0, std::min({errors.find('\n'), errors.size(), mostShown}));
}

// Numbers of an object: the place of one, or of an array, below the object.
struct Numbers {
  enum class Kind {
    parts,      // each counts for itself
    withAlpha,  // likewise, and the last one is at most 1
    whole,      // a part of them means nothing, and neither do zeros
    index,      // an integer from 0 that fits an int; the library would cut others
    bytes,      // an integer from 0
  };

  const char* list;  // of such objects
  std::string place;
  std::vector<double> usual;  // as many as there must be
  Range range{.low = -INFINITY, .high = INFINITY};
  Kind kind = Kind::parts;
};

// Numbers that are read: those with a range, those whose fault would cost the whole object, and those that the library
// takes for missing without saying so.
std::vector<Numbers> listNumbers() {
  using enum Numbers::Kind;
  constexpr Range any{.low = -INFINITY, .high = INFINITY};
  constexpr const char* surface = "/materials";
  const std::string pbr = "/pbrMetallicRoughness/";
  const std::string extensions = "/extensions/";
  const std::string glossy = extensions + specularGlossiness + "/";
  std::vector<Numbers> numbers{
      {surface, pbr + "baseColorFactor", {1, 1, 1, 1}, surfaceColorRange, withAlpha},
      {surface, pbr + "metallicFactor", {1}, unitRange},
      {surface, pbr + "roughnessFactor", {1}, unitRange},
      {surface, glossy + "diffuseFactor", {1, 1, 1, 1}, surfaceColorRange, withAlpha},
      {surface, glossy + "glossinessFactor", {1}, unitRange},
      {surface, "/emissiveFactor", {0, 0, 0}, radianceRange},
      {surface, extensions + "KHR_materials_emissive_strength/emissiveStrength", {1}, radianceRange},
      {surface, extensions + "KHR_materials_transmission/transmissionFactor", {0}, unitRange},
      {surface, "/alphaCutoff", {0.5}, surfaceColorRange},
      {"/bufferViews", "/buffer", {-1}, any, index},
      {"/bufferViews", "/byteOffset", {0}, any, bytes},
      {"/bufferViews", "/byteStride", {0}, any, bytes},
      {"/accessors", "/byteOffset", {0}, any, bytes},
      {"/accessors", "/bufferView", {-2}, any, index},  // there is none, and -1 would be one of zeros
      {"/textures", "/source", {-1}, any, index},
      {"/textures", "/sampler", {-1}, any, index},
      {"/nodes", "/mesh", {-1}, any, index},
      {"/nodes", "/skin", {-1}, any, index},
      {"/nodes", "/camera", {-1}, any, index},
      {"/nodes", extensions + "KHR_lights_punctual/light", {-1}, any, index},
      {"/nodes", "/translation", {0, 0, 0}},
      {"/nodes", "/rotation", {0, 0, 0, 1}, any, whole},
      {"/nodes", "/scale", {1, 1, 1}},
      {"/nodes", "/matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, any, whole},
      {"/cameras", "/perspective/yfov", {0.8}, {.low = 1e-6, .high = std::numbers::pi}},
      {lightsList, "/color", {1, 1, 1}, radianceRange},
      {lightsList, "/intensity", {1}, radianceRange}};
  for (const std::string part : {"/sparse/indices/", "/sparse/values/"}) {
    numbers.push_back({"/accessors", part + "bufferView", {-1}, any, index});
    numbers.push_back({"/accessors", part + "byteOffset", {0}, any, index});  // the library cuts it to an int
  }
  numbers.push_back({"/accessors", "/sparse/count", {-1}, any, index});
  for (const std::string& texture : {pbr + "baseColorTexture", glossy + "diffuseTexture"}) {
    const std::string transform = texture + "/extensions/KHR_texture_transform/";
    numbers.push_back({surface, transform + "offset", {0, 0}});
    numbers.push_back({surface, transform + "scale", {1, 1}});
    numbers.push_back({surface, transform + "rotation", {0}});
    numbers.push_back({surface, transform + "texCoord", {0}, any, index});
    numbers.push_back({surface, texture + "/texCoord", {0}, any, index});
    numbers.push_back({surface, texture + "/index", {-1}, any, index});
  }
  for (const std::string& texture : {pbr + "metallicRoughnessTexture", std::string("/emissiveTexture"),
                                     extensions + "KHR_materials_transmission/transmissionTexture"}) {
    numbers.push_back({surface, texture + "/index", {-1}, any, index});
  }
  return numbers;
}

// Returns the numbers that count for `value`: the nearest ones in the range, or the usual ones where there are none.
json mended(const json& value, const Numbers& numbers) {
  if (numbers.kind == Numbers::Kind::index || numbers.kind == Numbers::Kind::bytes) {
    const bool isRight = numbers.kind == Numbers::Kind::bytes ? value.is_number_unsigned() : isIndexNumber(value);
    return isRight ? value : json(static_cast<int>(numbers.usual[0]));
  }
  const size_t count = numbers.usual.size();
  std::vector<double> read = numbers.usual;
  bool isRight = count == 1 || value.size() == count;
  bool isZero = true;
  for (size_t i = 0; i < count; ++i) {
    const json number = count == 1 ? value : value.is_array() && i < value.size() ? value[i] : json();
    if (!number.is_number()) {
      isRight = false;
      continue;
    }
    const bool isAlpha = numbers.kind == Numbers::Kind::withAlpha && i + 1 == count;
    const double high = isAlpha ? 1.0 : numbers.range.high;
    read[i] = std::clamp(number.get<double>(), numbers.range.low, high);
    isRight = isRight && read[i] == number.get<double>();
    isZero = isZero && read[i] == 0.0;
  }
  const bool isWhole = numbers.kind == Numbers::Kind::whole;
  if (isRight && !(isWhole && isZero)) {
    return value;
  }
  return count == 1 ? json(read[0]) : json(isWhole ? numbers.usual : read);
}

void mendNumbers(const fs::path& file, json& root, ModelDefects& defects) {
  static const std::vector<Numbers> known = listNumbers();
  for (const Numbers& numbers : known) {
    const json::json_pointer list(numbers.list);
    const json::json_pointer place(numbers.place);
    const std::span<json> elements = elementsOf(root, list);
    for (size_t i = 0; i < elements.size(); ++i) {
      const auto addWrong = [&](const json::json_pointer& wrong) {
        defects
            .add(file, 1, list.back(), "{} is wrong, the nearest or the usual value counts",
                 fmt::format("{} of {}", wrong.to_string().substr(1), i))
            .costsTriangles |= numbers.place == "/mesh";
      };
      for (auto above = place.parent_pointer(); !above.empty(); above = above.parent_pointer()) {
        if (elements[i].contains(above) && !elements[i][above].is_object()) {
          addWrong(above);
          elements[i][above.parent_pointer()].erase(above.back());
        }
      }
      if (!elements[i].contains(place)) {
        continue;
      }
      json& value = elements[i][place];
      if (json right = mended(value, numbers); right != value) {
        addWrong(place);
        value = std::move(right);
      }
    }
  }
}

// Takes what is no index out of lists of nodes, which the library would leave out whole.
void mendLists(const fs::path& file, json& root, ModelDefects& defects) {
  for (const auto& [list, key] : {std::pair("nodes", "children"), std::pair("scenes", "nodes")}) {
    for (json& element : elementsOf(root, list)) {
      if (!element.contains(key)) {
        continue;
      }
      auto* nodes = element[key].get_ptr<json::array_t*>();
      if (nodes && std::erase_if(*nodes, [](const json& node) { return !isIndexNumber(node); }) == 0) {
        continue;
      }
      defects.add(file, 1, list, "have {} that are no indices, these are left out", key).costsTriangles = true;
      if (!nodes) {
        element.erase(key);
      }
    }
  }
}

// Writes what extensions say of a material into its own keys, as far as these can say it: color, metal and roughness.
// Numbers are mended before.
void useMaterialExtensions(const fs::path& file, json& root, ModelDefects& defects) {
  for (json& material : elementsOf(root, "materials")) {
    const json& extensions = member(material, "extensions");
    const json& glossy = member(extensions, specularGlossiness);
    json surface = member(material, "pbrMetallicRoughness");
    if (glossy.is_object() && surface.is_null()) {  // else the file has a description for readers like this one
      if (glossy.contains("specularFactor") || glossy.contains("specularGlossinessTexture")) {
        defects.add(file, 1, "materials", "specular colors and textures of {} are left out", specularGlossiness);
      }
      surface = {{"metallicFactor", 0}, {"roughnessFactor", 1.0 - glossy.value("glossinessFactor", 1.0)}};
      for (const auto& [key, usual] :
           {std::pair("diffuseFactor", "baseColorFactor"), std::pair("diffuseTexture", "baseColorTexture")}) {
        if (glossy.contains(key)) {
          surface[usual] = glossy[key];
        }
      }
    } else if (member(extensions, unlit).is_object() && (surface.is_object() || surface.is_null())) {
      surface["metallicFactor"] = 0;  // draws the color, which is lit
    } else {
      continue;
    }
    material["pbrMetallicRoughness"] = surface;
  }
}

// Mends what is read of a file piece by piece, so that a wrong value does not cost the object.
void mendValues(const fs::path& file, json& root, ModelDefects& defects) {
  for (json& node : elementsOf(root, "nodes")) {
    if (node.contains("matrix") &&
        (node.contains("translation") || node.contains("rotation") || node.contains("scale"))) {
      const json& matrix = node["matrix"];
      const bool usable = matrix.is_array() && matrix.size() == 16 &&
                          std::ranges::all_of(matrix, [](const json& number) { return number.is_number(); });
      defects.add(file, 1, "nodes", "have a matrix and another transform, {} counts",
                  usable ? "the matrix" : "the other");
      if (!usable) {
        node.erase("matrix");
      }
    }
  }
  mendNumbers(file, root, defects);
  mendLists(file, root, defects);
  useMaterialExtensions(file, root, defects);
  for (json& material : elementsOf(root, "materials")) {
    constexpr std::array<std::string_view, 3> modes{"OPAQUE", "MASK", "BLEND"};
    if (material.contains("alphaMode") && std::ranges::find(modes, material["alphaMode"]) == modes.end()) {
      defects.add(file, 1, "materials", "have an alphaMode that is none of OPAQUE, MASK and BLEND, they are opaque");
      material.erase("alphaMode");
    }
  }
  if (root.contains("scene") && !root["scene"].is_null()) {
    const json& scene = root["scene"];
    if (!scene.is_number_unsigned() || scene.get<size_t>() >= elementsOf(root, "scenes").size()) {
      defects.add(file, 1, "scene", "is not there, the usual one is drawn");
      root.erase("scene");
    }
  }
}

// Brings the primitives into a form that the library reads, whatever they say.
void prepareMeshes(const fs::path& file, json& root, ModelDefects& defects) {
  for (json& mesh : elementsOf(root, "meshes")) {
    if (const json& primitives = member(mesh, "primitives"); !primitives.is_null() && !primitives.is_array()) {
      defects.add(file, 1, "meshes", "have primitives that are no list, they are left out").costsTriangles = true;
    }
    for (json& primitive : elementsOf(mesh, "primitives")) {
      if (!primitive.is_object()) {
        primitive = json::object();
      }
      json attributes = json::object();
      const json named = primitive.value("attributes", json());
      for (const auto& [name, accessor] : named.items()) {
        attributes[name] = isIndexNumber(accessor) ? accessor : json(-1);
      }
      attributes.erase(indicesAttribute);
      if (const auto indices = primitive.find("indices"); indices != primitive.end()) {
        attributes[indicesAttribute] = isIndexNumber(*indices) ? *indices : json(-1);
        primitive.erase(indices);
      }
      primitive["attributes"] = std::move(attributes);
      for (const char* key : {"material", "mode"}) {
        if (primitive.contains(key) && !isIndexNumber(primitive[key]) && primitive[key] != -1) {
          defects.add(file, 1, "meshes", "have a {} that is no integer from 0, the usual one counts", key);
          primitive.erase(key);
        }
      }
    }
  }
}

// Replaces objects that the library cannot read by empty ones, of which nothing is drawn.
void leaveOutDamaged(const fs::path& file, json& root, ModelDefects& defects) {
  constexpr std::array<std::string_view, 5> ofTriangles{"bufferViews", "accessors", "meshes", "nodes", "scenes"};
  const std::array<std::pair<const char*, json>, 9> usual{
      {{"bufferViews", {{"buffer", -1}, {"byteLength", 1}}},
       {"accessors", {{"componentType", TINYGLTF_COMPONENT_TYPE_FLOAT}, {"count", 1}, {"type", "MAT4"}}},
       {"cameras", {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 1}, {"zfar", 2}}}}},
       {"meshes", json::object()},
       {"nodes", json::object()},
       {"scenes", json::object()},
       {"materials", json::object()},
       {"textures", json::object()},
       {"samplers", json::object()}}};
  tinygltf::Model read;
  const auto faultOfPart = [&](const char* key, const json& part) {
    return faultOf(json::object({{"asset", root["asset"]}, {key, part}}), read);
  };
  // Reads each element as the only one of its kind.
  const auto repair = [&](const char* kind, std::span<json> elements, const json& empty, const auto& faultOfOne) {
    for (size_t i = 0; i < elements.size(); ++i) {
      if (const std::string fault = faultOfOne(json::array({elements[i]})); !fault.empty()) {
        defects.add(file, 1, kind, "{} cannot be read, what uses it is left out", fmt::format("{} ({})", i, fault))
            .costsTriangles |= std::ranges::find(ofTriangles, kind) != ofTriangles.end();
        elements[i] = empty;
      }
    }
  };
  for (const auto& [key, empty] : usual) {
    repair(key, elementsOf(root, key), empty, [&, name = key](const json& one) { return faultOfPart(name, one); });
  }
  repair("lights", elementsOf(root, json::json_pointer(lightsList)), {{"type", noLight}}, [&](const json& one) {
    return faultOfPart("extensions", {{"KHR_lights_punctual", {{"lights", one}}}});
  });
  if (const std::string fault = faultOfPart("extensions", root.value("extensions", json())); !fault.empty()) {
    defects.add(file, 1, "extensions", "cannot be read ({}), lights are left out", fault);
    root.erase("extensions");
  }
}

}  // namespace

tinygltf::Model readRepaired(const fs::path& file, json root, ModelDefects& defects) {
  tinygltf::Model model;
  prepareMeshes(file, root, defects);
  mendValues(file, root, defects);
  if (!faultOf(root, model).empty()) {
    leaveOutDamaged(file, root, defects);
    if (const std::string fault = faultOf(root, model); !fault.empty()) {
      throwInputError(file, 1, "json", fault, validGltf);
    }
  }
  return model;
}

}  // namespace speculum
