#include "scene/trace_world.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace speculum {

namespace {

// Scales the matrix first, because entries from 1e-20 to 1e13 must not leave the range of double.
glm::dmat3 inverseOf(const glm::dmat3& m) {
  const double scale = 1.0 / largestEntry(m);
  return glm::inverse(m * scale) * scale;
}

// Says whether the line of the ray meets a convex polygon.
bool meetsPolygon(const ShearedRay& ray, const std::vector<glm::dvec3>& polygon) {
  bool left = false;
  bool right = false;
  glm::dvec3 a = ray.project(polygon.back());
  for (const glm::dvec3& p : polygon) {
    const glm::dvec3 b = ray.project(p);
    const double side = a.x * b.y - a.y * b.x;
    left = left || side > 0.0;
    right = right || side < 0.0;
    a = b;
  }
  return !(left && right);
}

}  // namespace

TraceWorld::TraceWorld(const Scene& scene) : scene_(&scene), meshes_(scene.meshes.size()) {
  for (const Mesh& mesh : scene.meshes) {
    transparent_.push_back(mesh.isTransparent());
  }
  tbb::parallel_for(size_t{0}, meshes_.size(), [&](size_t i) { meshes_[i] = TriangleMesh(scene.meshes[i]); });
}

void TraceWorld::place(const SceneState& state) {
  const glm::dvec3& eye = eye_ = state.camera.eye;
  instances_ = state.instances;
  mirrors_ = state.mirrors;
  lights_ = state.lights;
  placements_.clear();
  std::vector<Item> items;
  for (size_t i = 0; i < instances_.size(); ++i) {
    Affine& placed = instances_[i].worldFromMesh;
    placed.translation -= eye;
    instances_[i].center -= eye;
    const glm::dmat3 inverse = inverseOf(placed.linear);
    placements_.push_back({inverse, normalMatrix(placed.linear)});
    const bool invertible = std::isfinite(glm::dot(inverse[0] + inverse[1] + inverse[2], glm::dvec3(1.0)));
    if (invertible && !scene_->meshes[instances_[i].mesh].indices.empty()) {
      items.push_back({HitKind::object, static_cast<int>(i)});
    }
  }
  for (size_t i = 0; i < mirrors_.size(); ++i) {
    mirrors_[i].origin -= eye;
    for (glm::dvec3& p : mirrors_[i].polygon) {
      p -= eye;
    }
    for (std::vector<glm::dvec3>& piece : mirrors_[i].pieces) {
      std::ranges::for_each(piece, [&](glm::dvec3& p) { p -= eye; });
    }
    items.push_back({HitKind::mirror, static_cast<int>(i)});
  }
  for (size_t i = 0; i < lights_.size(); ++i) {
    lights_[i].position -= eye;
    if (scene_->lights[i].glow > 0.0) {
      items.push_back({HitKind::glyph, static_cast<int>(i)});
    }
  }
  std::vector<Bounds> boxes;
  for (const Item& item : items) {
    // The margin is for the rounding of rays on their way into mesh space.
    boxes.push_back(boundsOf(item).widened(1e-13));
  }
  bvh_ = Bvh(boxes, 1);
  items_.clear();
  for (const uint32_t i : bvh_.order()) {
    items_.push_back(items[i]);
  }
}

Bounds TraceWorld::boundsOf(const Item& item) const {
  if (item.kind == HitKind::mirror) {
    return Bounds::around(mirrors_[item.index].polygon);
  }
  Bounds box;
  if (item.kind == HitKind::glyph) {
    const double radius = scene_->lights[item.index].radius;
    box.add(lights_[item.index].position - radius);
    box.add(lights_[item.index].position + radius);
  } else {
    const InstanceState& instance = instances_[item.index];
    const Bounds mesh = meshes_[instance.mesh].bounds();
    for (int corner = 0; corner < 8; ++corner) {
      const glm::bvec3 high(corner & 1, corner & 2, corner & 4);
      box.add(instance.worldFromMesh.point(glm::mix(mesh.low, mesh.high, high)));
    }
  }
  return box;
}

Visibility TraceWorld::visibilityOf(const Item& item) const {
  return item.kind == HitKind::object  ? scene_->objects[instances_[item.index].object].visible
         : item.kind == HitKind::glyph ? scene_->lights[item.index].visible
                                       : Visibility::everywhere;
}

