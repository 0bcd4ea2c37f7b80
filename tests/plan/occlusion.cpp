// Mirrors that the plan says are hidden, against rays from the eye to them.
#include "geometry/affine.hpp"
#include "plan/frame_plan.hpp"
#include "plan/occluded_region.hpp"
#include "plan/occluder_shapes.hpp"
#include "plan/support.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;

double volume(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return glm::dot(a, glm::cross(b, c));
}

// Says whether the segment from `eye` to `point` meets the triangle, its border included.
bool meets(const glm::dvec3& eye, const glm::dvec3& point, const std::array<glm::dvec3, 3>& triangle) {
  const glm::dvec3 ray = point - eye;
  const glm::dvec3 a = triangle[0] - eye;
  const glm::dvec3 b = triangle[1] - eye;
  const glm::dvec3 c = triangle[2] - eye;
  const std::array parts{volume(ray, b, c), volume(a, ray, c), volume(a, b, ray)};
  const double rounding = 1e-12 * glm::length(ray) * glm::length(a) * glm::length(b);
  const bool left = std::ranges::all_of(parts, [&](double part) { return part >= -rounding; });
  const bool right = std::ranges::all_of(parts, [&](double part) { return part <= rounding; });
  const double sum = parts[0] + parts[1] + parts[2];
  const double whole = volume(a, b, c);
  return (left || right) && sum != 0.0 && whole / sum > 0.0 && whole / sum < 1.0;
}

// Only mirrors outside the path cover the last one, and only objects that the path's last view shows.
bool isCovered(const Scene& scene, const SceneState& state, const glm::dvec3& eye, const glm::dvec3& point,
               const MirrorPath& path) {
  for (const InstanceState& instance : state.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (mesh.isTransparent() ||
        !sees(path.size() > 1 ? Onlooker::mirror : Onlooker::eye, scene.objects[instance.object].visible)) {
      continue;
    }
    const auto corner = [&](size_t i) { return instance.worldFromMesh.point(mesh.vertices[mesh.indices[i]].position); };
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      if (meets(eye, point, {corner(i), corner(i + 1), corner(i + 2)})) {
        return true;
      }
    }
  }
  for (size_t m = 0; m < state.mirrors.size(); ++m) {
    const std::vector<glm::dvec3>& polygon = state.mirrors[m].polygon;
    const bool inPath = std::ranges::find(path, static_cast<int>(m)) != path.end();
    for (size_t i = 1; !inPath && i + 1 < polygon.size(); ++i) {
      if (meets(eye, point, {polygon[0], polygon[i], polygon[i + 1]})) {
        return true;
      }
    }
  }
  return false;
}

