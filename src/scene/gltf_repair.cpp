#include "scene/gltf_file.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "scene/input_error.hpp"

namespace speculum {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

// Returns the elements of an object's array; none if there is no such array.
std::span<json> elementsOf(json& object, const char* key) {
  const auto found = object.find(key);
  auto* array = found == object.end() ? nullptr : found->get_ptr<json::array_t*>();
  return array ? std::span(*array) : std::span<json>();
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
    errors = error.what();
  }
  return errors.substr(0, std::min({errors.find('\n'), errors.size(), mostShown}));
}

// Brings the primitives into a form that the library reads, whatever they say.
void prepareMeshes(json& root) {
  for (json& mesh : elementsOf(root, "meshes")) {
    for (json& primitive : elementsOf(mesh, "primitives")) {
      if (!primitive.is_object()) {
        primitive = json::object();
      }
      json attributes = json::object();
      const json named = primitive.value("attributes", json());
      for (const auto& [name, accessor] : named.items()) {
        attributes[name] = accessor.is_number_integer() ? accessor : json(-1);
      }
      attributes.erase(indicesAttribute);
      if (const auto indices = primitive.find("indices"); indices != primitive.end()) {
        attributes[indicesAttribute] = indices->is_number_integer() ? *indices : json(-1);
        primitive.erase(indices);
      }
      primitive["attributes"] = std::move(attributes);
    }
  }
}

// Replaces objects that the library cannot read by empty ones, of which nothing is drawn.
void leaveOutDamaged(const fs::path& file, json& root, ModelDefects& defects) {
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
        defects.add(file, 1, kind, "{} cannot be read, what uses it is left out", fmt::format("{} ({})", i, fault));
        elements[i] = empty;
      }
    }
  };
  for (const auto& [key, empty] : usual) {
    repair(key, elementsOf(root, key), empty, [&, name = key](const json& one) { return faultOfPart(name, one); });
  }
  const json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
  if (root.contains(lights)) {
    repair("lights", elementsOf(root[lights.parent_pointer()], "lights"), {{"type", noLight}}, [&](const json& one) {
      return faultOfPart("extensions", {{"KHR_lights_punctual", {{"lights", one}}}});
    });
  }
  if (const std::string fault = faultOfPart("extensions", root.value("extensions", json())); !fault.empty()) {
    defects.add(file, 1, "extensions", "cannot be read ({}), lights are left out", fault);
    root.erase("extensions");
  }
}

}  // namespace

tinygltf::Model readRepaired(const fs::path& file, json root, ModelDefects& defects) {
  tinygltf::Model model;
  prepareMeshes(root);
  if (!faultOf(root, model).empty()) {
    leaveOutDamaged(file, root, defects);
    if (const std::string fault = faultOf(root, model); !fault.empty()) {
      throwInputError(file, 1, "json", fault, validGltf);
    }
  }
  return model;
}

}  // namespace speculum
