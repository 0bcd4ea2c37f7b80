#include "plan/shadow_map.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <climits>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <numeric>

#include "plan/view.hpp"
#include "scene/material_mirrors.hpp"

namespace speculum {

namespace {

// Width of the smallest window, metres in the plane one metre before the light: smaller ones would show the rounding
// of directions.
constexpr double smallestWindow = 1e-3;

// Factor that widens a face for the test whether a box lies beside it: the edge of a drawn triangle may reach beyond
// its box by a part of a pixel.
constexpr double margin = 1.05;

// Texels of the sides of faces with effects.shadow_map_size = auto.
constexpr int smallestAutomatic = 64;
constexpr int largestAutomatic = 2048;

constexpr FaceWindow nothing{glm::dvec2(1.0), glm::dvec2(-1.0)};

// Returns the part of the face in which the box is seen: nothing if the box lies beyond one of the face's sides, the
// whole face if it reaches behind the light.
FaceWindow windowOf(const Bounds& box, const glm::dvec3& center, const FaceAxes& axes) {
  const glm::dvec3 right = glm::cross(axes.forward, axes.up);
  FaceWindow seen{glm::dvec2(1e300), glm::dvec2(-1e300)};
  bool before = false;
  bool behind = false;
  glm::bvec2 allLow(true);   // all corners lie left of, or above, the face
  glm::bvec2 allHigh(true);  // all corners lie right of, or below, the face
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
    return nothing;
  }
  if (behind) {
    return {glm::dvec2(-1.0), glm::dvec2(1.0)};
  }
  return {glm::max(seen.low, -1.0), glm::min(seen.high, 1.0)};
}

// Moves the window's sides outwards to a grid, so that a window stays the same while something in it moves a little.
FaceWindow onGrid(FaceWindow window) {
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
Projection projectionOf(const FaceWindow& window, int size, double near) {
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

// Says whether all rays from an eye `height` metres above a plane stay on the plane's negative side.
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

// Returns columns and rows of so many faces in their target, which makes the target about a square.
glm::ivec2 gridOf(int faces) {
  const int columns = static_cast<int>(std::ceil(std::sqrt(faces)));
  return {columns, (faces + columns - 1) / std::max(columns, 1)};
}

int slotsOf(std::span<const Cube> maps) {
  int slots = 0;
  for (const Cube& map : maps) {
    slots = std::max(slots, std::ranges::max(map.slots) + 1);
  }
  return slots;
}

class FacePlanner {
 public:
  FacePlanner(const Scene& scene, const SceneState& state, const Settings& settings,
              std::span<const ShadowReader> readers)
      : scene_(scene), state_(state), settings_(settings), readers_(readers), boxes_(boxesOf(scene, state)) {
    for (const ShadowReader& reader : readers) {
      rays_.push_back(cornerRays(reader.readable, *reader.projection));
    }
    if (settings.effects.shadowMapSize == 0) {
      addPoints();
    }
  }

  Pass plan(const glm::dvec3& center, const FaceAxes& axes) const {
    Pass face{.source = PassSource::unread};
    FaceWindow window = nothing;
    for (const Bounds& box : boxes_) {
      if (const FaceWindow seen = windowOf(box, center, axes); !seen.empty()) {
        window = {glm::min(window.low, seen.low), glm::max(window.high, seen.high)};
      }
    }
    // From a light so far away, texels may be larger than casters. Hybrid shadows take rays where there is no face.
    const bool tooNarrow =
        settings_.effects.shadowLookup != ShadowLookup::map && glm::compMax(window.high - window.low) < smallestWindow;
    if (window.empty() || tooNarrow) {
      return face;
    }
    window = onGrid(window);
    const int asked = settings_.effects.shadowMapSize;
    CubeFace cube = faceOf(center, axes, window, asked == 0 ? largestAutomatic : asked);
    face.projection = cube.projection;
    face.view = viewOf(cube);
    const std::array<glm::dvec3, 4> rays = cornerRays(face.view, cube.projection);
    RecycledVector<size_t> near;
    for (size_t i = 0; i < readers_.size(); ++i) {
      if (mayMeet(face.view, rays, readers_[i].readable, rays_[i])) {
        near.push_back(i);
      }
    }
    if (!near.empty()) {
      if (asked == 0) {
        cube = faceOf(center, axes, window, sizeFor(cube, window, near));
      }
      face = planFace(cube, Onlooker::light, scene_, state_, settings_.debug.cullClusters);
      const bool read = std::ranges::any_of(near, [&](size_t i) { return hasReceiver(face, *readers_[i].pass); });
      face.source = read ? PassSource::drawn : PassSource::unread;
    }
    face.window = window;
    return face;
  }

 private:
  CubeFace faceOf(const glm::dvec3& center, const FaceAxes& axes, const FaceWindow& window, int size) const {
    // The near plane is that of a whole face of the cube.
    return {center, axes, projectionOf(window, size, nearOf(state_, Projection())), size};
  }

  // A point of a surface that a reader may draw.
  struct Point {
    glm::dvec3 position;
    double weight;          // pixels that it stands for, up to a factor that the reader's points share
    double pixelsPerMetre;  // across the line of sight
  };

  // Makes the readers' points, which do not depend on the face. All faces visit them, so with more than enough, only
  // each n-th is made.
  void addPoints() {
    constexpr size_t enough = 1 << 18;
    size_t all = 0;
    for (const ShadowReader& reader : readers_) {
      for (const int i : reader.pass->instances) {
        const glm::ivec3 count = pointsOf(boxes_[static_cast<size_t>(i)], reader.readable.eye);
        all += static_cast<size_t>(count.x) * count.y * count.z;
      }
    }
    // Most grids have an even number of points a row, so that an odd step does not stay in one column.
    const int step = static_cast<int>(std::min<size_t>(all / enough, INT_MAX / 2)) | 1;
    int next = 0;
    for (const ShadowReader& reader : readers_) {
      RecycledVector<Point>& points = points_.emplace_back();
      for (const int i : reader.pass->instances) {
        addPoints(boxes_[static_cast<size_t>(i)], reader, step, next, points);
      }
    }
  }

  // Returns the points of the box's grid along each axis: more if the box is large as seen from the eye.
  static glm::ivec3 pointsOf(const Bounds& box, const glm::dvec3& eye) {
    const double distance = glm::length(glm::clamp(eye, box.low, box.high) - eye);
    return glm::ivec3(glm::clamp(glm::ceil(2.0 * (box.high - box.low) / std::max(distance, 1e-9)), 1.0, 8.0));
  }

  // Adds each `step`-th point of the box, from `next` on, that is in the reader's view, with its share of the box's
  // surface. Sets `next` for the box after it.
  static void addPoints(const Bounds& box, const ShadowReader& reader, int step, int& next,
                        RecycledVector<Point>& points) {
    const View& view = reader.readable;
    const double pixels = 0.5 * reader.projection->focal * view.pictureSize.y;  // in the plane at 1 m, a metre
    const glm::ivec3 count = pointsOf(box, view.eye);
    const int all = count.x * count.y * count.z;
    const glm::dvec3 size = box.high - box.low;
    const double area = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x) / all;
    for (; next < all; next += step) {
      const glm::ivec3 place(next / (count.y * count.z), next / count.z % count.y, next % count.z);
      const glm::dvec3 p = box.low + size * (glm::dvec3(place) + 0.5) / glm::dvec3(count);
      const double distance = glm::length(p - view.eye);
      if (distance > 0.0 && std::ranges::all_of(view.cone, [&](const glm::dvec3& normal) {
            return glm::dot(normal, p - view.eye) >= 0.0;
          })) {
        points.push_back({p, area / (distance * distance), pixels / distance});
      }
    }
    next -= all;
  }

  // Returns the size at which the face's texels are about as large as the pixels that look them up: on the mean over
  // the points of these readers before the face, by weight.
  int sizeFor(const CubeFace& face, const FaceWindow& window, std::span<const size_t> readers) const {
    double weights = 0.0;
    double sum = 0.0;
    for (const size_t reader : readers) {
      for (const Point& point : points_[reader]) {
        const double depth = glm::dot(point.position - face.center, face.axes.forward);
        if (depth > 0.0) {
          weights += point.weight;
          sum += point.weight * point.pixelsPerMetre * depth;
        }
      }
    }
    const glm::dvec2 width = window.high - window.low;
    const double texels = weights > 0.0 ? std::max(width.x, width.y) * sum / weights : 0.0;
    const double size = std::min(std::max<double>(smallestAutomatic, texels), 1.0 * largestAutomatic);  // not NaN
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(size)));
  }

