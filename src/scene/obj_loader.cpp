#include "scene/obj_loader.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>

#include "scene/input_error.hpp"
#include "scene/mesh_builder.hpp"
#include "scene/obj_materials.hpp"
#include "scene/text_lines.hpp"

namespace speculum {

namespace {

// Most corners of a face; triangulation takes time in their square.
constexpr size_t kMostCorners = 1000;
// Share of the time that reading the text of a large model takes; the rest sorts its triangles.
constexpr double kReadShare = 0.65;

// Converts an index of a face to one from 0. It counts from 1, or backwards from -1, among the `count` lines of `kind`
// read so far.
int indexOf(const LineReader& line, std::string_view token, const char* kind, size_t count) {
  long long index = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), index);
  if (token.empty() || end != token.data() + token.size() || error == std::errc::invalid_argument) {
    line.fail("f", fmt::format("'{}' is not an index", token), "write v, v/vt, v//vn or v/vt/vn");
  }
  const auto largest = static_cast<long long>(count);
  if (error != std::errc() || index == 0 || index > largest || index < -largest) {
    const std::string range =
        count == 0 ? fmt::format("there is no {} line above", kind) : fmt::format("1 .. {0}, or -{0} .. -1", count);
    line.fail("f", fmt::format("{} index {} is out of range", kind, token), range);
  }
  return static_cast<int>(index < 0 ? largest + index : index - 1);
}

FaceCorner cornerOf(const LineReader& line, std::string_view token, const MeshBuilder& mesh) {
  const size_t first = token.find('/');
  FaceCorner corner{.position = indexOf(line, token.substr(0, first), "v", mesh.positionCount())};
  if (first == std::string_view::npos) {
    return corner;
  }
  const size_t second = std::min(token.find('/', first + 1), token.size());
  // Some programs write v/, v// and v/vt/.
  if (const std::string_view texcoord = token.substr(first + 1, second - first - 1); !texcoord.empty()) {
    corner.texcoord = indexOf(line, texcoord, "vt", mesh.texcoordCount());
  }
  if (second + 1 < token.size()) {
    corner.normal = indexOf(line, token.substr(second + 1), "vn", mesh.normalCount());
  }
  return corner;
}

// Feeds the lines of an OBJ file to a mesh builder.
class ObjReader {
 public:
  ObjReader(const std::filesystem::path& file, MeshBuilder& mesh, ObjMaterials& materials)
      : file_(file), mesh_(mesh), materials_(materials) {}

  void read(std::string_view text, const LoadProgress& progress) {
    constexpr int kLinesBetweenCalls = 1 << 14;
    LineReader line(file_, text, LineReader::Continuation::backslash);
    for (int count = 1; line.next(); ++count) {
      readLine(line);
      if (progress && count % kLinesBetweenCalls == 0) {
        progress(file_, kReadShare * line.done());
      }
    }
  }

 private:
  void readLine(LineReader& line) {
    const std::string_view keyword = line.keyword();
    if (keyword == "v") {
      // A weight or the three values of a color may follow; they are not used.
      const std::vector<double>& numbers = line.numbers(3, 8);
      mesh_.addPosition({numbers[0], numbers[1], numbers[2]});
    } else if (keyword == "vt") {
      const std::vector<double>& numbers = line.numbers(1, 3);
      mesh_.addTexcoord({numbers[0], numbers.size() > 1 ? numbers[1] : 0.0});
    } else if (keyword == "vn") {
      const std::vector<double>& numbers = line.numbers(3, 3);
      mesh_.addNormal({numbers[0], numbers[1], numbers[2]});
    } else if (keyword == "f") {
      readFace(line);
    } else if (keyword == "usemtl") {
      mesh_.setMaterial(materials_.find(line.argument()));
    } else if (keyword == "mtllib") {
      readMaterials(line);
    }
  }

  void readFace(const LineReader& line) {
    const size_t count = line.tokens().size() - 1;
    if (count < 3 || count > kMostCorners) {
      line.fail("f", fmt::format("has {} vertices", count),
                count < 3 ? "a face needs 3 or more" : fmt::format("3 .. {} are needed", kMostCorners));
    }
    corners_.clear();
    for (size_t i = 1; i <= count; ++i) {
      corners_.push_back(cornerOf(line, line.tokens()[i], mesh_));
    }
    mesh_.addFace(corners_);
  }

  // Reads the file that the line names: one name with blanks, or the first existing one of several names. A backslash
  // before a blank keeps the blank; any other separates folders.
  void readMaterials(const LineReader& line) {
    const std::string_view names = line.argument();
    if (names.find(' ') != std::string_view::npos && materials_.isThere(names)) {
      materials_.read(names);
      return;
    }
    std::string name;
    for (size_t i = 0; i <= names.size(); ++i) {
      if (i == names.size() || names[i] == ' ') {
        if (!name.empty() && materials_.read(name)) {
          return;
        }
        name.clear();
      } else {
        i += names.substr(i).starts_with("\\ ");
        name += names[i];
      }
    }
  }

  const std::filesystem::path& file_;
  MeshBuilder& mesh_;
  ObjMaterials& materials_;
  std::vector<FaceCorner> corners_;
};

}  // namespace

Mesh loadObj(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress) {
  if (progress) {
    progress(file, 0.0);
  }
  MeshBuilder builder;
  ObjMaterials materials(file);
  ObjReader(file, builder, materials).read(readInputText(file, "a Wavefront OBJ file is needed"), progress);
  if (progress) {
    progress(file, kReadShare);
  }
  Mesh mesh = builder.finish(file, [&](int index) { return materials.material(index, textures); });
  mesh.materialFiles.assign(materials.files().begin(), materials.files().end());
  if (mesh.indices.empty()) {
    throwInputError(file, 1, "f", "the model has no triangle", "at least one face with an area is needed");
  }
  return mesh;
}

}  // namespace speculum