class Occluders : public ::testing::Test {
 protected:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }

  Object place(int mesh) {
    return {.mesh = mesh,
            .position = {uniform(-1, 1), uniform(-1, 1), uniform(-5, -1)},
            .rotation = {uniform(-180, 180), uniform(-180, 180), uniform(-180, 180)},
            .scale = {uniform(0.5, 2), uniform(0.5, 2), uniform(0.5, 2)}};
  }

  // Returns a mirror somewhere beyond an occluder, seen from `eye` in the direction of a point of its surface or beside
  // it.
  Mirror mirrorBehind(const Scene& scene, const SceneState& state, const glm::dvec3& eye) {
    const InstanceState& instance = state.instances[engine_() % state.instances.size()];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::dvec3 a = mesh.vertices[engine_() % mesh.vertices.size()].position;
    const glm::dvec3 b = mesh.vertices[engine_() % mesh.vertices.size()].position;
    const glm::dvec3 target = instance.worldFromMesh.point(glm::mix(a, b, uniform(0, 1)) * uniform(0.2, 1.1));
    const double size = std::exp(uniform(std::log(0.005), std::log(1.0)));
    return wall(eye + (target - eye) * uniform(1.3, 3.0), uniform(-50, 50), {size, size * uniform(0.3, 1)});
  }

  // Random points of the part of a mirror that the view shows, its corners first.
  Polygon pointsOf(const Polygon& polygon) {
    Polygon points = polygon;
    for (int i = 0; i < 24; ++i) {
      glm::dvec3 point(0.0);
      double weights = 0.0;
      for (const glm::dvec3& corner : polygon) {
        const double weight = -std::log(uniform(1e-9, 1));
        point += weight * corner;
        weights += weight;
      }
      points.push_back(point / weights);
    }
    return points;
  }

  // Checks that no mirror is drawn although a single face of an object hides all of it. The slack is ten times that of
  // the plan, so that rounding decides nothing.
  static void checkDrawn(const Scene& scene, const SceneState& state, const FramePlan& plan, const std::string& what) {
    const auto checkPass = [&](const Pass& pass) {
      for (const int i : pass.instances) {
        const InstanceState& instance = state.instances[i];
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (const ConvexFace& face : mesh.faces) {
          FlatOccluder occluder{.slack = 1e-4 * instance.radius};
          for (const glm::dvec3& p : face.corners) {
            occluder.polygon.push_back(instance.worldFromMesh.point(p));
          }
          occluder.plane = {occluder.polygon[0], glm::normalize(newellVector(occluder.polygon))};
          OccludedRegion region;
          const bool hides = hiddenByFace(occluder, pass.view, plan.projection, region);
          for (const MirrorDraw& draw : pass.mirrors) {
            const auto holds = [&](const HalfSpace& half) {
              return std::ranges::all_of(draw.polygon,
                                         [&](const glm::dvec3& p) { return half.at(p - pass.view.eye) > 0.0; });
            };
            EXPECT_FALSE(hides && !mesh.isTransparent() && std::ranges::all_of(region, holds))
                << what << " does not hide mirror " << draw.mirror;
          }
        }
      }
    };
    checkPass(plan.main());
    std::ranges::for_each(plan.drawnMirrors(), checkPass);
  }

  // Plans a scene and checks all mirrors hidden at a depth. Returns their number.
  int check(const Scene& scene, const std::string& what, int depth = 0) {
    const SceneState state = evaluate(scene, 0.0);
    const FramePlan plan = planOf(scene);
    checkDrawn(scene, state, plan, what);
    int hidden = 0;
    for (const SkippedMirror& skipped : plan.skipped) {
      if (skipped.reason != SkipReason::hidden || depthOf(skipped.path) != depth) {
        continue;
      }
      ++hidden;
      together_ += skipped.detail.find(" and ") != std::string::npos;
      const View& view = viewOf(plan, skipped);
      for (const glm::dvec3& p : pointsOf(visiblePart(view, state.mirrors[skipped.path.back()].polygon))) {
        glm::dvec3 begin = view.eye;  // of the ray: in the mirror that shows it
        if (view.clip) {
          const double above = glm::dot(view.clip->normal, p - view.clip->point);
          const double below = glm::dot(view.clip->normal, view.clip->point - view.eye);
          if (above < 1e-6 * below) {
            continue;
          }
          begin += (p - view.eye) * (below / (below + above));
        }
        if (!isCovered(scene, state, begin, p, skipped.path)) {
          ADD_FAILURE() << what << " hides a mirror that is seen";
          break;
        }
      }
    }
    return hidden;
  }

  // Places the shape and six mirrors beyond it, seen from `eye`, in the scene. Returns the number of those hidden.
  int hiddenBehind(const OccluderShape& shape, int objects, Scene scene, const glm::dvec3& eye, int depth) {
    scene.meshes = {meshOf(shape.positions, shape.indices), meshOf(shape.positions, shape.indices)};
    scene.meshes[0].parts[0].material.opacity = opacity_;
    for (int i = 0; i < objects; ++i) {
      scene.objects.push_back(place(i % 2));
      scene.objects.back().visible = visibility_;
    }
    const SceneState placed = evaluate(scene, 0.0);
    for (int i = 0; i < 6; ++i) {
      scene.mirrors.push_back(mirrorBehind(scene, placed, eye));
    }
    return check(scene, shape.name, depth);
  }

  // Returns the view that does not show a mirror.
  static const View& viewOf(const FramePlan& plan, const SkippedMirror& skipped) {
    const MirrorPath path(skipped.path.begin(), skipped.path.end() - 1);
    const auto shows = [&](const Pass& pass) { return pass.view.path == path; };
    const auto pass = std::ranges::find_if(plan.drawnMirrors(), shows);
    return pass == plan.drawnMirrors().end() ? plan.main().view : pass->view;
  }

  double opacity_ = 1.0;  // of the first mesh
  std::mt19937 engine_{17};
  Visibility visibility_ = Visibility::everywhere;  // of the shapes
  int together_ = 0;                                // mirrors that several objects hide
};

TEST_F(Occluders, RandomShapesHideNothingVisible) {
  std::map<std::string, int> hidden;
  for (int round = 0; round < 700; ++round) {
    const OccluderShape shape = randomShape(engine_);
    hidden[shape.name] +=
        hiddenBehind(shape, round % 3 == 0 ? 2 : 1, testing_support::sceneWith({}), glm::dvec3(0.0), 0);
  }
  for (const auto& [name, count] : hidden) {
    RecordProperty("hidden_behind_" + name, count);
    EXPECT_GT(count, 10) << name;
  }
}

