#include "scene/gltf_file.hpp"

#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "platform/bytes.hpp"
#include "platform/files.hpp"
#include "platform/text.hpp"
#include "scene/input_error.hpp"
#include "scene/text_lines.hpp"

namespace speculum {

namespace fs = std::filesystem;
using nlohmann::json;

const json& member(const json& object, const char* key) {
  static const json none;
  const auto found = object.find(key);
  return found == object.end() ? none : *found;
}

std::string jsonFault(const std::exception& error) {
  constexpr size_t mostShown = 200;
  const std::string text = error.what();
  return text.substr(text.find("] ") + 2, mostShown);
}

namespace {

// The two parts of a file; a text file has no binary part.
struct Parts {
  std::string_view json;
  std::string_view binary;
  bool isWhole = true;  // the file has the length that it says, and so have its parts
};

Parts partsOf(const fs::path& file, std::string_view text) {
  constexpr size_t header = 12;
  constexpr size_t chunkHeader = 8;
  constexpr uint32_t jsonChunk = 0x4E4F534A;
  constexpr uint32_t binaryChunk = 0x004E4942;
  if (!text.starts_with("glTF")) {
    return {text, {}};
  }
  if (text.size() < header + chunkHeader) {
    throwInputError(file, 1, "file", "ends within its header", validGltf);
  }
  if (const uint32_t version = littleEndian(text.substr(4)); version != 2) {
    throwInputError(file, 1, "version", fmt::format("is {}", version), validGltf);
  }
  Parts parts{.isWhole = littleEndian(text.substr(8)) == text.size()};
  for (size_t at = header; text.size() - at >= chunkHeader;) {
    const size_t named = littleEndian(text.substr(at));
    const size_t size = std::min(named, text.size() - at - chunkHeader);
    parts.isWhole = parts.isWhole && size == named;
    const uint32_t type = littleEndian(text.substr(at + 4));
    if (type == jsonChunk && parts.json.empty()) {
      parts.json = text.substr(at + chunkHeader, size);
    } else if (type == binaryChunk && parts.binary.empty()) {
      parts.binary = text.substr(at + chunkHeader, size);
    }
    at += chunkHeader + size;
  }
  return parts;
}

// Returns how many objects and arrays of JSON lie in one another.
int levelsOf(std::string_view text) {
  int level = 0;
  int most = 0;
  bool inText = false;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      inText = !inText;
    } else if (inText) {
      i += text[i] == '\\' ? 1 : 0;
    } else if (text[i] == '{' || text[i] == '[') {
      most = std::max(most, ++level);
    } else if (text[i] == '}' || text[i] == ']') {
      --level;
    }
  }
  return most;
}

// Turns whole numbers that are written as floats, such as 4.0, into integers. Where floats stand, both mean the same.
// Numbers beyond an int stay as they are: tinygltf would cut off those of extensions.
void makeIntegers(json& value) {
  constexpr double most = std::numeric_limits<int>::max();
  if (value.is_structured()) {
    std::ranges::for_each(value, makeIntegers);
  } else if (value.is_number_float()) {
    const double number = value.get<double>();
    if (!std::signbit(number) && number <= most && number == std::floor(number)) {
      value = static_cast<uint64_t>(number);
    }
  }
}

