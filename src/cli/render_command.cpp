#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>

#include "cli/commands.hpp"
#include "cli/stats.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"
#include "platform/process.hpp"
#include "session/output_files.hpp"
#include "session/session.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

void savePicture(Session& session, const fs::path& file) {
  if (file.extension() == ".exr") {
    writeExr(file, session.radiance());
  } else {
    writePng(file, session.picture());
  }
}

// Part of RenderDoc's in-application interface that is used, in the layout of RENDERDOC_API_1_1_2 of renderdoc_app.h.
struct RenderDocApi {
  using Unused = void (*)();
  static constexpr int version = 10102;

  std::array<Unused, 11> getApiVersionToUnloadCrashHandler;
  void (*setCaptureFilePathTemplate)(const char* path);  // without number and ending
  Unused getCaptureFilePathTemplate;
  uint32_t (*getNumCaptures)();
  // Fills the path, its length with the terminating zero, and the time, unless they are null. Returns 0 for an index
  // too large.
  uint32_t (*getCapture)(uint32_t index, char* path, uint32_t* length, uint64_t* time);
  std::array<Unused, 4> triggerCaptureToSetActiveWindow;
  void (*startFrameCapture)(void* device, void* window);  // null: any
  Unused isFrameCapturing;
  uint32_t (*endFrameCapture)(void* device, void* window);  // 0: failed
  Unused triggerMultiFrameCapture;
};
static_assert(offsetof(RenderDocApi, startFrameCapture) == 19 * sizeof(void*));

// RENDERDOC_GetAPI, which RenderDoc's library exports. Returns 1 on success.
using GetRenderDocApi = int (*)(int version, void** api);

// Returns RenderDoc's interface; null if RenderDoc is not loaded.
const RenderDocApi* loadedApi() {
  const auto getApi = reinterpret_cast<GetRenderDocApi>(loadedFunction(renderDocLibrary, "RENDERDOC_GetAPI"));
  void* api = nullptr;
  return getApi && getApi(RenderDocApi::version, &api) == 1 ? static_cast<const RenderDocApi*>(api) : nullptr;
}

fs::path lastCapture(const RenderDocApi& api) {
  const uint32_t count = api.getNumCaptures();
  uint32_t length = 0;
  if (count == 0 || !api.getCapture(count - 1, nullptr, &length, nullptr)) {
    return {};
  }
  std::string path(length, '\0');
  api.getCapture(count - 1, path.data(), &length, nullptr);
  return path.c_str();
}

// Calls `draw` and writes the Vulkan calls that it makes into a file for RenderDoc. RenderDoc must have been loaded
// when the Vulkan instance was created. Throws std::runtime_error if RenderDoc is not loaded or cannot write the file.
void captureWithRenderDoc(const fs::path& file, const std::function<void()>& draw) {
  const RenderDocApi* api = loadedApi();
  if (!api) {
    throw std::runtime_error(
        "--capture: RenderDoc is not loaded (install it and set ENABLE_VULKAN_RENDERDOC_CAPTURE=1 for the command)");
  }
  // RenderDoc appends its own suffix to the name.
  api->setCaptureFilePathTemplate(wholePath(file).replace_extension().string().c_str());
  api->startFrameCapture(nullptr, nullptr);
  try {
    draw();
  } catch (...) {
    // Ends the capture, which would otherwise go on, and drops its file.
    if (api->endFrameCapture(nullptr, nullptr)) {
      std::error_code ignored;
      fs::remove(lastCapture(*api), ignored);
    }
    throw;
  }
  std::error_code error;
  if (api->endFrameCapture(nullptr, nullptr)) {
    fs::rename(lastCapture(*api), file, error);
  } else {
    error = std::make_error_code(std::errc::io_error);
  }
  if (error) {
    throw std::runtime_error("--capture: RenderDoc could not write " + file.string() + ": " + error.message());
  }
}

}  // namespace

int runRender(const Options& options) {
  const int count = std::max(1, options.frames);
  const PictureSequence files(options.out, options.frames > 0 ? count : 0);
  requirePlaceFor(files.at(0));
  Session session(options);
  if (options.out.extension() != ".exr") {
    session.showOnly();
  }
  session.renderer().setTimerDetail(options.render.stats.empty() ? TimerDetail::frame : TimerDetail::samples);
  installInterruptHandler();
  const int pictures = session.settings().view.accumulate;
  Progress progress("render", count * pictures);
  for (int i = 0; i < count; ++i) {
    const auto advance = [&] {
      const DrawnFrame& frame = session.lastFrame();
      return progress.set(i * pictures + (frame.complete ? pictures : frame.pictures));
    };
    const auto draw = [&] {
      session.draw(options.time + i / options.fps, true, advance);
      session.finish();
    };
    if (options.render.capture && i == 0) {
      captureWithRenderDoc(*options.render.capture, draw);
    } else {
      draw();
    }
    if (!session.lastFrame().complete) {
      return 1;  // interrupted
    }
    savePicture(session, files.at(i));
    if (interruptRequested()) {
      return 1;
    }
  }
  if (!options.render.stats.empty()) {
    writeJson(options.render.stats, frameStats(session));
  }
  return session.exitCode();
}

}  // namespace speculum
