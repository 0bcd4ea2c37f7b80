#pragma once

#include <cstdint>

#include "plan/frame_plan.hpp"

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

// Device memory of the main view's targets with so many samples a pixel.
uint64_t mainBytes(const FramePlan& plan, int samples);
// Device memory of the environment maps' targets and of the depth that they share.
uint64_t environmentBytes(const FramePlan& plan);
// Bytes of the shadow maps and their depth.
uint64_t shadowBytes(const FramePlan& plan);

}  // namespace speculum