// Text that is not UTF-8 counts as Latin-1, with a defect if `defects` is given.
json parsedJson(const fs::path& file, std::string_view text, ModelDefects* defects) {
  // tinygltf and the writer of JSON call themselves for each level. A callback of the parser could count them, but with
  // one it takes a time as the square of an array's length.
  constexpr int mostLevels = 64;
  if (const auto foreign = foreignFile(text, ".gltf")) {
    throwInputError(file, 1, "file", foreign->wrong, foreign->right);
  }
  if (levelsOf(text) > mostLevels) {
    throwInputError(file, 1, "json", "has more than 64 levels", validGltf);
  }
  try {
    json parsed = json::parse(text.begin(), text.end());
    makeIntegers(parsed);
    return parsed;
  } catch (const json::parse_error& error) {
    if (const std::string whole = utf8(text); whole != text && trimmed(text).starts_with("{")) {
      if (defects != nullptr) {
        defects->add(file, 1, "json", "has bytes that are not UTF-8, they count as Latin-1");
      }
      return parsedJson(file, whole, nullptr);
    }
    const auto line = std::count(text.begin(), text.begin() + std::min(error.byte, text.size()), '\n');
    throwInputError(file, static_cast<int>(line) + 1, "json", jsonFault(error), validGltf);
  } catch (const json::exception& error) {  // such as a number that is out of range
    throwInputError(file, 1, "json", jsonFault(error), validGltf);
  }
}

void checkVersion(const fs::path& file, const json& root, ModelDefects& defects) {
  const json& version = member(member(root, "asset"), "version");
  if (!version.is_string()) {
    throwInputError(file, 1, "asset.version", "is missing or not a text", validGltf);
  }
  if (const auto& text = version.get_ref<const std::string&>(); !text.starts_with("2.")) {
    throwInputError(file, 1, "asset.version", "is '" + text.substr(0, 20) + "'", validGltf);
  }
  if (const json& least = member(member(root, "asset"), "minVersion"); !least.is_null() && least != "2.0") {
    defects.add(file, 1, "asset.minVersion", "is not 2.0, the file is read as one of 2.0 nevertheless");
  }
}

// Refuses a file that requires an extension that is not read, except those of materials and of formats of textures:
// without these the model can still be drawn.
void checkExtensions(const fs::path& file, const json& root, ModelDefects& defects) {
  constexpr std::array<std::string_view, 4> known{"KHR_texture_transform", "KHR_mesh_quantization",
                                                  "KHR_lights_punctual", "KHR_node_visibility"};
  constexpr std::array<std::string_view, 4> textures{"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif",
                                                     "MSFT_texture_dds"};
  std::vector<std::string> unknown;
  for (const json& name : member(root, "extensionsRequired")) {
    // Materials say themselves which extension of theirs is not read.
    if (!name.is_string() || std::ranges::find(known, name.get_ref<const std::string&>()) != known.end() ||
        name.get_ref<const std::string&>().starts_with("KHR_materials_")) {
      continue;
    }
    if (const auto& text = name.get_ref<const std::string&>(); std::ranges::find(textures, text) != textures.end()) {
      defects.add(file, 1, "extensionsRequired", "{} cannot be read, the model is drawn without it", text);
    } else {
      unknown.push_back(text);
    }
  }
  if (!unknown.empty()) {
    throwInputError(file, 1, "extensionsRequired", fmt::format("{} cannot be read", fmt::join(unknown, ", ")),
                    "export the model without them");
  }
}

