#include "truth_support.hpp"

#include "image/image.hpp"

namespace speculum::testing_support {

namespace {

constexpr int tolerance = 2;  // in 1/255

void expectTraced(const Image8& actual, const Truth& truth, const std::filesystem::path& file) {
  const std::vector<bool> counts = notBackground(truth.traced);
  const bool holds = difference(actual, truth.picture, tolerance, counts).holds();
  expectAlike(actual, holds ? truth.picture : truth.tracing.nearest(actual), tolerance, "truth_" + file.stem().string(),
              counts);
  expectBackground(actual, truth.picture, truth.traced, file.stem().string());
}

}  // namespace

TraceResult Tracing::result(const glm::dvec2& offset) const {
  SceneState moved = state;
  CameraPose& camera = moved.camera;
  const double tangent = 2.0 * std::tan(0.5 * camera.verticalFov) / options.height;  // of one pixel
  // The tracer turns rays by the transpose, so this moves them by `offset` pixels.
  glm::dmat3 shear(1.0);
  shear[0][2] = -tangent * offset.x;
  shear[1][2] = tangent * offset.y;
  camera.worldToView = shear * camera.worldToView;
  return *RayTracer(scene, moved).render(options);
}

Image8 Tracing::nearest(const Image8& actual) const {
  constexpr double step = 1.0 / 256.0;
  std::vector<uint8_t> low(actual.rgba.size(), 255);
  std::vector<uint8_t> high(actual.rgba.size(), 0);
  for (const double y : {-step, 0.0, step}) {
    for (const double x : {-step, 0.0, step}) {
      const Image8 picture = toDisplay(result({x, y}).image, curve);
      for (size_t i = 0; i < low.size(); ++i) {
        low[i] = std::min(low[i], picture.rgba[i]);
        high[i] = std::max(high[i], picture.rgba[i]);
      }
    }
  }
  Image8 nearest = actual;
  for (size_t i = 0; i < low.size(); ++i) {
    nearest.rgba[i] = std::clamp(actual.rgba[i], low[i], high[i]);
  }
  return nearest;
}

Tracing tracingOf(const std::filesystem::path& file, PictureSize size, int maxDepth, double time) {
  const Scene scene = loadScene(file);
  const Settings settings = settingsOf(scene);
  return {scene,
          evaluate(scene, time),
          {.width = size.width,
           .height = size.height,
           .samples = 1,
           .maxDepth = maxDepth,
           .minThroughput = settings.reflection.minThroughput,
           .clearColor = settings.view.clearColor},
          settings.view.displayCurve()};
}

Truth trace(const std::filesystem::path& file, PictureSize size, int maxDepth, double time) {
  Truth truth{.tracing = tracingOf(file, size, maxDepth, time)};
  truth.traced = truth.tracing.result();
  truth.picture = toDisplay(truth.traced.image, truth.tracing.curve);
  return truth;
}

SettingList truthSettings(int maxDepth) {
  return {{"view.samples", "1"},
          {"reflection.samples", "1"},
          {"reflection.max_depth", std::to_string(maxDepth)},
          {"reflection.max_passes", "100000"},
          {"reflection.min_pixels", "0"},
          {"effects.shadow_lookup", "traced"}};
}

Options truthOptions(const std::filesystem::path& file, PictureSize size, int maxDepth) {
  return headless(file, size, truthSettings(maxDepth));
}

void expectTruth(const std::filesystem::path& file, PictureSize size, int maxDepth, const Truth& truth, double time) {
  expectTraced(draw(truthOptions(file, size, maxDepth), time), truth, file);
}

void expectTruths(const std::vector<std::filesystem::path>& files, PictureSize size, int maxDepth) {
  const Options options = truthOptions(files.front(), size, maxDepth);
  Studio studio(options);
  for (const std::filesystem::path& file : files) {
    expectTruth(studio, file, trace(file, size, maxDepth));
  }
}

void expectTruth(Studio& studio, const std::filesystem::path& file, const Truth& truth, double time) {
  studio.show(loadScene(file));
  studio.time = time;
  expectTraced(studio.fresh(), truth, file);
}

std::vector<bool> notBackground(const TraceResult& traced) {
  std::vector<bool> counts;
  for (const uint8_t background : traced.backgroundMask) {
    counts.push_back(background == 0);
  }
  return counts;
}

void expectBackground(const Image8& picture, const Image8& expected, const TraceResult& traced,
                      const std::string& name) {
  std::vector<bool> counts = notBackground(traced);
  counts.flip();
  EXPECT_FALSE(difference(picture, expected, tolerance, counts).block) << name << ": something covers the background";
}

double share(const std::vector<uint8_t>& values, int atLeast) {
  const auto count = std::ranges::count_if(values, [&](uint8_t v) { return v >= atLeast; });
  return static_cast<double>(count) / static_cast<double>(values.size());
}

}  // namespace speculum::testing_support
