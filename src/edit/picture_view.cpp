#include "edit/picture_view.hpp"

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

Selection selectionOf(const SceneHit& hit, const TraceWorld& world) {
  switch (hit.kind) {
    case HitKind::object: {
      const InstanceState& instance = world.instances()[hit.index];
      return {Selection::Kind::object, instance.object, instance.copy};
    }
    case HitKind::mirror:
      return mirrorNode(world.scene(), hit.index);
    case HitKind::glyph:
      return {Selection::Kind::light, hit.index};
  }
  return {};
}

// Says whether the plan skipped the mirror at the end of the path, so that it shows no image.
bool isSkipped(const PickLimits& limits, const MirrorPath& path) {
  return std::ranges::any_of(limits.skipped, [&](const SkippedMirror& skip) {
    const bool shown = skip.reason == SkipReason::maxPasses || skip.reason == SkipReason::maxDepth ||
                       skip.reason == SkipReason::minPixels || skip.reason == SkipReason::minThroughput;
    return shown && skip.path == path;
  });
}

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
    return mesh.positions();
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

PictureView::PictureView(const CameraPose& camera, int width, int height)
    : projection_(camera.verticalFov, static_cast<double>(width) / height, camera.near) {
  view_ = mainView(camera, projection_, width, height);
  const glm::dvec2 size = view_.pictureSize;
  shown_ = {{0.0, 0.0}, {0.0, size.y}, size, {size.x, 0.0}};
}

PictureView::PictureView(View view, const Projection& projection) : view_(std::move(view)), projection_(projection) {}

std::optional<PictureView> PictureView::through(const Scene& scene, const SceneState& state,
                                                std::span<const int> path) const {
  PictureView seen = *this;
  for (const int index : path) {
    if (index < 0 || static_cast<size_t>(index) >= state.mirrors.size()) {
      return std::nullopt;
    }
    const MirrorState& mirror = state.mirrors[index];
    Plane plane{mirror.origin, mirror.normal};
    const double height = plane.distance(seen.eye());
    const Polygon visible = visiblePart(seen.view_, mirror.polygon);
    if (visible.empty() || height == 0.0 || (height < 0.0 && !scene.mirror(index).twoSided)) {
      return std::nullopt;
    }
    plane.normal *= height < 0.0 ? -1.0 : 1.0;
    PictureView next(reflectedView(seen.view_, index, plane, visible, view_.rect, view_.pictureSize), projection_);
    for (const glm::dvec4& clip : toClip(seen.view_, projection_, visible)) {
      if (clip.w <= projection_.near) {
        next.shown_ = shown_;
        break;
      }
      next.shown_.push_back(toPixel(clip));
    }
    seen = std::move(next);
  }
  return seen;
}

glm::dvec3 PictureView::forward() const {
  return glm::transpose(view_.worldToView) * glm::dvec3(0.0, 0.0, -1.0);
}

Ray PictureView::ray(const glm::dvec2& pixel) const {
  const glm::dvec2 device = 2.0 * pixel / view_.pictureSize - 1.0;
  const glm::dvec3 direction(device.x * projection_.aspect / projection_.focal, -device.y / projection_.focal, -1.0);
  return {view_.eye, glm::transpose(view_.worldToView) * direction};
}

double PictureView::depth(const glm::dvec3& world) const {
  return -(view_.worldToView * (world - view_.eye)).z;
}

glm::dvec2 PictureView::toPixel(const glm::dvec4& clip) const {
  return 0.5 * (glm::dvec2(clip) / clip.w + 1.0) * view_.pictureSize;
}

std::optional<glm::dvec2> PictureView::pixel(const glm::dvec3& world) const {
  const glm::dvec4 clip = projection_.clip(view_.worldToView * (world - view_.eye));
  return clip.w > projection_.near ? std::optional(toPixel(clip)) : std::nullopt;
}

