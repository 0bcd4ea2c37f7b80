#include "scene/material_mirrors.hpp"

#include <spdlog/spdlog.h>

#include <array>
#include <cmath>
#include <glm/gtx/component_wise.hpp>

#include "geometry/bvh.hpp"
#include "geometry/convex_mesh.hpp"
#include "geometry/polygon.hpp"
#include "platform/text.hpp"
#include "scene/mesh_builder.hpp"
#include "scene/scene_state.hpp"

namespace speculum {

namespace {

// Bounds of the work on a model and of what it makes: flat triangles of a material, materials that make mirrors,
// planes, and convex pieces of a material.
constexpr size_t mostFlatTriangles = 1 << 14;
constexpr size_t mostMaterials = 256;
constexpr size_t mostPlanes = 32;
constexpr size_t mostPieces = 256;
constexpr size_t mostCorners = 1000;  // of a piece or an outline, as of a mirror in a file
// Bounds of what each frame places: parts of all copies of an object that materials cut, and planar mirrors of a scene.
constexpr size_t mostCopiedParts = 1 << 17;
constexpr size_t mostPlanar = 1000;

// Metres, of objects whose parts become mirrors, and the distance from the origin in radii of the smallest extent:
// rounding leaves their polygons flat and convex.
constexpr double largestExtent = 1e15;
constexpr double smallestExtent = 1e-12;
constexpr double farthestAway = 1e8;

// Distance from a plane, in radii of the model, within which faces count as flat and in one plane.
constexpr double flatness = 1e-5;

bool saysMirror(const MeshPart& part) {
  return part.material.mirror.has_value();
}

struct TrianglePart {
  Material material;
  std::vector<uint32_t> indices;  // of the vertices of the mesh that is cut
};

// Says whether the triangle is shaded as a flat one: with one normal, nearly its own. Files round normals to 8 bits or
// two decimals. That turns them by up to half a degree, but leaves equal ones equal.
bool isFlat(const Mesh& mesh, const uint32_t* corners) {
  constexpr double one = 1.0 - 4e-6;       // cosines: of 0.16 degrees
  constexpr double nearly = 1.0 - 1.5e-4;  // of one degree
  const std::array<Vertex, 3> v{mesh.vertices[corners[0]], mesh.vertices[corners[1]], mesh.vertices[corners[2]]};
  const glm::dvec3 normal = glm::normalize(glm::cross(v[1].position - v[0].position, v[2].position - v[0].position));
  const std::array<glm::dvec3, 3> own = cornerNormals(mesh, corners);
  return std::ranges::all_of(own, [&](const glm::dvec3& n) {
    return std::abs(glm::dot(n, normal)) > nearly && std::abs(glm::dot(n, own[0])) > one;
  });
}

bool liesIn(const Plane& plane, double tolerance, std::span<const glm::dvec3> polygon) {
  return glm::dot(plane.normal, newellVector(polygon)) > 0.9 * glm::length(newellVector(polygon)) &&
         std::ranges::all_of(polygon, [&](const glm::dvec3& p) { return std::abs(plane.distance(p)) <= tolerance; });
}

bool contains(std::span<const glm::dvec3> polygon, const glm::dvec3& normal, const glm::dvec3& point) {
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const glm::dvec3 inward = glm::cross(normal, edge);
    if (glm::dot(inward, point - polygon[i]) < -1e-9 * glm::dot(edge, edge)) {
      return false;
    }
  }
  return true;
}

// A plane of a mirror's faces.
struct FlatGroup {
  Plane plane;
  FlatMirror mirror;
  double area = 0.0;  // of the pieces
};

void findOutline(FlatGroup& group) {
  const glm::dvec3& normal = group.plane.normal;
  const glm::dvec3 helper = std::abs(normal.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 x = glm::normalize(glm::cross(helper, normal));
  const glm::dvec3 y = glm::cross(normal, x);
  std::vector<glm::dvec2> points;
  for (const std::vector<glm::dvec3>& piece : group.mirror.pieces) {
    group.area += polygonArea(piece);
    for (const glm::dvec3& p : piece) {
      points.emplace_back(glm::dot(p - group.plane.point, x), glm::dot(p - group.plane.point, y));
    }
  }
  for (const glm::dvec2& p : convexHull(std::move(points))) {
    group.mirror.outline.push_back(group.plane.point + p.x * x + p.y * y);
  }
  const double hull = polygonArea(group.mirror.outline);
  group.mirror.convex = group.mirror.pieces.size() == 1 || std::abs(group.area - hull) <= 1e-6 * hull;
}

// Joins flat triangles of a material to planar mirrors. Leaves small ones out.
std::vector<FlatGroup> flatGroups(const Mesh& mesh, std::span<const glm::dvec3> positions, const TrianglePart& flat) {
  const double tolerance = flatness * mesh.radius;
  const double leastArea = 1e-4 * mesh.radius * mesh.radius;
  std::vector<FlatGroup> groups;
  for (std::vector<glm::dvec3>& face : convexFaces(positions, flat.indices, mostPieces, mostFlatTriangles)) {
    auto group = std::ranges::find_if(groups, [&](const FlatGroup& g) { return liesIn(g.plane, tolerance, face); });
    if (group == groups.end()) {
      if (polygonArea(face) < leastArea) {
        continue;
      }
      groups.push_back(
          {.plane = {vertexMean(face), glm::normalize(newellVector(face))}, .mirror = {.material = flat.material}});
      group = groups.end() - 1;
    }
    // Faces come with the largest first, so one within another is there twice.
    if (std::ranges::any_of(group->mirror.pieces, [&](const std::vector<glm::dvec3>& piece) {
          return contains(piece, group->plane.normal, vertexMean(face));
        })) {
      continue;
    }
    for (glm::dvec3& p : face) {
      p -= group->plane.distance(p) * group->plane.normal;
    }
    group->mirror.pieces.push_back(std::move(face));
  }
  std::ranges::for_each(groups, findOutline);
  std::erase_if(groups, [](const FlatGroup& group) {
    const auto isLong = [](const std::vector<glm::dvec3>& polygon) { return polygon.size() > mostCorners; };
    return isLong(group.mirror.outline) || std::ranges::any_of(group.mirror.pieces, isLong) ||
           polygonDefect(group.mirror.outline).has_value();
  });
  return groups;
}

bool covers(const FlatGroup& group, double tolerance, std::span<const glm::dvec3> triangle) {
  return liesIn(group.plane, 2.0 * tolerance, triangle) &&
         std::ranges::any_of(group.mirror.pieces, [&](const std::vector<glm::dvec3>& piece) {
           return contains(piece, group.plane.normal, vertexMean(triangle));
         });
}

// Returns a mesh of these triangles, in the space of `mesh` and with its bounds.
Mesh partOf(const Mesh& mesh, std::span<const TrianglePart> parts) {
  Mesh part{.source = mesh.source,
            .unit = mesh.unit,
            .center = mesh.center,
            .halfExtent = mesh.halfExtent,
            .radius = mesh.radius};
  std::vector<uint32_t> newIndex(mesh.vertices.size(), ~0u);
  for (const TrianglePart& from : parts) {
    part.parts.push_back({.firstIndex = static_cast<uint32_t>(part.indices.size()),
                          .indexCount = static_cast<uint32_t>(from.indices.size()),
                          .material = from.material});
    for (const uint32_t index : from.indices) {
      if (newIndex[index] == ~0u) {
        newIndex[index] = static_cast<uint32_t>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[index]);
        if (!mesh.colors.empty()) {
          part.colors.push_back(mesh.colors[index]);
        }
      }
      part.indices.push_back(newIndex[index]);
    }
  }
  return part;
}

// Returns a curved mirror of these triangles, with bounds and an environment map of its own.
Mesh curvedPart(const Mesh& mesh, const TrianglePart& triangles) {
  Mesh part = partOf(mesh, {&triangles, 1});
  Bounds box;
  std::ranges::for_each(part.vertices, [&](const Vertex& vertex) { box.add(vertex.position); });
  const glm::dvec3 moved = box.center();
  part.center += part.unit * moved;
  part.halfExtent = glm::dvec3(0.0);
  part.radius = 0.0;
  for (Vertex& vertex : part.vertices) {
    vertex.position -= moved;
    part.halfExtent = glm::max(part.halfExtent, glm::abs(vertex.position));
    part.radius = std::max(part.radius, glm::length(vertex.position));
  }
  part.curvedMirror = true;
  finishShape(part);
  return part;
}

// Parts of a mesh before they have indices among the scene's meshes.
struct Cut {
  Mesh rest;
  std::vector<FlatMirror> flat;
  std::vector<Mesh> curved;
  std::vector<Mesh> flatMeshes;
};

// Triangles of a material that says mirror.
struct MirrorTriangles {
  TrianglePart flat;
  TrianglePart curved;
  std::vector<FlatGroup> groups;  // planes of `flat`
};

MirrorTriangles mirrorTriangles(const Mesh& mesh, std::span<const glm::dvec3> positions, const MeshPart& part) {
  MirrorTriangles triangles{{part.material, {}}, {part.material, {}}, {}};
  const auto from = mesh.indices.begin() + part.firstIndex;
  for (auto corner = from; corner != from + part.indexCount; corner += 3) {
    std::vector<uint32_t>& list = (isFlat(mesh, &*corner) ? triangles.flat : triangles.curved).indices;
    list.insert(list.end(), corner, corner + 3);
  }
  triangles.groups = flatGroups(mesh, positions, triangles.flat);
  return triangles;
}

// Keeps the largest planes of all materials; of equal ones the first.
void keepLargest(std::vector<MirrorTriangles>& mirrors) {
  std::vector<FlatGroup*> groups;
  for (MirrorTriangles& mirror : mirrors) {
    std::ranges::transform(mirror.groups, std::back_inserter(groups), [](FlatGroup& group) { return &group; });
  }
  std::ranges::stable_sort(groups, std::greater(), &FlatGroup::area);
  std::for_each(groups.begin() + std::min(groups.size(), mostPlanes), groups.end(),
                [](FlatGroup* group) { group->mirror.pieces.clear(); });
  for (MirrorTriangles& mirror : mirrors) {
    std::erase_if(mirror.groups, [](const FlatGroup& group) { return group.mirror.pieces.empty(); });
  }
}

// Cuts the triangles into planar and curved mirrors.
void cutMirror(const Mesh& mesh, MirrorTriangles& mirror, Cut& cut) {
  std::vector<uint32_t>& curved = mirror.curved.indices;
  TrianglePart planar{mirror.flat.material, {}};
  const std::vector<uint32_t>& flat = mirror.flat.indices;
  for (size_t i = 0; i < flat.size(); i += 3) {
    std::array<glm::dvec3, 3> triangle;
    std::transform(&flat[i], &flat[i] + 3, triangle.begin(),
                   [&](uint32_t index) { return mesh.vertices[index].position; });
    const bool covered = std::ranges::any_of(
        mirror.groups, [&](const FlatGroup& group) { return covers(group, flatness * mesh.radius, triangle); });
    std::vector<uint32_t>& list = covered ? planar.indices : curved;
    list.insert(list.end(), &flat[i], &flat[i] + 3);
  }
  std::ranges::transform(mirror.groups, std::back_inserter(cut.flat), &FlatGroup::mirror);
  if (!curved.empty()) {
    cut.curved.push_back(curvedPart(mesh, mirror.curved));
  }
  if (!planar.indices.empty()) {
    cut.flatMeshes.push_back(curvedPart(mesh, planar));
  }
}

Cut cutMesh(const Mesh& mesh) {
  Cut cut;
  std::vector<TrianglePart> rest;
  std::vector<MirrorTriangles> mirrors;
  std::vector<glm::dvec3> positions = mesh.positions();
  const uint32_t usual = static_cast<uint32_t>(mesh.indices.size()) - 3 * mesh.repeats;
  uint32_t repeats = 0;
  for (const MeshPart& part : mesh.parts) {
    if (saysMirror(part) && mirrors.size() < mostMaterials) {
      mirrors.push_back(mirrorTriangles(mesh, positions, part));
      continue;
    }
    const auto first = mesh.indices.begin() + part.firstIndex;
    rest.push_back({part.material, {first, first + part.indexCount}});
    repeats += part.firstIndex >= usual ? part.indexCount / 3 : 0;
  }
  keepLargest(mirrors);
  std::ranges::for_each(mirrors, [&](MirrorTriangles& mirror) { cutMirror(mesh, mirror, cut); });
  cut.rest = partOf(mesh, rest);
  cut.rest.repeats = repeats;
  finishShape(cut.rest);
  return cut;
}

ObjectMirror mirrorOf(const Object& object, const Material& material) {
  return {.reflectance = glm::clamp(object.specular.value_or(*material.mirror), 0.0, 1.0),
          .baseColor = object.color.value_or(material.diffuse)};
}

// Says whether the materials of the object's model are to make mirrors.
bool wantsMirrors(const Scene& scene, const Object& object) {
  return object.mirrorsFromMaterials && !object.mirror && object.mesh >= 0 && scene.meshes[object.mesh].mirrorParts;
}

std::string nameOf(const Scene& scene, const Object& object) {
  return object.name.empty() ? scene.meshes[object.mesh].source.stem().string() : object.name;
}

}  // namespace

