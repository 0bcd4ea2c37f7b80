#include "edit/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "edit/transform.hpp"
#include "geometry/convex_mesh.hpp"
#include "geometry/polygon.hpp"

namespace speculum {

namespace {

constexpr size_t mostLines = 4000;
constexpr double lightGap = 5.0;  // pixels between a light and its circle
constexpr int circleSteps = 48;

void add(std::vector<PixelLine>& lines, const std::optional<PixelLine>& line) {
  if (line) {
    lines.push_back(*line);
  }
}

void addEdges(std::span<const glm::dvec2> closed, const PictureView& picture, std::vector<PixelLine>& lines) {
  for (size_t i = 0; i < closed.size(); ++i) {
    add(lines, picture.clipped({closed[i], closed[(i + 1) % closed.size()]}));
  }
}

std::vector<PixelLine> mirrorOutline(const MirrorState& mirror, const PictureView& picture) {
  const auto& clip = picture.view().clip;
  const Polygon polygon =
      clip ? clipPolygon(mirror.polygon, *clip) : Polygon(mirror.polygon.begin(), mirror.polygon.end());
  std::vector<PixelLine> lines;
  for (size_t i = 0; i < polygon.size(); ++i) {
    add(lines, picture.clippedLine(polygon[i], polygon[(i + 1) % polygon.size()]));
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
        add(lines, picture.clippedLine(instance.worldFromMesh.point(at), instance.worldFromMesh.point(other)));
      }
    }
  }
  return lines;
}

std::vector<PixelLine> hullOutline(const InstanceState& instance, const glm::dvec3& half, const PictureView& picture,
                                   std::span<const glm::dvec3> points) {
  std::vector<glm::dvec2> pixels;
  for (const glm::dvec3& point : points) {
    const glm::dvec3 world = instance.worldFromMesh.point(point);
    // A mirror shows only points in front of it.
    if (picture.view().clip && picture.view().clip->distance(world) < 0.0) {
      continue;
    }
    const auto pixel = picture.pixel(world);
    if (!pixel) {
      return boxOutline(instance, half, picture);
    }
    pixels.push_back(*pixel);
  }
  std::vector<PixelLine> lines;
  addEdges(convexHull(std::move(pixels)), picture, lines);
  return lines;
}

// Clips a line to what the mirrors of the picture show.
std::optional<PixelLine> lineInFront(const PictureView& picture, glm::dvec3 a, glm::dvec3 b) {
  if (const auto& clip = picture.view().clip) {
    const double da = clip->distance(a);
    const double db = clip->distance(b);
    if (da < 0.0 && db < 0.0) {
      return std::nullopt;
    }
    if (da < 0.0 || db < 0.0) {
      (da < 0.0 ? a : b) = glm::mix(a, b, da / (da - db));
    }
  }
  return picture.clippedLine(a, b);
}

// Returns the edges where the surface turns away from the eye; nothing if there are too many to draw.
std::optional<std::vector<PixelLine>> silhouette(const InstanceState& instance, const PictureView& picture,
                                                 std::span<const MeshEdge> edges) {
  const Affine& placed = instance.worldFromMesh;
  const glm::dvec3 eye = glm::inverse(placed.linear) * (picture.eye() - placed.translation);
  std::vector<PixelLine> lines;
  for (const MeshEdge& edge : edges) {
    if (edge.outlines(eye)) {
      add(lines, lineInFront(picture, placed.point(edge.a), placed.point(edge.b)));
    }
    if (lines.size() > mostLines) {
      return std::nullopt;
    }
  }
  return lines;
}

std::vector<PixelLine> objectOutline(const InstanceState& instance, const glm::dvec3& half, const PictureView& picture,
                                     const MeshOutline& shape) {
  if (!picture.sees(instance.center, instance.radius)) {
    return {};
  }
  if (auto lines = shape.edges.empty() ? std::nullopt : silhouette(instance, picture, shape.edges)) {
    return *std::move(lines);
  }
  return hullOutline(instance, half, picture, shape.points);
}

constexpr size_t mostPoints = 512;
constexpr size_t mostTriangles = 50'000;

std::vector<MeshEdge> edgesOf(const Mesh& mesh) {
  PointWelder welder;                                                    // normals and textures split vertices
  std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> third;  // points beside an edge
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    std::array<uint32_t, 3> corner{};
    for (size_t k = 0; k < 3; ++k) {
      corner[k] = welder.weld(mesh.vertices[mesh.indices[i + k]].position);
    }
    const bool flat = corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0];
    for (size_t k = 0; !flat && k < 3; ++k) {
      third[std::minmax({corner[k], corner[(k + 1) % 3]})].push_back(corner[(k + 2) % 3]);
    }
  }
  const std::vector<glm::dvec3>& at = welder.points();
  std::vector<MeshEdge> edges;
  edges.reserve(third.size());
  for (const auto& [ends, beside] : third) {
    edges.push_back({at[ends.first], at[ends.second], at[beside.front()], at[beside.back()], beside.size() != 2});
  }
  return edges;
}

// Returns all vertices of a small mesh, else the farthest ones in directions on a Fibonacci lattice: Gonzalez,
// "Measurement of Areas on a Sphere Using Fibonacci and Latitude-Longitude Lattices" (2010).
std::vector<glm::dvec3> outlinePoints(const Mesh& mesh) {
  if (mesh.vertices.size() <= mostPoints) {
    std::vector<glm::dvec3> all(mesh.vertices.size());
    std::ranges::transform(mesh.vertices, all.begin(), &Vertex::position);
    return all;
  }
  std::set<size_t> farthest;
  for (size_t i = 0; i < mostPoints; ++i) {
    const double y = 1.0 - (2.0 * i + 1.0) / mostPoints;
    const double angle = 2.0 * std::numbers::pi * std::numbers::phi * static_cast<double>(i);
    const glm::dvec3 d(std::sqrt(1.0 - y * y) * std::cos(angle), y, std::sqrt(1.0 - y * y) * std::sin(angle));
    const auto most = std::ranges::max_element(mesh.vertices, [&](const Vertex& a, const Vertex& b) {
      return glm::dot(a.position, d) < glm::dot(b.position, d);
    });
    farthest.insert(static_cast<size_t>(most - mesh.vertices.begin()));
  }
  std::vector<glm::dvec3> points;
  for (const size_t i : farthest) {
    points.push_back(mesh.vertices[i].position);
  }
  return points;
}

}  // namespace

std::vector<PixelLine> outlineOf(const Scene& scene, const SceneState& state, const Selection& selection,
                                 const PictureView& picture, const MeshOutline& shape) {
  if (selection.kind == Selection::Kind::mirror) {
    return mirrorOutline(state.mirrors.at(selection.index), picture);
  }
  if (selection.kind == Selection::Kind::light) {
    return lightOutline(state.lights.at(selection.index).position, scene.lights.at(selection.index).radius, picture);
  }
  const InstanceState* instance = instanceOf(state, selection);
  return instance ? objectOutline(*instance, scene.meshes.at(instance->mesh).halfExtent, picture, shape)
                  : std::vector<PixelLine>();
}

bool MeshEdge::outlines(const glm::dvec3& eye) const {
  const glm::dvec3 normal = glm::cross(b - a, eye - a);
  return border || glm::dot(normal, left - a) * glm::dot(normal, right - a) >= 0.0;
}

MeshOutline meshOutline(const Mesh& mesh) {
  const bool small = mesh.indices.size() <= 3 * mostTriangles;
  return {.points = outlinePoints(mesh), .edges = small ? edgesOf(mesh) : std::vector<MeshEdge>()};
}

}  // namespace speculum