// The eye looks into a mirror that shows the shapes, whole or in part: what is behind its plane hides nothing.
TEST_F(Occluders, RandomShapesHideNothingVisibleInMirrors) {
  int hidden = 0;
  for (int round = 0; round < 300; ++round) {
    const double plane = uniform(-3, 4);
    Scene scene = testing_support::sceneWith({wall({0, 0, plane}, 180, {20, 20})});
    scene.camera.position = {0, 0, plane - 4};
    scene.camera.target = {0, 0, plane};
    hidden += hiddenBehind(randomShape(engine_), 2, scene, {0, 0, plane + 4}, 1);
  }
  EXPECT_GT(hidden, 50);
}

// Shapes that the eye does not see hide nothing from it, but do in mirrors; and the other way round.
TEST_F(Occluders, NarrowFacesHideNothing) {
  const Projection projection(1.0, static_cast<double>(width) / height, 0.001);
  const CameraPose pose = lookAt({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 57.0, 0.001);
  View view = mainView(pose, projection, width, height);
  int narrow = 0;
  int wide = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 center(uniform(-2, 2), uniform(-2, 2), uniform(-10, -0.5));
    const glm::dmat3 turn = rotationFromDegrees({uniform(-90, 90), uniform(-180, 180), uniform(-180, 180)});
    const glm::dvec3 x = std::exp(uniform(-3, 0)) * turn[0];
    const glm::dvec3 y = std::exp(uniform(-9, -3)) * turn[1];
    const ConvexFace face(
        {center - x - y, center + x - 0.9 * y, center + 0.8 * x + y, center - x + uniform(0.3, 1) * y});
    view.clip.reset();
    if (uniform(0, 1) < 0.5) {
      view.clip = Plane{center + 0.3 * x, rotationFromDegrees({uniform(0, 90), uniform(0, 180), 0})[2]};
    }
    const Polygon polygon(face.corners.begin(), face.corners.end());
    const Plane plane{polygon[0], glm::normalize(newellVector(polygon))};
    OccludedRegion region;
    const bool hides = hiddenByFace({polygon, plane, 1e-5 * face.radius}, view, projection, region);
    const bool isNarrow = face.width < narrowestFace(view, projection) * (-face.center.z - face.radius);
    EXPECT_FALSE(hides && isNarrow) << i;
    narrow += isNarrow;
    wide += hides;
  }
  EXPECT_GT(narrow, 2000);
  EXPECT_GT(wide, 500);
}

TEST_F(Occluders, UnseenObjectsHideNothing) {
  for (const Visibility visible : {Visibility::eye, Visibility::mirrors}) {
    visibility_ = visible;
    int fromEye = 0;
    int inMirrors = 0;
    for (int round = 0; round < 60; ++round) {
      fromEye += hiddenBehind(randomShape(engine_), 2, testing_support::sceneWith({}), glm::dvec3(0.0), 0);
      Scene scene = testing_support::sceneWith({wall({0, 0, 2}, 180, {20, 20})});
      scene.camera.position = {0, 0, -2};
      scene.camera.target = {0, 0, 2};
      inMirrors += hiddenBehind(randomShape(engine_), 2, scene, {0, 0, 6}, 1);
    }
    EXPECT_GT(visible == Visibility::eye ? fromEye : inMirrors, 20);
  }
}

// One of two shapes is glass.
TEST_F(Occluders, TransparentObjectsHideNothing) {
  opacity_ = 0.5;
  int hidden = 0;
  for (int round = 0; round < 60; ++round) {
    hiddenBehind(randomShape(engine_), 1, testing_support::sceneWith({}), glm::dvec3(0.0), 0);
    hidden += hiddenBehind(randomShape(engine_), 2, testing_support::sceneWith({}), glm::dvec3(0.0), 0);
  }
  EXPECT_GT(hidden, 10) << "the other shape hides mirrors";
}

TEST_F(Occluders, BoxesAndPanesHideNothingVisibleTogether) {
  int hidden = 0;
  for (int round = 0; round < 2000; ++round) {
    Scene scene = testing_support::sceneWith(
        {wall({uniform(-1, 1), uniform(-1, 1), uniform(-8, -2)}, uniform(-60, 60), {1.5, 1})});
    Triangles box;
    box.box(glm::dvec3(-1.0), glm::dvec3(1.0));
    scene.meshes = {meshOf(box.positions, box.indices)};
    for (int i = 0; i < 3; ++i) {
      scene.objects.push_back(place(0));
      scene.objects.back().name = std::to_string(i);
      const double thickness = round % 4 == 0 ? 1e-9 : uniform(0.05, 0.5);
      scene.objects.back().scale = {uniform(0.1, 1.2), uniform(0.1, 1.2), thickness};
    }
    hidden += check(scene, "round " + std::to_string(round));
  }
  EXPECT_GT(hidden, 150);
  EXPECT_GT(together_, 15);
}

}  // namespace
}  // namespace speculum