std::string percentDecoded(std::string_view text) {
  std::string decoded;
  for (size_t i = 0; i < text.size(); ++i) {
    unsigned char byte = 0;
    const char* digits = text.data() + i + 1;
    if (text[i] == '%' && text.size() - i > 2 && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      decoded += static_cast<char>(byte);
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

bool isDataUri(std::string_view uri) {
  return lowerCase(std::string(uri.substr(0, 5))) == "data:";
}

std::vector<uint8_t> dataOf(const std::string& uri) {
  const size_t comma = std::min(uri.find(','), uri.size() - 1);
  std::vector<uint8_t> data;
  std::string text = percentDecoded(std::string_view(uri).substr(comma + 1));
  if (lowerCase(uri.substr(0, comma)).ends_with(";base64")) {
    std::erase_if(text, [](char c) { return std::string_view(" \t\r\n").find(c) != std::string_view::npos; });
    std::ranges::replace(text, '-', '+');  // the alphabet for URLs
    std::ranges::replace(text, '_', '/');
    std::string type;
    tinygltf::DecodeDataURI(&data, type, "data:application/octet-stream;base64," + text, 0, false);
  } else {
    data.assign(text.begin(), text.end());
  }
  return data;
}

// Finds the file of a URI below the folder of the model. A path that leads out of it counts for its file name alone. If
// there is no such file, a query or fragment behind the name does not count.
std::optional<fs::path> findFile(ModelFiles& search, const fs::path& model, const std::string& uri) {
  std::string name = percentDecoded(uri);
  std::ranges::replace(name, '\\', '/');
  const size_t first = std::min(name.find_first_not_of(" \t\n\v\f\r\"'"), name.size());  // the search may drop these
  const fs::path path = fs::path(name.substr(first)).lexically_normal();
  const bool leadsOut = path.is_absolute() || (!path.empty() && *path.begin() == "..");
  const std::optional<fs::path> found = search.find(model, leadsOut ? path.filename().string() : name);
  const size_t query = uri.find_first_of("?#");
  return found || query == std::string::npos ? found : findFile(search, model, uri.substr(0, query));
}

template <typename T>
double numberAt(const uint8_t* bytes, bool normalized) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  const double number = value;
  return normalized && std::is_integral_v<T>
             ? std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0)
             : number;
}

double numberAt(const uint8_t* bytes, int componentType, bool normalized) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return numberAt<int8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return numberAt<uint8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return numberAt<int16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return numberAt<uint16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_INT:
      return numberAt<int32_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return numberAt<uint32_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return numberAt<float>(bytes, normalized);
    default:
      return numberAt<double>(bytes, normalized);
  }
}

}  // namespace

const tinygltf::Value& extensionMember(const tinygltf::ExtensionMap& extensions, const char* name, const char* key) {
  static const tinygltf::Value none;
  const auto found = extensions.find(name);
  return found == extensions.end() || !found->second.IsObject() ? none : found->second.Get(key);
}

bool isIndexNumber(const json& value) {
  return value.is_number_unsigned() && value.get<uint64_t>() <= uint64_t{std::numeric_limits<int>::max()};
}

double numberOf(const tinygltf::Value& value, double usual) {
  return value.IsNumber() ? value.GetNumberAsDouble() : usual;
}

GltfFile::GltfFile(const fs::path& file, ModelDefects& defects) : file_(file), defects_(defects), modelFiles_(file) {
  text_ = readInputText(file, "a glTF 2.0 file is needed");
  byteCount_ = text_.size();
  const Parts parts = partsOf(file, text_);
  std::vector<Source> buffers;
  readJson(parts.json, buffers);
  if (!parts.isWhole) {
    defects_.add(file_, 1, "file", "is not as long as it says, what is there is read");
  }
  readBuffers(buffers, parts.binary);
}

void GltfFile::readJson(std::string_view text, std::vector<Source>& buffers) {
  json root = parsedJson(file_, text, &defects_);
  checkVersion(file_, root, defects_);
  checkExtensions(file_, root, defects_);
  hasMotion_ = !member(root, "animations").empty();
  const auto index = [](const json& value) { return isIndexNumber(value) ? value.get<int>() : -1; };
  for (const json& entry : member(root, "skins")) {
    Skin& skin = skins_.emplace_back(Skin{.inverseBindMatrices = index(member(entry, "inverseBindMatrices"))});
    for (const json& joint : member(entry, "joints")) {
      skin.joints.push_back(index(joint));
    }
  }
  for (const auto& [key, sources] : {std::pair("buffers", &buffers), std::pair("images", &images_)}) {
    for (const json& entry : member(root, key)) {
      const json& uri = member(entry, "uri");
      sources->push_back({uri.is_string() ? uri.get<std::string>() : "", index(member(entry, "bufferView"))});
    }
  }
  for (const char* key : {"animations", "skins", "buffers", "images"}) {
    root.erase(key);
  }
  model_ = readRepaired(file_, std::move(root), defects_);
}