  // Says whether the face contains something that the pass draws and that the light may fall on.
  bool hasReceiver(const Pass& face, const Pass& pass) const {
    const RecycledVector<int>& drawn = face.instances;
    return std::ranges::any_of(pass.instances, [&](int i) { return std::ranges::binary_search(drawn, i); }) ||
           std::ranges::any_of(pass.mirrors, [&](const MirrorDraw& draw) {
             const Mirror& mirror = scene_.mirror(static_cast<size_t>(draw.mirror));
             return (draw.back ? mirror.backColor : mirror.baseColor) != glm::dvec3(0.0) &&
                    std::ranges::any_of(face.mirrors, [&](const MirrorDraw& in) { return in.mirror == draw.mirror; });
           });
  }

  const Scene& scene_;
  const SceneState& state_;
  const Settings& settings_;
  std::span<const ShadowReader> readers_;
  RecycledVector<std::array<glm::dvec3, 4>> rays_;  // of the readers
  RecycledVector<RecycledVector<Point>> points_;    // of the readers; none unless sizes are automatic
  RecycledVector<Bounds> boxes_;
};

}  // namespace

bool fitsShadowMaps(const Scene& scene) {
  const size_t lights = shadowLights(scene).size();
  size_t instances = 0;
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    const auto copies = static_cast<size_t>(scene.objects[i].copies.count);
    forEachDrawnMesh(scene, static_cast<int>(i), [&](int /*mesh*/) { instances += copies; });
  }
  return lights <= mostShadowMaps && instances * lights * faceAxes().size() <= mostFaceTests;
}

