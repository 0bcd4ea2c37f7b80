#include "frame/shadow_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "frame/cube_face.hpp"
#include "frame/image_content.hpp"
#include "frame/scene_names.hpp"

namespace speculum {

namespace {

// Width of the smallest window, metres in the plane one metre before the light: smaller ones would show the rounding
// of directions.
constexpr double smallestWindow = 1e-3;

// Widens a face where boxes beside it are told from those in it: the edge of a drawn triangle may reach beyond its box
// by a part of a pixel.
constexpr double margin = 1.05;

struct Window {
  glm::dvec2 low{1.0};
  glm::dvec2 high{-1.0};

  bool empty() const { return low.x >= high.x || low.y >= high.y; }
  void add(const Window& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
};

// Returns the part of the face in which the box is seen: nothing if the box lies beyond one of the face's sides, the
// whole face if it reaches behind the light.
Window windowOf(const Bounds& box, const glm::dvec3& center, const FaceAxes& axes) {
  const glm::dvec3 right = glm::cross(axes.forward, axes.up);
  Window seen{glm::dvec2(1e300), glm::dvec2(-1e300)};
  bool before = false;
  bool behind = false;
  glm::bvec2 allLow(true);   // all corners lie left of, or above, the face
  glm::bvec2 allHigh(true);  // right of it, or below
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p =
        glm::mix(box.low, box.high, glm::bvec3((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0)) - center;
    const double w = glm::dot(p, axes.forward);
    before = before || w > 0.0;
    behind = behind || !(w > 1e-6 * glm::length(p));
    const glm::dvec2 side(glm::dot(p, right), -glm::dot(p, axes.up));
    for (int axis = 0; axis < 2; ++axis) {
      allLow[axis] = allLow[axis] && side[axis] < -margin * w;
      allHigh[axis] = allHigh[axis] && side[axis] > margin * w;
    }
    if (!behind) {
      seen.low = glm::min(seen.low, side / w);
      seen.high = glm::max(seen.high, side / w);
    }
  }
  if (!before || glm::any(allLow) || glm::any(allHigh)) {
    return {};
  }
  if (behind) {
    return {glm::dvec2(-1.0), glm::dvec2(1.0)};
  }
  return {glm::max(seen.low, -1.0), glm::min(seen.high, 1.0)};
}

// Moves the sides outwards to a grid, so that a window stays the same while something in it moves a little.
Window onGrid(Window window) {
  for (int axis = 0; axis < 2; ++axis) {
    const double width = std::max(window.high[axis] - window.low[axis], smallestWindow);
    const double step = std::exp2(std::floor(std::log2(width))) / 8.0;
    window.low[axis] = std::max(std::floor(window.low[axis] / step) * step, -1.0);
    window.high[axis] = std::min(std::ceil(window.high[axis] / step) * step, 1.0);
    if (window.high[axis] - window.low[axis] < smallestWindow) {
      const double middle =
          std::clamp(0.5 * (window.low[axis] + window.high[axis]), smallestWindow - 1.0, 1.0 - smallestWindow);
      window.low[axis] = middle - 0.5 * smallestWindow;
      window.high[axis] = middle + 0.5 * smallestWindow;
    }
  }
  return window;
}

// Returns the projection of an image that shows the window within its border.
Projection projectionOf(const Window& window, int size, double near) {
  const glm::dvec2 scale =
      2.0 / (window.high - window.low) * static_cast<double>(size - 2 * shadowBorder) / static_cast<double>(size);
  Projection projection;
  projection.focal = scale.y;
  projection.aspect = scale.y / scale.x;
  projection.near = near;
  projection.offset = -0.5 * scale * (window.low + window.high);
  return projection;
}

// Returns the world directions from the eye to the corners of the view's rectangle.
std::array<glm::dvec3, 4> cornerRays(const View& view, const Projection& projection) {
  const glm::dmat3 viewToWorld = glm::transpose(view.worldToView);
  std::array<glm::dvec3, 4> rays;
  for (int corner = 0; corner < 4; ++corner) {
    const glm::dvec2 pixel(view.rect.x + (corner & 1) * view.rect.width,
                           view.rect.y + (corner >> 1) * view.rect.height);
    const glm::dvec2 device = 2.0 * pixel / view.pictureSize - 1.0 - projection.offset;
    rays[static_cast<size_t>(corner)] =
        viewToWorld * glm::dvec3(device.x * projection.aspect / projection.focal, -device.y / projection.focal, -1.0);
  }
  return rays;
}

// Says whether all rays from `eye` stay on the plane's negative side.
bool liesBehind(const glm::dvec3& normal, double height, std::span<const glm::dvec3> rays) {
  return height < 0.0 && std::ranges::all_of(rays, [&](const glm::dvec3& ray) { return glm::dot(normal, ray) <= 0.0; });
}

// Says whether the pyramids of two views may meet; false only if a side of one of them separates them.
bool mayMeet(const View& a, std::span<const glm::dvec3> raysOfA, const View& b, std::span<const glm::dvec3> raysOfB) {
  const auto separates = [](const View& sides, const View& other, std::span<const glm::dvec3> rays) {
    return (sides.clip && liesBehind(sides.clip->normal, sides.clip->distance(other.eye), rays)) ||
           std::ranges::any_of(sides.cone, [&](const glm::dvec3& normal) {
             return liesBehind(normal, glm::dot(normal, other.eye - sides.eye), rays);
           });
  };
  return !separates(a, b, raysOfB) && !separates(b, a, raysOfA);
}

// Returns columns and rows of maps in their target, so that it is about a square.
glm::ivec2 gridOf(size_t maps) {
  const int count = static_cast<int>(maps);
  const int columns = static_cast<int>(std::ceil(std::sqrt(2.0 * count / 3.0)));
  return {columns, (count + columns - 1) / columns};
}

class FacePlanner {
 public:
  FacePlanner(const Scene& scene, const SceneState& state, const Settings& settings,
              std::span<const ShadowReader> readers)
      : scene_(scene), state_(state), settings_(settings), readers_(readers), boxes_(boxesOf(scene, state)) {
    for (const ShadowReader& reader : readers) {
      rays_.push_back(cornerRays(reader.readable, *reader.projection));
    }
  }