void GltfFile::readBuffers(const std::vector<Source>& sources, std::string_view binary) {
  constexpr uint64_t mostBytes = 1u << 30;
  std::map<fs::path, std::span<const uint8_t>> files;
  uint64_t bytes = 0;
  const auto add = [&](std::vector<uint8_t> data) {
    bytes += data.size();
    buffers_.push_back(storage_.emplace_back(std::move(data)));
  };
  for (const Source& source : sources) {
    if (isDataUri(source.uri)) {
      add(dataOf(source.uri));
      continue;
    }
    if (source.uri.empty() && buffers_.empty()) {
      buffers_.emplace_back(reinterpret_cast<const uint8_t*>(binary.data()), binary.size());
      continue;
    }
    const auto leaveOut = [&](std::string_view kind, const std::string& detail) {
      defects_.add(file_, 1, "buffers", kind, detail).costsTriangles = true;
      buffers_.emplace_back();
    };
    if (source.uri.empty()) {
      leaveOut("{} has no data, as with EXT_meshopt_compression, what uses it is left out",
               std::to_string(buffers_.size()));
      continue;
    }
    const std::optional<fs::path> found = find(source.uri);
    if (!found) {
      leaveOut("there is no file '{}', what uses it is left out", source.uri);
      continue;
    }
    const auto [known, isNew] = files.try_emplace(withoutLinks(*found));
    try {
      if (isNew) {
        bufferFiles_.insert(known->first);
        add(readFile(*found, mostBytes - bytes));
        known->second = buffers_.back();
      } else {
        buffers_.push_back(known->second);
      }
    } catch (const FileError& error) {
      leaveOut("{}, what uses it is left out", error.what());
    }
  }
  byteCount_ += bytes;
}

std::optional<fs::path> GltfFile::find(const std::string& uri) {
  const std::optional<fs::path> found = findFile(modelFiles_, file_, uri);
  if (found) {
    namedFiles_.insert(*found);
  }
  return found;
}

std::optional<std::span<const uint8_t>> GltfFile::viewBytes(int view) const {
  if (!isIndex(view, model_.bufferViews.size()) || !isIndex(model_.bufferViews[view].buffer, buffers_.size())) {
    return std::nullopt;
  }
  const uint64_t offset = model_.bufferViews[view].byteOffset;
  const uint64_t length = model_.bufferViews[view].byteLength;
  const std::span<const uint8_t> buffer = buffers_[model_.bufferViews[view].buffer];
  if (offset > buffer.size() || length > buffer.size() - offset) {
    return std::nullopt;
  }
  return buffer.subspan(offset, length);
}

template <typename Store>
bool GltfFile::readElements(int view, uint64_t offset, const ElementType& type, uint64_t count,
                            const Store& store) const {
  const std::optional<std::span<const uint8_t>> bytes = viewBytes(view);
  const int size = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(type.componentType));
  if (!bytes || size <= 0) {
    return false;
  }
  const auto elementSize = static_cast<uint64_t>(size) * type.components;
  const uint64_t stride = model_.bufferViews[view].byteStride > 0 ? model_.bufferViews[view].byteStride : elementSize;
  if (offset > bytes->size() || elementSize > bytes->size() - offset ||
      count > 1 + (bytes->size() - offset - elementSize) / stride) {
    return false;
  }
  for (uint64_t element = 0; element < count; ++element) {
    const uint8_t* first = bytes->data() + offset + element * stride;
    for (int i = 0; i < type.components; ++i) {
      store(element * type.components + i, numberAt(first + i * size, type.componentType, type.normalized));
    }
  }
  return true;
}

uint64_t GltfFile::countOf(int accessor) const {
  return isIndex(accessor, model_.accessors.size()) ? model_.accessors[accessor].count : 0;
}