PlannedCubes shadowMaps(const Scene& scene, const SceneState& state, const Settings& settings,
                        std::span<const ShadowReader> readers) {
  const FacePlanner planner(scene, state, settings, readers);
  const RecycledVector<int> lights = shadowLights(scene);
  PlannedCubes maps;
  for (const int light : lights) {
    // The same point as for rays. From a light in a mirror's plane, rounding would leave gaps in the mirror along the
    // edges of faces, through which light leaks.
    const glm::dvec3 center =
        besideMirrors(state.lights[static_cast<size_t>(light)].position, state.mirrors, state.camera.eye);
    const Cube& map = maps.cubes.emplace_back(
        Cube{.kind = PassKind::shadow,
             .light = light,
             .name = nameOf<RecycledString>("light", scene.lights[static_cast<size_t>(light)].name, light),
             .size = settings.effects.shadowMapSize,
             .center = center});
    for (size_t face = 0; face < map.faces.size(); ++face) {
      Pass& pass = maps.faces.emplace_back(planner.plan(center, faceAxes()[face]));
      pass.id = {.kind = PassKind::shadow, .light = light, .face = static_cast<int>(face)};
    }
  }
  const auto largest = [&](int size, const Pass& face) {
    return face.source == PassSource::unread ? size : std::max(size, face.view.rect.width);
  };
  const int size =
      std::max(std::accumulate(maps.faces.begin(), maps.faces.end(), settings.effects.shadowMapSize, largest),
               smallestAutomatic);
  int slots = 0;
  for (size_t i = 0; i < maps.faces.size(); ++i) {
    Cube& map = maps.cubes[i / maps.cubes[0].faces.size()];
    map.size = size;
    map.slots[i % map.faces.size()] = maps.faces[i].window.empty() ? -1 : slots++;
  }
  const int columns = gridOf(slots).x;
  for (size_t i = 0; i < maps.faces.size(); ++i) {
    const Cube& map = maps.cubes[i / maps.cubes[0].faces.size()];
    if (const int slot = map.slots[i % map.faces.size()]; slot >= 0) {
      maps.faces[i].corner = size * glm::ivec2(slot % columns, slot / columns);
    }
  }
  return maps;
}

std::optional<size_t> onlyShadowFace(const FramePlan& plan) {
  std::optional<size_t> only;
  for (const Pass& pass : plan.passes) {
    const auto face = static_cast<size_t>(pass.id.face);
    if (pass.id.kind != PassKind::shadow || pass.window.empty()) {
      continue;
    }
    if (only.value_or(face) != face) {
      return std::nullopt;
    }
    only = face;
  }
  return only;
}

bool rendersShadows(const FramePlan& plan) {
  return std::ranges::any_of(plan.passes,
                             [](const Pass& pass) { return pass.id.kind == PassKind::shadow && pass.drawn(); });
}

bool hasShadowLayers(const FramePlan& plan) {
  return std::ranges::any_of(plan.cubes, [](const Cube& cube) {
    return std::ranges::any_of(cube.layerContent, [](const auto& content) { return !content.empty(); });
  });
}

int shadowMapSize(const FramePlan& plan) {
  const std::span<const Cube> maps = cubesOf(plan.cubes, PassKind::shadow);
  return maps.empty() ? 0 : maps[0].size;
}

glm::ivec2 shadowExtent(const FramePlan& plan) {
  const std::span<const Cube> maps = cubesOf(plan.cubes, PassKind::shadow);
  return maps.empty() ? glm::ivec2(0) : glm::max(gridOf(slotsOf(maps)) * maps[0].size, 1);
}

}  // namespace speculum
