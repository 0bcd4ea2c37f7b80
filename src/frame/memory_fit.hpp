#pragma once

#include <cstdint>
#include <string>

#include "frame/frame_plan.hpp"

namespace speculum {

// Device memory of a plan's render targets: the main view and the sum of pictures, environment maps, the cached images
// that it reuses, and the most mirror images that are alive at one time, with their depth.
uint64_t targetBytes(const FramePlan& plan, const Settings& settings);
// The part of it that more than one sample a pixel costs.
uint64_t sampleBytes(const FramePlan& plan, const Settings& settings);

// Deferred shading keeps radiance and requests of a pass for at most so many samples at a time: the groups of one
// dispatch, times requestsPerGroup in requests.glsl.
inline constexpr uint64_t mostShadedSamples = 65535ull * 128;
inline constexpr uint64_t bytesPerShadedSample = 8;
inline constexpr uint64_t bytesPerRequest = 4;

struct TargetLimits {
  uint64_t budgetBytes = 0;   // for all render targets together
  int largestSide = 0;        // pixels of a picture, at any resolution
  bool keepsPicture = false;  // the last one stays in memory while a still one is drawn, as in the window
  bool tracesRays = true;     // the device has gl_PrimitiveID in fragment shaders, and the scene fits storage buffers
  bool cpu = false;           // the device is a CPU
};

struct FittedPlan {
  FramePlan plan;
  Settings settings;    // as passed in, or lowered
  std::string message;  // what was lowered and why; empty if nothing was
};

// Calls planFrame with settings lowered until the targets fit the limits. First unchanged images are rendered instead
// of reused, if that needs less memory. Then these are halved step by step: samples of mirror images, samples of the
// main view, resolution of mirror images and environment maps. A plan that still does not fit is returned as it is.
// Traced effects are left out where the device cannot trace. `settings` become pictureSettings() before anything else.
FittedPlan planWithin(const TargetLimits& limits, const Scene& scene, const SceneState& state, const Settings& settings,
                      int width, int height, FrameCache cache = {}, int picture = 0);

// Device memory of the environment maps' targets and of the depth that they share.
uint64_t environmentBytes(const FramePlan& plan);
// Bytes of the shadow maps and their depth.
uint64_t shadowBytes(const FramePlan& plan);

}  // namespace speculum
