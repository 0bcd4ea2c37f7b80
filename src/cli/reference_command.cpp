#include <spdlog/spdlog.h>

#include <cmath>
#include <set>

#include "cli/commands.hpp"
#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"
#include "platform/process.hpp"
#include "reference/ray_tracer.hpp"
#include "session/output_files.hpp"
#include "session/session.hpp"

namespace speculum {

namespace {

TraceOptions traceOptions(const Options& options, const Settings& settings) {
  return {.width = options.size.width,
          .height = options.size.height,
          .samples = options.referenceSamples,
          .maxDepth = settings.reflection.maxDepth,
          .minThroughput = settings.reflection.minThroughput,
          .clearColor = settings.view.clearColor};
}

// Says once which settings of the command line change nothing, because the tracer always draws the exact picture.
void warnOfUnread(const Options& options) {
  static const std::set<std::string> read{"reflection.max_depth", "reflection.min_throughput", "view.clear_color",
                                          "view.exposure", "view.tone_map"};
  std::set<std::string> unread;
  for (const auto& [key, value] : options.settings) {
    if (!read.contains(key)) {
      unread.insert(key);
    }
  }
  if (!unread.empty()) {
    spdlog::warn("reference does not read {} (only {})", fmt::join(unread, ", "), fmt::join(read, ", "));
  }
}

void checkSamples(int samples) {
  const int side = static_cast<int>(std::lround(std::sqrt(samples)));
  if (side * side != samples) {
    throw UsageError("--samples: " + std::to_string(samples) + " is not a square number (1, 4, 9, 16, 25, 36, 49, 64)");
  }
}

}  // namespace

int runReference(const Options& options) {
  checkSamples(options.referenceSamples);
  warnOfUnread(options);
  const PictureSequence files(options.out, 0);
  requirePlaceFor(files.at(0));
  const LoadedScene loaded = loadSceneWithSettings(options);
  SceneState state = evaluate(loaded.scene, options.time);
  state.camera = cameraOf(options, loaded.scene).value_or(state.camera);
  const RayTracer tracer(loaded.scene, state);
  installInterruptHandler();
  Progress progress("reference", 1.0);
  const std::optional<TraceResult> result =
      tracer.render(traceOptions(options, loaded.settings), [&](double part) { return progress.set(part); });
  if (!result) {
    return 1;
  }
  if (options.out.extension() == ".exr") {
    writeExr(files.at(0), result->image);
  } else {
    writePng(files.at(0), toDisplay(result->image, loaded.settings.view.displayCurve()));
  }
  return 0;
}

}  // namespace speculum