  ShadowFace plan(const glm::dvec3& center, const FaceAxes& axes) const {
    ShadowFace face;
    Window window;
    for (const Bounds& box : boxes_) {
      if (const Window seen = windowOf(box, center, axes); !seen.empty()) {
        window.add(seen);
      }
    }
    if (window.empty()) {
      return face;
    }
    window = onGrid(window);
    face.low = window.low;
    face.high = window.high;
    const int size = settings_.effects.shadowMapSize;
    face.projection = projectionOf(window, size, nearOf(state_, Projection()));  // of a whole face of the cube
    const CubeFace cube{center, axes, face.projection, size};
    face.pass.view = viewOf(cube);
    const std::array<glm::dvec3, 4> rays = cornerRays(face.pass.view, face.projection);
    RecycledVector<const PlannedPass*> near;
    for (size_t i = 0; i < readers_.size(); ++i) {
      if (mayMeet(face.pass.view, rays, readers_[i].readable, rays_[i])) {
        near.push_back(readers_[i].pass);
      }
    }
    face.inReach = !near.empty();
    if (face.inReach) {
      face.pass = planFace(cube, scene_, state_, settings_.debug.cullClusters);
      face.read = std::ranges::any_of(near, [&](const PlannedPass* pass) { return hasReceiver(face, *pass); });
    }
    return face;
  }

 private:
  // Says whether the face contains something that the pass draws and that the light may fall on.
  bool hasReceiver(const ShadowFace& face, const PlannedPass& pass) const {
    const RecycledVector<int>& drawn = face.pass.instances;
    return std::ranges::any_of(pass.instances, [&](int i) { return std::ranges::binary_search(drawn, i); }) ||
           std::ranges::any_of(pass.mirrors, [&](const MirrorDraw& draw) {
             const Mirror& mirror = scene_.mirrors[static_cast<size_t>(draw.mirror)];
             return (draw.back ? mirror.backColor : mirror.baseColor) != glm::dvec3(0.0) &&
                    std::ranges::any_of(face.pass.mirrors,
                                        [&](const MirrorDraw& in) { return in.mirror == draw.mirror; });
           });
  }

