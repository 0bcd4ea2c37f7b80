#include <algorithm>
#include <functional>
#include <sstream>

#include "scene/input_error.hpp"
#include "scene/mesh_builder.hpp"
#include "scene/obj_materials.hpp"
#include "scene/obj_scan.hpp"
#include "scene/scene_loader.hpp"

namespace speculum {

namespace {

// What the parser's callbacks fill. The indices it passes on are those of the file: from 1, negative ones relative, 0
// for none; the scan has made sure of their range.
struct ObjSink {
  ObjGeometry geometry;
  ObjMaterials materials;
  int material = -1;
  std::function<void()> alive;  // called now and then
  size_t calls = 0;

  void count() {
    constexpr size_t kOften = 1 << 14;
    if (++calls % kOften == 0 && alive) {
      alive();
    }
  }

  static int zeroBased(int index, size_t count) { return index < 0 ? static_cast<int>(count) + index : index - 1; }

  static void position(void* self, double x, double y, double z, double) {
    static_cast<ObjSink*>(self)->count();
    static_cast<ObjSink*>(self)->geometry.positions.emplace_back(x, y, z);
  }

  static void texcoord(void* self, double u, double v, double) {
    static_cast<ObjSink*>(self)->geometry.texcoords.emplace_back(u, v);
  }

  static void normal(void* self, double x, double y, double z) {
    static_cast<ObjSink*>(self)->geometry.normals.emplace_back(x, y, z);
  }

  static void face(void* self, tinyobj::index_t* indices, int count) {
    ObjSink& sink = *static_cast<ObjSink*>(self);
    sink.count();
    ObjGeometry& geometry = sink.geometry;
    geometry.faces.push_back(
        {.firstCorner = geometry.corners.size(), .cornerCount = static_cast<size_t>(count), .material = sink.material});
    for (int i = 0; i < count; ++i) {
      geometry.corners.push_back({.position = zeroBased(indices[i].vertex_index, geometry.positions.size()),
                                  .texcoord = zeroBased(indices[i].texcoord_index, geometry.texcoords.size()),
                                  .normal = zeroBased(indices[i].normal_index, geometry.normals.size())});
    }
  }

  static void useMaterial(void* self, const char* name, int) {
    ObjSink& sink = *static_cast<ObjSink*>(self);
    sink.material = sink.materials.find(name);
  }
};

}  // namespace

Mesh loadObj(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress) {
  // Shares of the time that the steps take of a large model.
  constexpr double kScanned = 0.35;
  constexpr double kParsed = 0.65;
  const auto tell = [&](double done) {
    if (progress) {
      progress(file, done);
    }
  };
  tell(0.0);
  const ObjScan scan = scanObj(file, readText(file, file, 1, "file", "a Wavefront OBJ file is needed"),
                               [&](double part) { tell(kScanned * part); });
  ObjSink sink{.materials = ObjMaterials(file)};
  tinyobj::callback_t callback;
  callback.vertex_cb = &ObjSink::position;
  callback.texcoord_cb = &ObjSink::texcoord;
  callback.normal_cb = &ObjSink::normal;
  callback.index_cb = &ObjSink::face;
  callback.usemtl_cb = &ObjSink::useMaterial;
  std::istringstream stream(scan.text);
  sink.alive = [&] {
    const double part = static_cast<double>(stream.tellg()) / static_cast<double>(scan.text.size());
    tell(kScanned + (kParsed - kScanned) * std::clamp(part, 0.0, 1.0));
  };
  tell(kScanned);
  tinyobj::LoadObjWithCallback(stream, callback, &sink, &sink.materials);
  tell(kParsed);
  Mesh mesh = buildMesh(file, sink.geometry, scan, [&](int index) { return sink.materials.material(index, textures); });
  if (mesh.indices.empty()) {
    throwInputError(file, 1, "f", "the model has no triangle", "at least one face with an area is needed");
  }
  return mesh;
}

}  // namespace speculum