void cutMirrorParts(Scene& scene, size_t first) {
  const size_t end = scene.meshes.size();
  for (size_t i = first; i < end; ++i) {
    if (std::ranges::none_of(scene.meshes[i].parts, saysMirror)) {
      continue;
    }
    Cut cut = cutMesh(scene.meshes[i]);
    MirrorParts parts{.flat = std::move(cut.flat)};
    const auto append = [&](Mesh& mesh) {
      scene.meshes.push_back(std::move(mesh));
      return static_cast<int>(scene.meshes.size()) - 1;
    };
    parts.rest = append(cut.rest);
    std::ranges::transform(cut.curved, std::back_inserter(parts.curved), append);
    std::ranges::transform(cut.flatMeshes, std::back_inserter(parts.flatMeshes), append);
    scene.meshes[i].mirrorParts = std::move(parts);
  }
}

bool makesMirrors(const Scene& scene, const Object& object) {
  if (!wantsMirrors(scene, object)) {
    return false;
  }
  const Mesh& mesh = scene.meshes[object.mesh];
  const size_t parts = 1 + mesh.mirrorParts->curved.size() + mesh.mirrorParts->flatMeshes.size();
  const glm::dvec3 scale = glm::abs(object.scale);
  const double middle = glm::compMax(scale) * glm::length(mesh.center);
  const double largest = glm::compMax(scale) * mesh.radius * mesh.unit;
  const double smallest = glm::compMin(scale) * mesh.radius * mesh.unit;
  const double away = glm::length(object.position) + object.copies.count * glm::length(object.copies.step) + middle;
  return parts * static_cast<size_t>(object.copies.count) <= mostCopiedParts && middle + largest <= largestExtent &&
         smallest >= smallestExtent && std::max(away, largest) <= farthestAway * smallest;
}