double PictureView::metresPerPixel(const glm::dvec3& world) const {
  return 2.0 * std::max(depth(world), projection_.near) / (projection_.focal * view_.pictureSize.y);
}

std::optional<PixelLine> PictureView::line(const glm::dvec3& a, const glm::dvec3& b) const {
  const double depthA = depth(a);
  const double depthB = depth(b);
  // Cuts a little beyond the near plane, so that pixel() takes both ends despite rounding.
  const double near = projection_.near * 1.001;
  if (depthA < near && depthB < near) {
    return std::nullopt;
  }
  const auto cut = [&](const glm::dvec3& in, const glm::dvec3& out, double depthIn, double depthOut) {
    return depthOut >= near ? out : glm::mix(in, out, (depthIn - near) / (depthIn - depthOut));
  };
  const auto first = pixel(cut(b, a, depthB, depthA));
  const auto second = pixel(cut(a, b, depthA, depthB));
  return first && second ? std::optional(PixelLine{*first, *second}) : std::nullopt;
}

std::optional<PixelLine> PictureView::clippedLine(const glm::dvec3& a, const glm::dvec3& b) const {
  const auto whole = line(a, b);
  return whole ? clipped(*whole) : std::nullopt;
}

// Clips as in Cyrus, Beck, "Generalized Two- and Three-Dimensional Clipping" (1978), for either winding.
std::optional<PixelLine> PictureView::clipped(const PixelLine& line) const {
  const glm::dvec2 along = line.b - line.a;
  const double winding = twiceArea(shown_) < 0.0 ? -1.0 : 1.0;
  double enter = 0.0;
  double leave = 1.0;
  for (size_t i = 0; i < shown_.size(); ++i) {
    const glm::dvec2 edge = (shown_[(i + 1) % shown_.size()] - shown_[i]) * winding;
    const double inside = cross(edge, line.a - shown_[i]);
    const double slope = cross(edge, along);
    if (slope == 0.0) {
      if (inside < 0.0) {
        return std::nullopt;
      }
    } else if (slope > 0.0) {
      enter = std::max(enter, -inside / slope);
    } else {
      leave = std::min(leave, -inside / slope);
    }
  }
  return enter < leave ? std::optional(PixelLine{line.a + enter * along, line.a + leave * along}) : std::nullopt;
}

std::vector<Picked> Picker::at(const SceneState& state, const PictureView& picture, const glm::dvec2& pixel,
                               const PickLimits& limits) {
  world_.place(state);
  const glm::dvec3& eye = state.camera.eye;
  Ray ray{glm::dvec3(0.0), glm::normalize(picture.ray(pixel).direction)};
  Skip skip;
  std::vector<Picked> found;
  MirrorPath path;
  glm::dvec3 throughput(1.0);
  while (const auto hit = world_.closest(ray, skip, path.empty() ? Onlooker::eye : Onlooker::mirror)) {
    found.push_back({selectionOf(*hit, world_), path, eye + ray.at(hit->t)});
    if (hit->kind != HitKind::mirror) {
      break;
    }
    const Mirror& mirror = world_.scene().mirror(hit->index);
    const MirrorState& placed = world_.mirrors()[hit->index];
    path.push_back(hit->index);
    throughput *= opticsOf(mirror).reflectanceAt(std::abs(glm::dot(placed.normal, ray.direction)));
    const double largest = std::max({throughput.r, throughput.g, throughput.b});
    if (!(hit->mirrorFront || mirror.twoSided) || static_cast<int>(path.size()) > limits.maxDepth || largest == 0.0 ||
        largest < limits.minThroughput || isSkipped(limits, path)) {
      break;
    }
    // The reflected ray starts at the reflected eye and reaches the mirror at the same t, so that it needs no offset
    // off the surface.
    ray = {reflectPoint(ray.origin, {placed.origin, placed.normal}), reflectionLinear(placed.normal) * ray.direction,
           hit->t};
    skip = {.mirror = hit->index};
  }
  std::ranges::reverse(found);
  return found;
}

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
