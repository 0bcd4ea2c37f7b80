#pragma once

#include "picture_support.hpp"
#include "reference/ray_tracer.hpp"
#include "studio.hpp"

// The rasteriser against the ray tracer, one sample each.
namespace speculum::testing_support {

// A scene as the tracer draws it.
struct Tracing {
  Scene scene;
  SceneState state;
  TraceOptions options;
  DisplayCurve curve;

  // Traces the picture, moved by `offset` pixels.
  TraceResult result(const glm::dvec2& offset = {0.0, 0.0}) const;

  // Clamps each channel of `actual` to the range that it has in nine traced pictures, moved by -1/256, 0 or 1/256 pixel
  // each way. Vulkan rounds vertices to a grid of 1/256 pixel and leaves open how, so an edge may be off by that much.
  Image8 nearest(const Image8& actual) const;
};

// Returns a tracing with one sample a pixel and the scene's own settings.
Tracing tracingOf(const std::filesystem::path& file, PictureSize size, int maxDepth, double time = 0.0);

struct Truth {
  Tracing tracing;
  TraceResult traced;
  Image8 picture;
};

Truth trace(const std::filesystem::path& file, PictureSize size, int maxDepth, double time = 0.0);

// Settings under which the renderer draws what trace() traces: one sample, no bound on passes.
SettingList truthSettings(int maxDepth);
Options truthOptions(const std::filesystem::path& file, PictureSize size, int maxDepth);

// Expects every pixel that is not background within 2/255, except one in a thousand, but no 3x3 block of exceptions. If
// there are more exceptions, compares with Tracing::nearest().
void expectTruth(const std::filesystem::path& file, PictureSize size, int maxDepth, const Truth& truth,
                 double time = 0.0);

// expectTruth() for scenes of the same models, drawn on one device.
void expectTruths(const std::vector<std::filesystem::path>& files, PictureSize size, int maxDepth);

// expectTruth() for a scene that a studio of truthOptions() can show.
void expectTruth(Studio& studio, const std::filesystem::path& file, const Truth& truth, double time = 0.0);

// Says of each pixel whether it shows anything but the background.
std::vector<bool> notBackground(const TraceResult& traced);
// Expects no block of wrong pixels where the tracer sees nothing but the background.
void expectBackground(const Image8& picture, const Image8& expected, const TraceResult& traced,
                      const std::string& name);

// Returns the share of the values that are at least `atLeast`.
double share(const std::vector<uint8_t>& values, int atLeast);

}  // namespace speculum::testing_support