  const Scene& scene_;
  const SceneState& state_;
  const Settings& settings_;
  std::span<const ShadowReader> readers_;
  RecycledVector<std::array<glm::dvec3, 4>> rays_;  // of the readers
  RecycledVector<Bounds> boxes_;
};

// Returns the pass with the casters that stand still, or with the others.
PlannedPass castersOf(PlannedPass pass, bool still, const Scene& scene, const SceneState& state) {
  const auto isOther = [&](int instance) {
    const int object = state.instances[static_cast<size_t>(instance)].object;
    return spins(scene.objects[static_cast<size_t>(object)]) == still;
  };
  std::erase_if(pass.instances, isOther);
  std::erase_if(pass.partial, [&](const PartialInstance& partial) { return isOther(partial.instance); });
  std::erase_if(pass.simplified, [&](const SimplifiedInstance& simplified) { return isOther(simplified.instance); });
  std::erase_if(pass.mirrors, [&](const MirrorDraw& draw) {
    return spins(scene.mirrors[static_cast<size_t>(draw.mirror)]) == still;
  });
  return pass;
}

bool anyFace(std::span<const ShadowMap> maps, const auto& predicate) {
  return std::ranges::any_of(maps, [&](const ShadowMap& map) { return std::ranges::any_of(map.faces, predicate); });
}

bool isEmpty(const PlannedPass& pass) {
  return pass.instances.empty() && pass.mirrors.empty();
}

// Moves the casters that stand still from the face's pass to its layer, unless all of them do or none does.
void divide(ShadowFace& face, const std::optional<ShadowLayer>& before, const Scene& scene, const SceneState& state,
            const SceneChanges& changes) {
  PlannedPass moving = castersOf(face.pass, false, scene, state);
  ShadowLayer layer{.pass = castersOf(face.pass, true, scene, state)};
  if (isEmpty(moving) || isEmpty(layer.pass)) {
    return;
  }
  layer.content = shadowContent(changes, face, layer.pass);
  layer.rendered = !before || before->content != layer.content;
  face.pass = std::move(moving);
  face.layer = std::move(layer);
}

}  // namespace

RecycledVector<ShadowMap> shadowMaps(const Scene& scene, const SceneState& state, const Settings& settings,
                                     std::span<const ShadowReader> readers) {
  const FacePlanner planner(scene, state, settings, readers);
  RecycledVector<ShadowMap> maps;
  for (const int light : shadowLights(scene)) {
    ShadowMap& map = maps.emplace_back();
    map.light = light;
    map.name = nameOf<RecycledString>("light", scene.lights[static_cast<size_t>(light)].name, light);
    map.size = settings.effects.shadowMapSize;
    for (const FaceAxes& axes : faceAxes()) {
      map.faces.push_back(planner.plan(state.lights[static_cast<size_t>(light)].position, axes));
    }
  }
  return maps;
}

void reuseShadowMaps(RecycledVector<ShadowMap>& maps, std::span<const ShadowMap> before, const Settings& settings,
                     const Scene& scene, const SceneState& state, const SceneChanges* changes) {
  constexpr size_t mostCompared = 4'000'000;  // instances of all faces; more would take too much memory
  size_t instances = 0;
  for (const ShadowMap& map : maps) {
    for (const ShadowFace& face : map.faces) {
      instances += face.pass.instances.size();
    }
  }
  const bool compares = changes && instances <= mostCompared;
  const bool skips = compares && settings.reflection.skipUnchanged;
  const bool reuses = std::ranges::equal(
      maps, before, [](const auto& a, const auto& b) { return a.light == b.light && a.size == b.size; });
  uint64_t serial = 0;
  for (const ShadowMap& map : before) {
    serial = std::max(serial, map.serial);
  }
  const uint64_t next = serial + 1;
  for (size_t i = 0; i < maps.size(); ++i) {
    maps[i].serial = reuses ? before[i].serial : next;
    for (size_t f = 0; f < maps[i].faces.size(); ++f) {
      ShadowFace& face = maps[i].faces[f];
      const ShadowFace* old = reuses ? &before[i].faces[f] : nullptr;
      if (face.read) {
        face.content = compares ? shadowContent(*changes, face, face.pass) : RecycledVector<uint64_t>();
        face.rendered = !skips || !old || old->content != face.content;
        maps[i].serial = face.rendered ? next : maps[i].serial;
      } else if (old) {
        face.content = old->content;
      }
      if (!face.rendered && old) {
        face.layer = old->layer;
      } else if (skips && old && !old->content.empty() && !orbits(scene.lights[static_cast<size_t>(maps[i].light)])) {
        divide(face, old->layer, scene, state, *changes);
      }
    }
  }
}

std::string shadowFaceName(const ShadowMap& map, size_t face) {
  return "shadow map of " + std::string(map.name) + " " + faceAxes()[face].name;
}

std::optional<size_t> onlyShadowFace(std::span<const ShadowMap> maps) {
  std::optional<size_t> only;
  for (const ShadowMap& map : maps) {
    for (size_t i = 0; i < map.faces.size(); ++i) {
      const bool empty = map.faces[i].low == map.faces[i].high;
      if (!empty && only.value_or(i) != i) {
        return std::nullopt;
      }
      only = empty ? only : i;
    }
  }
  return only;
}

bool rendersShadows(std::span<const ShadowMap> maps) {
  return anyFace(maps, &ShadowFace::rendered);
}

bool hasShadowLayers(std::span<const ShadowMap> maps) {
  return anyFace(maps, [](const ShadowFace& face) { return face.layer.has_value(); });
}

glm::ivec2 shadowExtent(std::span<const ShadowMap> maps) {
  return maps.empty() ? glm::ivec2(0) : glm::ivec2(3, 2) * gridOf(maps.size()) * maps[0].size;
}

glm::ivec2 shadowCorner(std::span<const ShadowMap> maps, size_t map, size_t face) {
  const int columns = gridOf(maps.size()).x;
  const glm::ivec2 place(static_cast<int>(map) % columns, static_cast<int>(map) / columns);
  const glm::ivec2 within(static_cast<int>(face) % 3, static_cast<int>(face) / 3);
  return maps[map].size * (glm::ivec2(3, 2) * place + within);
}

}  // namespace speculum