Ray TraceWorld::toMesh(const Ray& ray, int instance, double tMax) const {
  const glm::dmat3& linear = placements_[instance].meshFromWorld;
  return {linear * (ray.origin - instances_[instance].worldFromMesh.translation), linear * ray.direction, ray.tMin,
          tMax};
}

bool TraceWorld::skipsMirror(const Skip& skip, int mirror) const {
  const auto sharesPlane = [&](int other) { return other >= 0 && mirrors_[other].plane == mirrors_[mirror].plane; };
  return sharesPlane(skip.mirror) || sharesPlane(skip.secondMirror);
}

bool TraceWorld::covers(const SceneHit& hit, const SceneHit& other) const {
  const auto layer = [&](const SceneHit& h) {
    return h.mirrorFront ? mirrors_[h.index].frontLayer : mirrors_[h.index].backLayer;
  };
  if (hit.kind == HitKind::object && other.kind == HitKind::object) {
    return hit.index < other.index;
  }
  return hit.kind == HitKind::mirror && other.kind == HitKind::mirror && layer(hit) < layer(other);
}

// Uses the distance of the first mirror of a plane for all mirrors of that plane, so that rounding does not order them.
std::optional<double> TraceWorld::meetPolygon(const Ray& ray, const ShearedRay& sheared, int mirror,
                                              double tMax) const {
  const MirrorState& plane = mirrors_[mirrors_[mirror].plane];
  const double t = glm::dot(plane.polygon[0] - ray.origin, plane.normal) / glm::dot(ray.direction, plane.normal);
  if (!(t > ray.tMin && t <= tMax && t < ray.tMax)) {
    return std::nullopt;
  }
  for (size_t i = 0; i < mirrors_[mirror].pieceCount(); ++i) {
    if (meetsPolygon(sheared, mirrors_[mirror].piece(i))) {
      return t;
    }
  }
  return std::nullopt;
}

std::optional<double> TraceWorld::meetMirror(const Ray& ray, int mirror) const {
  return meetPolygon(ray, ShearedRay(ray), mirror, ray.tMax);
}

// Uses the distance between the glyph's centre and the ray: the textbook discriminant cancels for small, distant
// glyphs.
std::optional<double> TraceWorld::meetGlyph(const Ray& ray, int light, double tMax) const {
  const double radius = scene_->lights[light].radius;
  const glm::dvec3 toCenter = lights_[light].position - ray.origin;
  const double length2 = glm::dot(ray.direction, ray.direction);
  const double middle = glm::dot(toCenter, ray.direction) / length2;
  const glm::dvec3 offset = toCenter - middle * ray.direction;
  const double halfChord2 = (radius * radius - glm::dot(offset, offset)) / length2;
  if (halfChord2 < 0.0) {
    return std::nullopt;
  }
  const double halfChord = std::sqrt(halfChord2);
  const double t = middle - halfChord > ray.tMin ? middle - halfChord : middle + halfChord;
  return t > ray.tMin && t < tMax ? std::optional(t) : std::nullopt;
}

std::optional<SceneHit> TraceWorld::meet(const Item& item, const Ray& ray, const ShearedRay& sheared, double tMax,
                                         const Skip& skip) const {
  SceneHit hit{.kind = item.kind, .index = item.index};
  if (item.kind == HitKind::object) {
    const int64_t own = skip.instance == item.index ? int64_t{skip.triangle} : TriangleMesh::noTriangle;
    constexpr double infinity = std::numeric_limits<double>::infinity();  // includes a hit at tMax
    Ray local = toMesh(ray, item.index, std::nextafter(tMax, infinity));
    local.tMin = item.index > skip.passed ? std::nextafter(local.tMin, -infinity) : local.tMin;
    const auto found = meshes_[instances_[item.index].mesh].closest(local, own);
    if (!found) {
      return std::nullopt;
    }
    hit.triangle = found->triangle;
    hit.t = found->t;
    hit.weights = found->weights;
    return hit;
  }
  if (item.kind == HitKind::mirror && skipsMirror(skip, item.index)) {
    return std::nullopt;
  }
  const auto t =
      item.kind == HitKind::mirror ? meetPolygon(ray, sheared, item.index, tMax) : meetGlyph(ray, item.index, tMax);
  if (!t) {
    return std::nullopt;
  }
  hit.t = *t;
  hit.mirrorFront = item.kind == HitKind::mirror && glm::dot(ray.direction, mirrors_[item.index].normal) < 0.0;
  return hit;
}

