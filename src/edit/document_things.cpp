// The part of the document that adds and removes things.
#include <algorithm>
#include <cmath>
#include <limits>

#include "edit/scene_document.hpp"
#include "edit/transform.hpp"
#include "geometry/affine.hpp"
#include "scene/scene_state.hpp"

namespace speculum {

namespace {

using Kind = Selection::Kind;

// "teapot", "teapot 2", "teapot 3": the first that is free, counting on from the number that `wanted` ends in.
template <typename T>
std::string freeName(const std::string& wanted, const std::vector<T>& things) {
  const auto taken = [&](const std::string& name) {
    return std::any_of(things.begin(), things.end(), [&](const T& thing) { return thing.name == name; });
  };
  if (!taken(wanted)) {
    return wanted;
  }
  const size_t blank = wanted.rfind(' ');
  const std::string last = blank == std::string::npos ? "" : wanted.substr(blank + 1);
  const bool counted = !last.empty() && last.size() < 9 && last.find_first_not_of("0123456789") == std::string::npos;
  const std::string stem = counted ? wanted.substr(0, blank) : wanted;
  for (int number = counted ? std::stoi(last) + 1 : 2;; ++number) {
    if (std::string name = stem + " " + std::to_string(number); !taken(name)) {
      return name;
    }
  }
}

double distanceOf(const glm::dvec3& position, const glm::dvec3& viewer) {
  const double distance = glm::length(viewer - position);
  // A mirror that is small for its distance from the origin is refused.
  return std::max(distance > 0.0 ? distance : 1.0, 1e-8 * glm::length(position));
}

glm::dmat3 linearOf(const Object& object) {
  glm::dmat3 linear = rotationFromDegrees(object.rotation);
  for (int i = 0; i < 3; ++i) {
    linear[i] *= object.scale[i];
  }
  return linear;
}

// Half the extent of the model's box along the world's axes.
glm::dvec3 halfExtent(const Object& object, const Mesh& mesh) {
  const glm::dmat3 linear = linearOf(object);
  return glm::abs(linear[0]) * mesh.halfExtent.x + glm::abs(linear[1]) * mesh.halfExtent.y +
         glm::abs(linear[2]) * mesh.halfExtent.z;
}

// From the first copy to the last, metres of the world.
glm::dvec3 rowOf(const Object& object) {
  return static_cast<double>(object.copies.count - 1) * object.copies.step;
}

template <typename T>
Selection append(std::vector<T>& things, std::vector<int>& origins, T thing, Kind kind) {
  things.push_back(std::move(thing));
  origins.push_back(-1);
  return {.kind = kind, .index = static_cast<int>(things.size()) - 1};
}

template <typename T>
void erase(std::vector<T>& things, std::vector<int>& origins, int index) {
  things.erase(things.begin() + index);
  origins.erase(origins.begin() + index);
}

// Beside itself in its plane: on itself, neither would be in front.
void moveBeside(Mirror& mirror, const MirrorState& state) {
  double low = 0.0;
  double high = 0.0;
  for (const glm::dvec3& vertex : state.polygon) {
    const double x = glm::dot(vertex - state.origin, state.axisX);
    low = std::min(low, x);
    high = std::max(high, x);
  }
  const glm::dvec3 step = 1.1 * (high - low) * state.axisX;
  mirror.position += mirror.polygon.empty() ? step : glm::dvec3(0.0);
  for (glm::dvec3& vertex : mirror.polygon) {
    vertex += step;
  }
}

}  // namespace

Selection SceneDocument::addMirror(const glm::dvec3& position, const glm::dvec3& viewer) {
  const glm::dvec3 toViewer = viewer - position;
  const double distance = distanceOf(position, viewer);
  Mirror mirror{.name = freeName("mirror", scene_.mirrors), .position = position};
  mirror.rotation.y = glm::degrees(std::atan2(toViewer.x, toViewer.z));
  mirror.size = {0.3 * distance, 0.4 * distance};
  return structural("add mirror '" + mirror.name + "'",
                    [&] { return append(scene_.mirrors, origins_.mirrors, mirror, Kind::mirror); });
}

Selection SceneDocument::addLight(const glm::dvec3& position, const glm::dvec3& viewer) {
  const double distance = distanceOf(position, viewer);
  // As bright at the viewer as a light of intensity 1 a metre away.
  const PointLight light{.name = freeName("light", scene_.lights),
                         .position = position,
                         .intensity = distance * distance,
                         .radius = 0.01 * distance};
  return structural("add light '" + light.name + "'",
                    [&] { return append(scene_.lights, origins_.lights, light, Kind::light); });
}

Selection SceneDocument::addObject(int mesh, const glm::dvec3& position) {
  const Mesh& model = scene_.meshes.at(mesh);
  Object object{.mesh = mesh};
  object.name = freeName(model.source.stem().string(), scene_.objects);
  const glm::dvec3 center = linearOf(object) * model.center;
  object.position = position - center + glm::dvec3(0.0, halfExtent(object, model).y, 0.0);
  return structural("add object '" + object.name + "'",
                    [&] { return append(scene_.objects, origins_.objects, object, Kind::object); });
}

Selection SceneDocument::duplicate(const Selection& selection) {
  const std::string label = "duplicate " + describe(scene_, selection);
  const auto named = [](auto thing, const auto& things) {
    thing.name = thing.name.empty() ? "" : freeName(thing.name, things);
    return thing;
  };
  if (selection.kind == Kind::object) {
    Object object = named(scene_.objects.at(selection.index), scene_.objects);
    object.position.x += 2.2 * halfExtent(object, scene_.meshes.at(object.mesh)).x + std::abs(rowOf(object).x);
    return structural(label, [&] { return append(scene_.objects, origins_.objects, object, Kind::object); });
  }
  if (selection.kind == Kind::mirror) {
    Mirror mirror = named(scene_.mirrors.at(selection.index), scene_.mirrors);
    moveBeside(mirror, evaluate(scene_, 0.0).mirrors[selection.index]);
    return structural(label, [&] { return append(scene_.mirrors, origins_.mirrors, mirror, Kind::mirror); });
  }
  if (selection.kind == Kind::light) {
    PointLight light = named(scene_.lights.at(selection.index), scene_.lights);
    const glm::dvec3 step(6.0 * light.radius, 0.0, 0.0);
    light.position += step;
    if (light.orbit) {
      light.orbit->center += step;
    }
    return structural(label, [&] { return append(scene_.lights, origins_.lights, light, Kind::light); });
  }
  return selection;
}

void SceneDocument::remove(const Selection& selection) {
  if (!selection) {
    return;
  }
  const std::string label = "remove " + describe(scene_, selection);
  select(selection);
  structural(label, [&] {
    take(selection);
    return Selection();
  });
}

void SceneDocument::take(const Selection& selection) {
  if (selection.kind == Kind::object) {
    erase(scene_.objects, origins_.objects, selection.index);
  } else if (selection.kind == Kind::mirror) {
    erase(scene_.mirrors, origins_.mirrors, selection.index);
  } else {
    erase(scene_.lights, origins_.lights, selection.index);
  }
}

void SceneDocument::remove(std::span<const Selection> things) {
  std::vector<Selection> fromTheEnd(things.begin(), things.end());
  std::sort(fromTheEnd.begin(), fromTheEnd.end(),
            [](const Selection& a, const Selection& b) { return a.index > b.index; });
  structural("remove " + describe(scene_, things), [&] {
    for (const Selection& thing : fromTheEnd) {
      take(thing);
    }
    return Selection();
  });
}

Selection SceneDocument::appendCopy(const Selection& selection, const glm::dvec3& step) {
  const auto append = [&](auto thing, auto& things, std::vector<int>& origins) {
    thing.name = thing.name.empty() ? "" : freeName(thing.name, things);
    return speculum::append(things, origins, std::move(thing), selection.kind);
  };
  const Thing copy = moved(thingOf(scene_, selection), step, 0.0);
  if (const auto* object = std::get_if<Object>(&copy)) {
    return append(*object, scene_.objects, origins_.objects);
  }
  if (const auto* mirror = std::get_if<Mirror>(&copy)) {
    return append(*mirror, scene_.mirrors, origins_.mirrors);
  }
  PointLight light = std::get<PointLight>(copy);
  if (light.orbit) {
    light.orbit->center += step;
  }
  return append(light, scene_.lights, origins_.lights);
}

std::vector<Selection> SceneDocument::duplicate(std::span<const Selection> things) {
  const SceneState state = evaluate(scene_, 0.0);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (Selection thing : things) {
    thing.copy = 0;
    const double x = pivotOf(scene_, state, thing).x;
    const double reach = reachOf(scene_, state, thing);
    const double row = thing.kind == Kind::object ? rowOf(scene_.objects.at(thing.index)).x : 0.0;
    low = std::min(low, x + std::min(row, 0.0) - reach);
    high = std::max(high, x + std::max(row, 0.0) + reach);
  }
  std::vector<Selection> copies;
  structural("duplicate " + describe(scene_, things), [&] {
    for (const Selection& thing : things) {
      copies.push_back(appendCopy(thing, {1.1 * (high - low), 0.0, 0.0}));
    }
    return copies.front();
  });
  return copies;
}

std::string SceneDocument::addBookmark(Bookmark bookmark) {
  bookmark.name = freeName(bookmark.name.empty() ? "view" : bookmark.name, scene_.bookmarks);
  structural("add bookmark '" + bookmark.name + "'", [&] {
    append(scene_.bookmarks, origins_.bookmarks, bookmark, Kind::none);
    return selection_;
  });
  return bookmark.name;
}

void SceneDocument::removeBookmark(size_t index) {
  structural("remove bookmark '" + scene_.bookmarks.at(index).name + "'", [&] {
    erase(scene_.bookmarks, origins_.bookmarks, static_cast<int>(index));
    return selection_;
  });
}

std::string SceneDocument::renameBookmark(size_t index, const std::string& name) {
  Bookmark& bookmark = scene_.bookmarks.at(index);
  const std::string before = bookmark.name;
  if (name.empty() || name == before) {
    return before;
  }
  const std::string chosen = freeName(name, scene_.bookmarks);
  change("rename bookmark '" + before + "'", {}, [&](Scene& scene) { scene.bookmarks[index].name = chosen; });
  return chosen;
}

}  // namespace speculum
