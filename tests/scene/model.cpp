#include "scene/scene_loader.hpp"
#include "scene/scene_state.hpp"
#include "scene/support.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

namespace fs = std::filesystem;

// A box of 2 x 1 x 0.5 about `center`, all of it times `size`.
std::string box(double size, const glm::dvec3& center = glm::dvec3(0.0)) {
  std::ostringstream obj;
  obj.precision(17);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) ? 1.0 : -1.0, (i & 2) ? 0.5 : -0.5, (i & 4) ? 0.25 : -0.25);
    const glm::dvec3 p = size * (corner + center);
    obj << "v " << p.x << " " << p.y << " " << p.z << "\n";
  }
  return obj.str() + "f 1 2 4 3\nf 5 6 8 7\nf 1 2 6 5\nf 3 4 8 7\nf 1 3 7 5\nf 2 4 8 6\n";
}

TEST(ModelScene, LooksTheSameAtEverySize) {
  const TemporaryFolder folder;
  const Scene one = modelScene(folder.write("one.obj", box(1.0)));
  for (const double size : {1e-3, 0.37, 250.0, 1e6}) {
    const Scene scene = modelScene(folder.write("other.obj", box(size)));
    EXPECT_NEAR(glm::distance(scene.camera.position / size, one.camera.position), 0.0, 1e-9) << size;
    EXPECT_NEAR(glm::distance(scene.camera.target / size, one.camera.target), 0.0, 1e-9) << size;
    EXPECT_NEAR(scene.camera.near / size, one.camera.near, 1e-12) << size;
    ASSERT_EQ(scene.mirrors.size(), 1u);
    EXPECT_NEAR(glm::distance(scene.mirrors[0].polygon[0] / size, one.mirrors[0].polygon[0]), 0.0, 1e-9) << size;
    ASSERT_EQ(scene.lights.size(), 2u);
    // By the inverse square law the light is as bright on each model.
    EXPECT_NEAR(scene.lights[0].intensity / (size * size), one.lights[0].intensity, 1e-9) << size;
    EXPECT_EQ(scene.objects[0].scale, glm::dvec3(1.0)) << "the model keeps its size";
  }
}

TEST(ModelScene, StandsOverItsMirrorWithinThePicture) {
  const TemporaryFolder folder;
  for (const glm::dvec3 center : {glm::dvec3(0.0), glm::dvec3(1000.0, -300.0, 70.0)}) {
    const Scene scene = modelScene(folder.write("box.obj", box(2.0, center)));
    const SceneState state = evaluate(scene, 0.0);
    ASSERT_EQ(state.instances.size(), 1u);
    const Mesh& mesh = scene.meshes[0];
    double lowest = INFINITY;
    for (const Vertex& vertex : mesh.vertices) {
      const glm::dvec3 p = state.instances[0].worldFromMesh.point(vertex.position);
      lowest = std::min(lowest, p.y);
      EXPECT_GT(p.y, 0.0) << "the mirror lies at 0";
      EXPECT_LT(p.y, 2.1 + 1.0) << "and the model right above it";
    }
    EXPECT_LT(lowest, 0.005 * mesh.radius) << "it seems to stand on it";
    EXPECT_EQ(state.mirrors[0].normal, glm::dvec3(0.0, 1.0, 0.0));
    // The bounding sphere within the cone of the vertical field of view.
    const glm::dvec3 seen = state.camera.worldToView * (state.instances[0].center - state.camera.eye);
    const double angle = std::asin(mesh.radius / glm::length(seen)) + std::atan2(std::abs(seen.y), -seen.z);
    EXPECT_LT(angle, 0.5 * state.camera.verticalFov);
    EXPECT_GT(angle, 0.3 * state.camera.verticalFov) << "and not lost in it";
    EXPECT_FALSE(moves(scene));
  }
}

// Brightness of a white ball in the model's place, seen from all around.
TEST(ModelScene, LightLeavesNoSideDark) {
  const TemporaryFolder folder;
  for (const double size : {0.01, 3.0, 700.0}) {
    const Scene scene = modelScene(folder.write("box.obj", box(size, {5.0, size, -2.0})));
    const glm::dvec3 center = evaluate(scene, 0.0).instances.at(0).center;
    const double radius = scene.meshes[0].radius;
    const glm::dvec3 eye = scene.camera.position - scene.camera.target;
    std::vector<double> seen;
    for (int view = 0; view < 16; ++view) {
      const double turn = glm::radians(360.0 / 16 * view);
      const glm::dvec3 towards = glm::normalize(glm::dvec3(std::cos(turn) * eye.x + std::sin(turn) * eye.z, eye.y,
                                                           std::cos(turn) * eye.z - std::sin(turn) * eye.x));
      double light = 0.0;
      double weights = 0.0;
      for (int i = 0; i < 500; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / 500;
        const double around = 2.399963 * i;
        const glm::dvec3 normal(std::sqrt(1.0 - z * z) * glm::dvec2(std::cos(around), std::sin(around)), z);
        const double weight = std::max(0.0, glm::dot(normal, towards));
        double sum = scene.environment.ambient.y;
        for (const PointLight& lamp : scene.lights) {
          const glm::dvec3 ray = lamp.position - center - radius * normal;
          sum += lamp.intensity * std::max(0.0, glm::dot(normal, ray)) * std::pow(glm::length(ray), -3.0) / 3.14159;
        }
        light += weight * sum;
        weights += weight;
      }
      seen.push_back(light / weights);
    }
    EXPECT_GT(std::ranges::min(seen), 0.6 * std::ranges::max(seen)) << size;
  }
}