std::optional<SceneHit> TraceWorld::closest(const Ray& ray, const Skip& skip, Onlooker onlooker) const {
  const ShearedRay sheared(ray);
  std::optional<SceneHit> best;
  bvh_.traverse(ray, [&](uint32_t first, uint32_t count, double& tMax) {
    for (uint32_t i = first; i < first + count; ++i) {
      const bool seen = sees(onlooker, visibilityOf(items_[i]));
      const auto hit = seen ? meet(items_[i], ray, sheared, tMax, skip) : std::nullopt;
      if (hit && (!best || hit->t < best->t || (hit->t == best->t && covers(*hit, *best)))) {
        best = hit;
        tMax = hit->t;
      }
    }
    return false;
  });
  return best;
}

double TraceWorld::transmittance(const Ray& ray, const Skip& skip, bool endsAtLight) const {
  const ShearedRay sheared(ray);
  double passes = 1.0;
  bvh_.traverse(ray, [&](uint32_t first, uint32_t count, double&) {
    for (uint32_t i = first; i < first + count && passes > 0.0; ++i) {
      const auto& [kind, index] = items_[i];
      if (kind == HitKind::object) {
        const int64_t own = skip.instance == index ? int64_t{skip.triangle} : TriangleMesh::noTriangle;
        const Ray local = toMesh(ray, index, ray.tMax);
        meshes_[instances_[index].mesh].visit(local, own, [&](const TriangleHit& met) {
          const SceneHit hit{.kind = kind, .index = index, .triangle = met.triangle, .weights = met.weights};
          passes *= endsAtLight && liesInPlane(ray.at(1.0), hit) ? 1.0 : 1.0 - coverageOf(hit);
          return passes == 0.0;
        });
      } else if (kind == HitKind::mirror && !skipsMirror(skip, index)) {
        passes *= meetPolygon(ray, sheared, index, ray.tMax) ? 0.0 : 1.0;
      }
    }
    return passes == 0.0;
  });
  return passes;
}

bool TraceWorld::liesInPlane(const glm::dvec3& point, const SceneHit& objectHit) const {
  constexpr double rounding = 4e-15;  // of some sums and products
  const InstanceState& state = instances_[objectHit.index];
  const Mesh& mesh = scene_->meshes[state.mesh];
  const uint32_t* corners = &mesh.indices[size_t{objectHit.triangle} * 3];
  const glm::dvec3 a = state.worldFromMesh.point(mesh.vertices[corners[0]].position);
  const glm::dvec3 b = state.worldFromMesh.point(mesh.vertices[corners[1]].position);
  const glm::dvec3 c = state.worldFromMesh.point(mesh.vertices[corners[2]].position);
  const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
  return std::abs(glm::dot(normal, point - a)) <= rounding * (glm::length(eye_) + glm::length(point) + glm::length(a));
}

double TraceWorld::coverageOf(const SceneHit& objectHit) const {
  const InstanceState& instance = instances_[objectHit.index];
  const Mesh& mesh = scene_->meshes[instance.mesh];
  if (!transparent_[instance.mesh] || scene_->objects[instance.object].mirror) {
    return 1.0;
  }
  const Material& material = mesh.parts[partOf(objectHit)].material;
  const uint32_t* corners = &mesh.indices[size_t{objectHit.triangle} * 3];
  double opacity = material.opacity;
  if (material.vertexAlpha) {
    double alpha = 0.0;
    for (int k = 0; k < 3; ++k) {
      alpha += objectHit.weights[k] * mesh.colors[corners[k]].a;
    }
    opacity *= alpha;
  }
  if (material.opacityTexture >= 0) {
    glm::dvec2 uv(0.0);
    for (int k = 0; k < 3; ++k) {
      uv += objectHit.weights[k] * mesh.vertices[corners[k]].uv;
    }
    opacity *= textureAt(scene_->textures[material.opacityTexture], uv, material.clamps).a;
  }
  return material.cutoff < 0.0 ? opacity : opacity >= material.leastOpacity() ? 1.0 : 0.0;
}

uint32_t TraceWorld::partOf(const SceneHit& objectHit) const {
  return meshes_[instances_[objectHit.index].mesh].partOf(objectHit.triangle);
}

}  // namespace speculum
