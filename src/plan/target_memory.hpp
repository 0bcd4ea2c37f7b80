#pragma once

#include <cstddef>
#include <cstdint>

#include "geometry/recycled_memory.hpp"
#include "plan/frame_plan.hpp"

namespace speculum {

// Passes first .. end - 1 of FramePlan::passes.
struct ConcurrentPasses {
  size_t first = 0;
  size_t end = 0;
};

// Cuts the mirror passes that are drawn, in the order of recording, into ranges in which no pass shows the image of
// another, so that a device may overlap them. Each pass of a range has its own depth image; to bound the memory of
// depth images, a range covers no more pixels than a picture at the passes' resolution, unless a single pass does.
RecycledVector<ConcurrentPasses> independentPasses(const FramePlan& plan);

// Returns the passes of a range as indices into FramePlan::passes, largest first. The i-th pass draws with the i-th
// depth image, so that each depth image is as small as it can be.
RecycledVector<size_t> largestFirst(const FramePlan& plan, const ConcurrentPasses& range);

// Bytes of a texel of render targets, of both sums of a mean, and of shadow maps. The systems check that their formats
// have these sizes, since the plan knows no Vulkan.
inline constexpr uint64_t colorBytes = 8;
inline constexpr uint64_t depthBytes = 4;
inline constexpr uint64_t sumBytes = 2 * 16;
inline constexpr uint64_t shadowPlaneBytes = 8;

// Returns the device memory of a plan's render targets, bytes: the main view and the sum of pictures, environment and
// shadow maps, the cached images that the plan reuses, and the most mirror images that are alive at one time, with
// their depth.
uint64_t targetBytes(const FramePlan& plan, const Settings& settings);
// Returns the part of targetBytes() that samples beyond one a pixel cost.
uint64_t sampleBytes(const FramePlan& plan, const Settings& settings);

// Most samples of a pass for which deferred shading keeps radiance and requests at a time: the groups of one dispatch,
// times requestsPerGroup in requests.glsl.
inline constexpr uint64_t mostShadedSamples = 65535ull * 128;
inline constexpr uint64_t bytesPerShadedSample = 8;
inline constexpr uint64_t bytesPerRequest = 4;

// Returns the device memory of the main view's targets with `samples` samples a pixel, bytes.
uint64_t mainBytes(const FramePlan& plan, int samples);
// Returns the device memory of the environment maps' targets and of the depth image that they share, bytes.
uint64_t environmentBytes(const FramePlan& plan);
// Returns the device memory of the shadow maps, their layers and their depth image, bytes.
uint64_t shadowBytes(const FramePlan& plan);

}  // namespace speculum