TEST(ModelScene, LoadingAModelGivesIt) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("Grüße \"x\".obj", box(1.0));
  const Scene scene = loadScene(file);
  EXPECT_EQ(scene.file, file);
  EXPECT_EQ(scene.title, "Grüße \"x\"");
  EXPECT_EQ(scene.objects[0].model, "Grüße \"x\".obj");
  EXPECT_EQ(scene.text, modelScene(file).text);
  const Scene saved = loadScene(folder.write("saved.toml", scene.text));
  EXPECT_TRUE(saved.mirrors == scene.mirrors && saved.camera == scene.camera && saved.lights == scene.lights);
}

TEST(ModelScene, RefusesImpossibleModels) {
  const TemporaryFolder folder;
  const fs::path tiny = folder.write("tiny.obj", box(1e-12));
  const std::string message = messageOf<InputError>([&] { loadScene(tiny); });
  EXPECT_TRUE(startsWith(message, tiny.string() + ":1: model: the model's bounding sphere"));
  const std::string missing = messageOf<InputError>([&] { loadScene(folder / "none.obj"); });
  EXPECT_TRUE(contains(missing, "none.obj:1: file: cannot be read"));
}

constexpr const char* twoModelsText =
    "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\n"
    "[[object]]\nmodel = 'large.obj'\n[[object]]\nmodel = 'small.obj'\n"
    "[[object]]\nmodel = 'large.obj'\n";

fs::path twoModels(const TemporaryFolder& folder) {
  folder.write("large.obj", box(1.0) + repeated("v 0 0 0\n", 100'000));
  folder.write("small.obj", box(1.0));
  return folder.write("scene.toml", twoModelsText);
}

TEST(LoadProgress, RisesFileByFile) {
  const TemporaryFolder folder;
  std::vector<std::pair<std::string, double>> reports;
  loadScene(twoModels(folder),
            [&](const fs::path& file, double done) { reports.emplace_back(file.filename().string(), done); });
  ASSERT_GT(reports.size(), 6u) << "a large model reports more than once";
  EXPECT_EQ(reports.front(), (std::pair<std::string, double>{"large.obj", 0.0}));
  EXPECT_EQ(reports.back().first, "small.obj");
  for (size_t i = 1; i < reports.size(); ++i) {
    EXPECT_GE(reports[i].second, reports[i - 1].second);
    EXPECT_LE(reports[i].second, 1.0);
  }
  EXPECT_GT(reports.back().second, 0.99) << "the large one is nearly all";
}

TEST(LoadProgress, ExceptionsEndTheLoading) {
  struct Stop {};
  const TemporaryFolder folder;
  const fs::path file = twoModels(folder);
  int calls = 0;
  EXPECT_THROW(loadScene(file,
                         [&](const fs::path&, double done) {
                           ++calls;
                           if (done > 0.4) {
                             throw Stop();
                           }
                         }),
               Stop);
  EXPECT_GT(calls, 2);
}

TEST(AddModel, LoadsAFileOnce) {
  const TemporaryFolder folder;
  const fs::path own = folder.write("box.obj", box(1.0));
  Scene scene = modelScene(own);
  EXPECT_EQ(addModel(scene, own.parent_path() / "." / "box.obj"), 0) << "it is there already";
  EXPECT_EQ(addModel(scene, folder.write("triangle.obj", triangleObj)), 1);
  EXPECT_EQ(scene.meshes.size(), 2u);
  const fs::path huge = folder.write("huge.obj", "v 0 0 0\nv 1e200 0 0\nv 0 1e200 0\nf 1 2 3\n");
  for (const fs::path& file : {huge, folder.write("empty.obj", "v 0 0 0\n"), own.parent_path() / "nowhere.obj"}) {
    const std::string error = messageOf<InputError>([&] { addModel(scene, file); });
    EXPECT_TRUE(startsWith(error, file.string() + ":"));
    EXPECT_FALSE(contains(error, "\n"));
    EXPECT_EQ(scene.meshes.size(), 2u);
    EXPECT_TRUE(scene.textures.empty());
  }
}

TEST(MirrorPolygon, IsRefusedAsInAFile) {
  using Polygon = std::vector<glm::dvec3>;
  EXPECT_FALSE(mirrorPolygonProblem(Polygon{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  for (const auto& [polygon, wrong] :
       {std::pair(Polygon{{0, 0, 0}, {1, 0, 0}}, "has fewer than 3 vertices"),
        std::pair(Polygon{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}}, "is not planar"),
        std::pair(Polygon{{0, 0, 0}, {1, 0, 0}, {0.1, 0.1, 0}, {0, 1, 0}}, "is not convex"),
        std::pair(Polygon{{0, 0, 0}, {1, 0, 0}, {2e15, 1, 0}}, "has a vertex that is too far away"),
        std::pair(Polygon(1001, glm::dvec3(0.0)), "has 1001 vertices")}) {
    EXPECT_TRUE(startsWith(mirrorPolygonProblem(polygon).value_or(""), std::string("the polygon ") + wrong + " ("))
        << wrong;
  }
}

}  // namespace
}  // namespace speculum
