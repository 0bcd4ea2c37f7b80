#include "edit/outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "edit/transform.hpp"

namespace speculum {

namespace {

constexpr size_t mostPoints = 512;
constexpr double lightGap = 5.0;  // pixels between a light and its circle
constexpr int circleSteps = 48;

// The convex hull, counter-clockwise: Andrew, "Another Efficient Algorithm for Convex Hulls in Two Dimensions" (1979).
std::vector<glm::dvec2> hullOf(std::vector<glm::dvec2> points) {
  std::sort(points.begin(), points.end(),
            [](const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<glm::dvec2> hull;
  const auto add = [&](const glm::dvec2& p, size_t first) {
    while (hull.size() >= first + 2) {
      const glm::dvec2 a = hull[hull.size() - 1] - hull[hull.size() - 2];
      const glm::dvec2 b = p - hull[hull.size() - 2];
      if (a.x * b.y - a.y * b.x > 0.0) {
        break;
      }
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const glm::dvec2& p : points) {
    add(p, 0);
  }
  const size_t lower = hull.empty() ? 0 : hull.size() - 1;
  for (auto p = points.rbegin(); p != points.rend(); ++p) {
    add(*p, lower);
  }
  return hull;
}

void addEdges(std::span<const glm::dvec2> closed, const PictureView& picture, std::vector<PixelLine>& lines) {
  for (size_t i = 0; i < closed.size(); ++i) {
    if (const auto line = picture.clipped({closed[i], closed[(i + 1) % closed.size()]})) {
      lines.push_back(*line);
    }
  }
}

std::vector<PixelLine> mirrorOutline(const MirrorState& mirror, const PictureView& picture) {
  std::vector<glm::dvec3> polygon = mirror.polygon;
  if (picture.view().clip) {
    polygon = clipPolygon(polygon, *picture.view().clip);
  }
  std::vector<PixelLine> lines;
  for (size_t i = 0; i < polygon.size(); ++i) {
    if (const auto line = picture.line(polygon[i], polygon[(i + 1) % polygon.size()])) {
      lines.push_back(*line);
    }
  }
  return lines;
}

std::vector<PixelLine> lightOutline(const glm::dvec3& position, double radius, const PictureView& picture) {
  std::vector<PixelLine> lines;
  const auto center = picture.pixel(position);
  if (!center || !picture.sees(position, radius)) {
    return lines;
  }
  const double pixels = radius / picture.metresPerPixel(position) + lightGap;
  std::vector<glm::dvec2> circle;
  for (int i = 0; i < circleSteps; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / circleSteps;
    circle.push_back(*center + pixels * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  addEdges(circle, picture, lines);
  return lines;
}

std::vector<PixelLine> boxOutline(const InstanceState& instance, const glm::dvec3& half, const PictureView& picture) {
  std::vector<PixelLine> lines;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z);
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 other = at;
      other[axis] = -other[axis];
      if (at[axis] < 0.0) {
        if (const auto line = picture.line(instance.worldFromMesh.point(at), instance.worldFromMesh.point(other))) {
          lines.push_back(*line);
        }
      }
    }
  }
  return lines;
}

std::vector<PixelLine> objectOutline(const InstanceState& instance, const glm::dvec3& half, const PictureView& picture,
                                     std::span<const glm::dvec3> points) {
  std::vector<PixelLine> lines;
  if (!picture.sees(instance.center, instance.radius)) {
    return lines;
  }
  std::vector<glm::dvec2> pixels;
  for (const glm::dvec3& point : points) {
    const glm::dvec3 world = instance.worldFromMesh.point(point);
    // A mirror shows nothing of what is behind it.
    if (picture.view().clip && picture.view().clip->distance(world) < 0.0) {
      continue;
    }
    const auto pixel = picture.pixel(world);
    if (!pixel) {
      return boxOutline(instance, half, picture);
    }
    pixels.push_back(*pixel);
  }
  addEdges(hullOf(std::move(pixels)), picture, lines);
  return lines;
}

}  // namespace

// Directions on a Fibonacci lattice: Gonzalez, "Measurement of Areas on a Sphere Using Fibonacci and Latitude-Longitude
// Lattices" (2010).
std::vector<glm::dvec3> outlinePoints(const Mesh& mesh) {
  std::vector<glm::dvec3> points;
  if (mesh.vertices.size() <= mostPoints) {
    for (const Vertex& vertex : mesh.vertices) {
      points.push_back(vertex.position);
    }
    return points;
  }
  std::vector<size_t> farthest;
  for (size_t i = 0; i < mostPoints; ++i) {
    const double y = 1.0 - (2.0 * i + 1.0) / mostPoints;
    const double angle = 2.0 * std::numbers::pi * std::numbers::phi * static_cast<double>(i);
    const glm::dvec3 d(std::sqrt(1.0 - y * y) * std::cos(angle), y, std::sqrt(1.0 - y * y) * std::sin(angle));
    const auto most = std::max_element(
        mesh.vertices.begin(), mesh.vertices.end(),
        [&](const Vertex& a, const Vertex& b) { return glm::dot(a.position, d) < glm::dot(b.position, d); });
    farthest.push_back(static_cast<size_t>(most - mesh.vertices.begin()));
  }
  std::sort(farthest.begin(), farthest.end());
  farthest.erase(std::unique(farthest.begin(), farthest.end()), farthest.end());
  for (const size_t i : farthest) {
    points.push_back(mesh.vertices[i].position);
  }
  return points;
}

std::vector<PixelLine> outlineOf(const Scene& scene, const SceneState& state, const Selection& selection,
                                 const PictureView& picture, std::span<const glm::dvec3> points) {
  const auto index = static_cast<size_t>(selection.index);
  if (selection.kind == Selection::Kind::mirror) {
    return mirrorOutline(state.mirrors.at(index), picture);
  }
  if (selection.kind == Selection::Kind::light) {
    return lightOutline(state.lights.at(index).position, scene.lights.at(index).radius, picture);
  }
  const InstanceState* instance = instanceOf(state, selection);
  return instance ? objectOutline(*instance, scene.meshes.at(static_cast<size_t>(instance->mesh)).halfExtent, picture,
                                  points)
                  : std::vector<PixelLine>();
}

}  // namespace speculum