std::optional<std::vector<double>> GltfFile::numbers(int index, int components, bool ofTriangles) {
  if (isIndex(index, model_.accessors.size())) {
    const tinygltf::Accessor& accessor = model_.accessors[index];
    const ElementType type{accessor.componentType, components, accessor.normalized};
    // With a view, each element has a byte of its own. Without, a small file may ask for any number of zeros.
    const bool bounded = accessor.count <= (accessor.bufferView == -1 ? (1u << 16) + byteCount() / 12 : byteCount());
    if (bounded && tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)) == components) {
      std::vector<double> values(accessor.count * components);
      // Without a view, the numbers are zero.
      const bool whole =
          accessor.bufferView == -1 || readElements(accessor.bufferView, accessor.byteOffset, type, accessor.count,
                                                    [&](uint64_t i, double number) { values[i] = number; });
      if (whole && (!accessor.sparse.isSparse || readSparse(accessor, type, values))) {
        return values;
      }
    }
  }
  defects_
      .add(file_, 1, "accessors", "{} does not hold what is needed of it, what uses it is left out",
           std::to_string(index))
      .costsTriangles |= ofTriangles;
  return std::nullopt;
}

// Puts the numbers of a sparse accessor into the places that its indices name.
bool GltfFile::readSparse(const tinygltf::Accessor& accessor, const ElementType& type,
                          std::vector<double>& values) const {
  const int count = accessor.sparse.count;
  const auto& indices = accessor.sparse.indices;
  const auto& numbers = accessor.sparse.values;
  if (count < 0 || static_cast<uint64_t>(count) > accessor.count) {
    return false;
  }
  std::vector<double> elements(count);
  const bool whole = readElements(indices.bufferView, indices.byteOffset, {indices.componentType}, count,
                                  [&](uint64_t i, double number) { elements[i] = number; });
  const auto inRange = [&](double element) { return element >= 0.0 && element < static_cast<double>(accessor.count); };
  return whole && std::ranges::all_of(elements, inRange) &&
         readElements(numbers.bufferView, numbers.byteOffset, type, count, [&](uint64_t i, double number) {
           values[static_cast<uint64_t>(elements[i / type.components]) * type.components + i % type.components] =
               number;
         });
}

std::optional<GltfFile::Picture> GltfFile::picture(int image) {
  if (!isIndex(image, images_.size())) {
    defects_.add(file_, 1, "images", "there is no image {}, the texture is left out", std::to_string(image));
    return std::nullopt;
  }
  const Source& source = images_[image];
  if (isDataUri(source.uri)) {
    return Picture{withoutLinks(file_) += fmt::format("#images[{}]", image), dataOf(source.uri)};
  }
  if (source.uri.empty()) {
    if (const auto bytes = viewBytes(source.bufferView)) {
      const tinygltf::BufferView& view = model_.bufferViews[source.bufferView];
      return Picture{withoutLinks(file_) += fmt::format("#buffers[{}]+{}", view.buffer, view.byteOffset),
                     std::vector(bytes->begin(), bytes->end())};
    }
  } else if (const std::optional<fs::path> found = find(source.uri)) {
    return Picture{*found};
  }
  if (source.uri.empty()) {
    defects_.add(file_, 1, "images", "image {} has no data, the texture is left out", std::to_string(image));
  } else {
    defects_.add(file_, 1, "images", "there is no file '{}', the texture is left out", source.uri);
  }
  return std::nullopt;
}

void addFilesOfGltf(const fs::path& file, std::set<fs::path>& files) {
  files.insert(file);
  try {
    const std::string text = readTextIfAny(file);
    const json root = parsedJson(file, partsOf(file, text).json, nullptr);
    ModelFiles search(file);
    for (const char* key : {"buffers", "images"}) {
      for (const json& entry : member(root, key)) {
        const json& uri = member(entry, "uri");
        if (!uri.is_string() || isDataUri(uri.get_ref<const std::string&>())) {
          continue;
        }
        if (const auto found = findFile(search, file, uri)) {
          files.insert(*found);
        }
      }
    }
  } catch (const InputError&) {  // of a damaged file, only the file itself can be told
  }
}

}  // namespace speculum
