#include "scene/obj_loader.hpp"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <charconv>
#include <istream>
#include <limits>
#include <streambuf>
#include <utility>

#include "platform/files.hpp"
#include "platform/text.hpp"
#include "scene/input_error.hpp"
#include "scene/mesh_builder.hpp"
#include "scene/model_files.hpp"
#include "scene/text_lines.hpp"

namespace speculum {

namespace {

// Share of the time that reading the text of a large model takes; the rest sorts its triangles.
constexpr double readShare = 0.65;

// What a file holds, so that an error can say what a file without faces is.
struct Contents {
  int firstFace = 0;  // its line; 0: there is none
  bool linesOrPoints = false;
  bool freeForm = false;  // curves and surfaces
};

// Returns the keyword in lower case; `fo` is an old one for `f`.
std::string keywordOf(const LineReader& line) {
  const std::string keyword = lowerCase(std::string(line.keyword()));
  return keyword == "fo" ? "f" : keyword;
}

// Hands tinyobjloader one line at a time, so that the callbacks know which line they are called for. Lines are joined
// after a backslash, which the library does not do, keywords are in lower case, and a line of nothing but its keyword
// gets an argument, because the library would skip it, and with it the number of a vertex.
class LineStream : public std::streambuf {
 public:
  LineStream(LineReader& line, std::function<void()> onLine) : line_(line), onLine_(std::move(onLine)) {}

 protected:
  int_type underflow() override {
    if (!line_.next()) {
      return traits_type::eof();
    }
    onLine_();
    const std::vector<std::string_view>& tokens = line_.tokens();
    text_ = keywordOf(line_) + ' ';
    if (tokens.size() > 1) {
      text_.append(tokens[1].data(), tokens.back().data() + tokens.back().size());
    } else {
      text_ += '0';
    }
    text_ += '\n';
    setg(text_.data(), text_.data(), text_.data() + text_.size());
    return traits_type::to_int_type(text_[0]);
  }

 private:
  LineReader& line_;
  std::function<void()> onLine_;
  std::string text_;
};

// Feeds the lines of an OBJ file to a mesh builder. tinyobjloader says what a line is; its numbers and indices are read
// again from the line's tokens, because the library
// - does not round to the nearest double, and reads nan and words as 0;
// - reads the index that follows "1/ 2" as a texture coordinate, and any integer for one that is too large;
// - reads no colors of vertices and no smoothing groups in this interface.
class ObjReader {
 public:
  ObjReader(const std::filesystem::path& file, std::string_view text, MeshBuilder& mesh, ObjMaterials& materials,
            ModelDefects& defects)
      : file_(file),
        line_(text, LineReader::Continuation::backslash),
        mesh_(mesh),
        materials_(materials),
        defects_(defects) {}

  Contents read(const LoadProgress& progress) {
    constexpr int linesBetweenCalls = 1 << 14;
    int count = 0;
    LineStream lines(line_, [&] {
      noteContents();
      readSmoothing();
      if (progress && ++count % linesBetweenCalls == 0) {
        progress(file_, readShare * line_.done());
      }
    });
    std::istream stream(&lines);
    // Without badbit, an exception of a callback or of `progress` would end the stream like the end of the file.
    stream.exceptions(std::ios::badbit);
    Materials materials(*this);
    tinyobj::LoadObjWithCallback(stream, callbacks(), this, &materials);
    addLaterFaces();
    return contents_;
  }

 private:
  // A face whose vertices stand further down in the file. Its corners are in laterCorners_.
  struct LaterFace {
    size_t first = 0;
    size_t count = 0;
    int material = -1;
    uint32_t smoothing = 0;
    int line = 0;
  };