void placeMaterialMirrors(Scene& scene) {
  scene.materialMirrors.clear();
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!makesMirrors(scene, object) || object.visible != Visibility::everywhere) {
      continue;
    }
    const std::vector<FlatMirror>& flat = scene.meshes[object.mesh].mirrorParts->flat;
    const size_t count = flat.size() * static_cast<size_t>(object.copies.count);
    if (scene.materialMirrors.size() + count > mostPlanar) {
      continue;
    }
    for (size_t k = 0; k < count; ++k) {
      const FlatMirror& from = flat[k % flat.size()];
      const ObjectMirror optics = mirrorOf(object, from.material);
      const std::string number = count > 1 ? " " + std::to_string(k) : "";
      scene.materialMirrors.push_back({.mirror = {.name = nameOf(scene, object) + " mirror" + number,
                                                  .spin = object.spin,
                                                  .reflectance = optics.reflectance,
                                                  .baseColor = optics.baseColor,
                                                  .twoSided = from.material.twoSided,
                                                  .backColor = optics.baseColor},
                                       .object = static_cast<int>(i),
                                       .copy = static_cast<int>(k / flat.size()),
                                       .flat = static_cast<int>(k % flat.size())});
    }
  }
}

void logMaterialMirrors(Scene& scene) {
  for (size_t i = 0; i < scene.meshes.size(); ++i) {
    Mesh& mesh = scene.meshes[i];
    bool used = false;
    for (const Object& object : scene.objects) {
      if (object.mesh != static_cast<int>(i) || !wantsMirrors(scene, object)) {
        continue;
      }
      const bool makes = makesMirrors(scene, object);
      used = used || makes;
      if (!makes) {
        spdlog::warn(oneLine(
            fmt::format("{}: its materials make no mirrors of object '{}', which is too large, too small, too far away "
                        "or copied too often (mirrors_from_materials = false, or fewer copies, are needed)",
                        mesh.source.string(), nameOf(scene, object))));
      } else if (object.visible == Visibility::everywhere && !mesh.mirrorParts->flat.empty() &&
                 !std::ranges::binary_search(scene.materialMirrors, static_cast<int>(&object - scene.objects.data()),
                                             {}, &MaterialMirror::object)) {
        spdlog::warn(oneLine(fmt::format(
            "{}: its planar mirrors of object '{}' become curved, because the scene would get more than {} planar "
            "mirrors from materials (mirrors_from_materials = false, or fewer copies, are needed of some objects)",
            mesh.source.string(), nameOf(scene, object), mostPlanar)));
      }
    }
    if (used) {
      spdlog::info(oneLine(
          fmt::format("{}: its materials make {} planar and {} curved mirrors (mirrors_from_materials = false: none)",
                      mesh.source.string(), mesh.mirrorParts->flat.size(), mesh.mirrorParts->curved.size())));
      const auto count = std::ranges::count_if(mesh.parts, saysMirror);
      if (count > static_cast<std::ptrdiff_t>(mostMaterials)) {
        mesh.defects.push_back(oneLine(fmt::format("{}:1: materials: {} say mirror, the first {} make mirrors",
                                                   mesh.source.string(), count, mostMaterials)));
        spdlog::warn("{}", mesh.defects.back());
      }
    }
  }
}

std::optional<ObjectMirror> curvedMirrorOf(const Scene& scene, const InstanceState& instance) {
  const Mesh& mesh = scene.meshes[instance.mesh];
  const Object& object = scene.objects[instance.object];
  return mesh.curvedMirror ? mirrorOf(object, mesh.parts[0].material) : object.mirror;
}

bool hasCurvedMirrors(const Scene& scene) {
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    bool curved = scene.objects[i].mirror.has_value();
    forEachDrawnMesh(scene, static_cast<int>(i), [&](int mesh) { curved = curved || scene.meshes[mesh].curvedMirror; });
    if (curved) {
      return true;
    }
  }
  return false;
}

}  // namespace speculum
