#pragma once

#include <algorithm>
#include <optional>

#include "scene/scene.hpp"

namespace speculum {

struct InstanceState;

// Mirrors that the materials of models make; docs/scene_format.md says which materials say mirror.

// Cuts each mesh from index `first` on whose materials say mirror: sets Mesh::mirrorParts, and appends the meshes that
// it names. Call it once for each mesh, when all textures are there.
void cutMirrorParts(Scene& scene, size_t first);

// Sets Scene::materialMirrors. Call it whenever the scene's objects have changed. Where planar mirrors are too many, or
// an object is not visible everywhere, its flat parts become curved mirrors, which reflect the same.
void placeMaterialMirrors(Scene& scene);

// Logs a line for each model whose materials make mirrors of an object. Materials beyond the limit are a warning
// and a defect of the model; an object that is too large, too far away or copied too often is a warning only, and so
// are planar mirrors that became curved because the scene has too many. Call it after placeMaterialMirrors().
void logMaterialMirrors(Scene& scene);

// Says whether materials make mirrors of parts of the object.
bool makesMirrors(const Scene& scene, const Object& object);

// Calls visit(mesh) with the indices of the meshes that draw an object: its model, or the parts that it is cut into.
// The first has the bounds of the whole model.
template <typename Visit>
void forEachDrawnMesh(const Scene& scene, int object, const Visit& visit) {
  const int mesh = scene.objects[object].mesh;
  if (!makesMirrors(scene, scene.objects[object])) {
    return visit(mesh);
  }
  const MirrorParts& parts = *scene.meshes[mesh].mirrorParts;
  visit(parts.rest);
  std::ranges::for_each(parts.curved, visit);
  if (!std::ranges::binary_search(scene.materialMirrors, object, {}, &MaterialMirror::object)) {
    std::ranges::for_each(parts.flatMeshes, visit);
  }
}

// Returns how an instance reflects as a curved mirror, by its object or its material; nothing if it is none.
std::optional<ObjectMirror> curvedMirrorOf(const Scene& scene, const InstanceState& instance);
bool hasCurvedMirrors(const Scene& scene);

}  // namespace speculum