  // The library asks for each name of a mtllib line until one can be read. The first request reads the files of all
  // names.
  class Materials : public tinyobj::MaterialReader {
   public:
    explicit Materials(ObjReader& reader) : reader_(reader) {}
    bool operator()(const std::string&, std::vector<tinyobj::material_t>*, std::map<std::string, int>*, std::string*,
                    std::string*) override {
      if (std::exchange(lastLine_, reader_.line_.number()) != reader_.line_.number()) {
        reader_.materials_.read(reader_.line_.argument(), reader_.line_.number());
      }
      return false;
    }

   private:
    ObjReader& reader_;
    int lastLine_ = 0;
  };

  static ObjReader& self(void* user) { return *static_cast<ObjReader*>(user); }

  static tinyobj::callback_t callbacks() {
    using tinyobj::real_t;
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = [](void* user, real_t, real_t, real_t, real_t) { self(user).addPosition(); };
    callbacks.texcoord_cb = [](void* user, real_t, real_t, real_t) { self(user).addTexcoord(); };
    callbacks.normal_cb = [](void* user, real_t, real_t, real_t) { self(user).addNormal(); };
    callbacks.index_cb = [](void* user, tinyobj::index_t*, int) { self(user).addFace(); };
    callbacks.usemtl_cb = [](void* user, const char*, int) { self(user).useMaterial(); };
    return callbacks;
  }

  void noteContents() {
    if (contents_.firstFace != 0) {
      return;
    }
    const std::string keyword = keywordOf(line_);
    contents_.firstFace = keyword == "f" ? line_.number() : 0;
    contents_.linesOrPoints = contents_.linesOrPoints || keyword == "l" || keyword == "p";
    contents_.freeForm = contents_.freeForm || keyword == "curv" || keyword == "curv2" || keyword == "surf";
  }

  // A line `s 1` begins a smoothing group; `s 0`, `s off` and any other word end it.
  void readSmoothing() {
    if (line_.keyword() == "s" || line_.keyword() == "S") {
      const double group = number(1);
      smoothing_ = group >= 1.0 && group < 4e9 ? static_cast<uint32_t>(group) : 0;
      mesh_.setSmoothing(smoothing_);
    }
  }

  // The number in a token of the line; NaN if there is none.
  double number(size_t token) const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return token < line_.tokens().size() ? parseNumber(line_.tokens()[token]).value_or(none) : none;
  }

  ModelDefects::Kind& add(std::string_view key, std::string_view kind, std::string_view detail = {}) {
    return defects_.add(file_, line_.number(), key, kind, detail);
  }

  // A damaged element is added too, so that the indices of later elements stay right.
  void addPosition() {
    const glm::dvec3 position(number(1), number(2), number(3));
    if (!isFinite(position)) {
      add("v", "is not a point of three finite numbers, faces with it are left out").costsTriangles = true;
    }
    mesh_.addPosition(position, vertexColor());
  }

  // Three numbers behind the coordinates are a color, with or without an opacity behind them; a single one is a weight.
  std::optional<glm::vec4> vertexColor() {
    if (line_.tokens().size() < 7) {
      return std::nullopt;
    }
    const glm::dvec3 color(number(4), number(5), number(6));
    if (!isFinite(color)) {
      add("v", "has a color that is not three finite numbers, it counts as white");
      return glm::vec4(1.0f);
    }
    if (color != glm::clamp(color, 0.0, 1.0)) {
      add("v", "has a color outside 0 .. 1, the nearest one is used");
    }
    return glm::vec4(glm::clamp(color, 0.0, 1.0), 1.0);
  }

  void addTexcoord() {
    const glm::dvec2 texcoord(number(1), line_.tokens().size() > 2 ? number(2) : 0.0);
    if (!isFinite(glm::dvec3(texcoord, 0.0))) {
      add("vt", "is not one to three finite numbers, it counts as missing");
    }
    mesh_.addTexcoord(texcoord);
  }

  void addNormal() {
    const glm::dvec3 normal(number(1), number(2), number(3));
    if (!isFinite(normal)) {
      add("vn", "is not a vector of three finite numbers, it counts as missing");
    }
    mesh_.addNormal(normal);
  }

