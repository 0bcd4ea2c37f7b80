#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace speculum {

// Part of RenderDoc's in-application interface that is used, in the layout of RENDERDOC_API_1_1_2 of renderdoc_app.h.
struct RenderDocApi {
  using Unused = void (*)();
  static constexpr int version = 10102;

  std::array<Unused, 11> getApiVersionToUnloadCrashHandler;
  void (*setCaptureFilePathTemplate)(const char* path);  // without number and ending
  Unused getCaptureFilePathTemplate;
  uint32_t (*getNumCaptures)();
  // Fills path and length, with its terminating zero, of those that are not null. Returns 0 for an index too large.
  uint32_t (*getCapture)(uint32_t index, char* path, uint32_t* length, uint64_t* time);
  std::array<Unused, 4> triggerCaptureToSetActiveWindow;
  void (*startFrameCapture)(void* device, void* window);  // null: any
  Unused isFrameCapturing;
  uint32_t (*endFrameCapture)(void* device, void* window);  // 0: failed
  Unused triggerMultiFrameCapture;
};
static_assert(offsetof(RenderDocApi, startFrameCapture) == 19 * sizeof(void*));

// RENDERDOC_GetAPI, which librenderdoc.so exports. Returns 1 on success.
using GetRenderDocApi = int (*)(int version, void** api);

}  // namespace speculum