  void useMaterial() {
    material_ = materials_.use(line_.argument(), line_.number());
    mesh_.setMaterial(material_);
  }

  void addFace() {
    const std::vector<std::string_view>& tokens = line_.tokens();
    corners_.clear();
    for (size_t i = 1; i < tokens.size(); ++i) {
      if (!addCorner(tokens[i])) {
        add("f", "'{}' is no corner (v, v/vt, v//vn or v/vt/vn), the face is left out", tokens[i]).costsTriangles =
            true;
        return;
      }
    }
    if (corners_.size() < 3) {
      add("f", "has fewer than three corners, the face is left out").costsTriangles = true;
    } else if (std::ranges::any_of(corners_, [&](const FaceCorner& corner) { return isLater(corner); })) {
      later_.push_back({laterCorners_.size(), corners_.size(), material_, smoothing_, line_.number()});
      laterCorners_.insert(laterCorners_.end(), corners_.begin(), corners_.end());
    } else {
      addFace(corners_, line_.number());
    }
  }

  bool isLater(const FaceCorner& corner) const {
    return corner.position >= static_cast<int>(mesh_.positionCount()) ||
           corner.texcoord >= static_cast<int>(mesh_.texcoordCount()) ||
           corner.normal >= static_cast<int>(mesh_.normalCount());
  }

  void addLaterFaces() {
    for (const LaterFace& face : later_) {
      mesh_.setMaterial(face.material);
      mesh_.setSmoothing(face.smoothing);
      addFace(std::span(laterCorners_).subspan(face.first, face.count), face.line);
    }
  }

  // Adds a face whose indices may be out of range.
  void addFace(std::span<FaceCorner> corners, int line) {
    for (FaceCorner& corner : corners) {
      if (!isInRange(corner.position, mesh_.positionCount())) {
        defects_.add(file_, line, "f", "has a vertex that is not there, the face is left out").costsTriangles = true;
        return;
      }
      if (corner.texcoord != noIndex && !isInRange(corner.texcoord, mesh_.texcoordCount())) {
        defects_.add(file_, line, "f", "has a texture coordinate that is not there, it counts as missing");
        corner.texcoord = noIndex;
      }
      if (corner.normal != noIndex && !isInRange(corner.normal, mesh_.normalCount())) {
        defects_.add(file_, line, "f", "has a normal that is not there, it counts as missing");
        corner.normal = noIndex;
      }
    }
    mesh_.addFace(corners, line);
  }

  static bool isInRange(int index, size_t count) { return index >= 0 && index < static_cast<int>(count); }

  // Appends the corner that a token names; returns false if the token is no corner.
  bool addCorner(std::string_view token) {
    const size_t first = std::min(token.find('/'), token.size());
    const size_t second = std::min(token.find('/', std::min(first + 1, token.size())), token.size());
    const std::string_view texcoord = first < token.size() ? token.substr(first + 1, second - first - 1) : "";
    const std::string_view normal = second < token.size() ? token.substr(second + 1) : "";
    FaceCorner& corner = corners_.emplace_back();
    // Some programs write v/, v// and v/vt/.
    return readIndex(token.substr(0, first), mesh_.positionCount(), corner.position) &&
           (texcoord.empty() || readIndex(texcoord, mesh_.texcoordCount(), corner.texcoord)) &&
           (normal.empty() || readIndex(normal, mesh_.normalCount(), corner.normal));
  }

  // Converts an index, which counts from 1, or backwards from -1 among the `count` elements above, to an index from 0.
  // Indices that are out of any range become `nowhere`. Returns false if the token is no integer.
  static bool readIndex(std::string_view token, size_t count, int& index) {
    long long value = 0;
    if (token.starts_with('+') && !token.starts_with("+-")) {
      token.remove_prefix(1);
    }
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (token.empty() || end != token.data() + token.size() || error == std::errc::invalid_argument) {
      return false;
    }
    const long long fromZero = value > 0 ? value - 1 : value + static_cast<long long>(count);
    const bool usable =
        error == std::errc() && value != 0 && fromZero >= 0 && fromZero < std::numeric_limits<int>::max();
    index = usable ? static_cast<int>(fromZero) : nowhere;
    return true;
  }

  static constexpr int noIndex = -1;  // the token has no such index
  static constexpr int nowhere = -2;  // the index is out of any range

  const std::filesystem::path& file_;
  LineReader line_;
  MeshBuilder& mesh_;
  ObjMaterials& materials_;
  ModelDefects& defects_;
  Contents contents_;
  int material_ = -1;
  uint32_t smoothing_ = 0;
  std::vector<FaceCorner> corners_;
  std::vector<LaterFace> later_;
  std::vector<FaceCorner> laterCorners_;
};

[[noreturn]] void throwNothingToDraw(const std::filesystem::path& file, const std::optional<ForeignFile>& foreign,
                                     const Contents& contents, const ModelDefects& defects) {
  const std::string right = "at least one face with an area is needed";
  if (foreign && (foreign->isKnown || contents.firstFace == 0)) {
    throwInputError(file, 1, "file", foreign->wrong, foreign->right);
  }
  if (const auto lost = defects.lostTriangles(); lost && contents.firstFace != 0) {
    throw InputError(*lost + " (no triangle is left to draw)");
  }
  if (contents.firstFace != 0) {
    throwInputError(file, contents.firstFace, "f", "has no area, like every other face", right);
  }
  if (contents.freeForm) {
    throwInputError(file, 1, "f", "the model has free-form curves or surfaces, but no face", "export it as triangles");
  }
  throwInputError(file, 1, "f",
                  contents.linesOrPoints ? "the model has lines or points, but no face" : "the model has no face",
                  right);
}

// Reads the file into `builder` and `materials`. Returns what the file holds and, if it has another format, which one.
std::pair<Contents, std::optional<ForeignFile>> readObj(const std::filesystem::path& file, MeshBuilder& builder,
                                                        ObjMaterials& materials, ModelDefects& defects,
                                                        const LoadProgress& progress) {
  const std::string text = readInputText(file, "a Wavefront OBJ file is needed");
  return {ObjReader(file, text, builder, materials, defects).read(progress), foreignFile(text, ".obj")};
}

}  // namespace

Mesh loadObj(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress) {
  if (progress) {
    progress(file, 0.0);
  }
  ModelDefects defects;
  MeshBuilder builder(file, defects, "f");
  ObjMaterials materials(file, defects);
  const auto [contents, foreign] = readObj(file, builder, materials, defects, progress);
  if (progress) {
    progress(file, readShare);
  }
  Mesh mesh = builder.finish([&](int index) { return materials.material(index, builder.hasColors(), textures); });
  mesh.materialFiles.assign(materials.files().begin(), materials.files().end());
  for (const std::filesystem::path& named : materials.namedFiles()) {
    mesh.namedFiles.push_back(named.lexically_relative(file.lexically_normal().parent_path()));
  }
  mesh.defects = defects.report();
  if (mesh.indices.empty()) {
    throwNothingToDraw(file, foreign, contents, defects);
  }
  return mesh;
}

void addFilesOfObj(const std::filesystem::path& file, std::set<std::filesystem::path>& files) {
  ModelFiles search(file);
  files.insert(file);
  const std::string text = readTextIfAny(file);
  for (LineReader line(text, LineReader::Continuation::backslash); line.next();) {
    if (lowerCase(std::string(line.keyword())) == "mtllib") {
      forEachLibrary(
          search, file, line.argument(),
          [&](const std::filesystem::path& named, std::string_view) { addFilesOfMtl(named, search, files); },
          [](const std::string&) {});
    }
  }
}

}  // namespace speculum
