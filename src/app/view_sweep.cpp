#include "app/view_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "accuracy/fingerprint.hpp"
#include "app/background_job.hpp"
#include "app/session_subject.hpp"
#include "app/sweep_description.hpp"
#include "platform/folders.hpp"

namespace speculum {

namespace {

// Samples a pixel: enough to rank errors, in a fraction of the time of a report's 64.
constexpr int truthSamples = 16;
constexpr int roughSamples = 4;
constexpr double roughPixels = 160.0 * 90.0;

Options optionsOf(const SweepRequest& request) {
  Options options = request.options;
  options.settings.clear();
  options.sweepResults.clear();
  return options;
}

Settings baseOf(const SweepRequest& request) {
  Settings base = request.base;
  base.quality = {};
  base.reflection.updateInterval = 1;  // the view stands still
  base.debug.checkFinite = false;      // its time would be counted
  return base;
}

double baseMs(const SweepRequest& request) {
  Session session(optionsOf(request));
  session.setCamera(request.camera);
  SessionSubject subject(session, request.time);
  subject.cost(baseOf(request));  // compiles its pipelines
  const FrameCost cost = subject.cost(baseOf(request));
  return cost.gpuMs > 0.0 ? cost.gpuMs : cost.frameMs;
}

void multiply(Spread& spread, double factor) {
  for (double* ms : {&spread.median, &spread.minimum, &spread.lowerQuartile, &spread.upperQuartile}) {
    *ms *= factor;
  }
}

// A view that was measured before is there at once. The oldest views go.
std::filesystem::path storeFolder(Session& session, const SweepRequest& request) {
  namespace fs = std::filesystem;
  constexpr size_t mostViews = 20;
  Fingerprint view;
  view.add(sweepIdentity(session, request.options));
  view.add(std::as_bytes(std::span(&request.camera.eye, 1)));
  view.add(std::as_bytes(std::span(&request.camera.worldToView, 1)));
  view.add(request.camera.verticalFov);
  view.add(request.time);
  const fs::path sweeps = userCacheDir() / "sweeps";
  std::error_code none;
  std::vector<std::pair<fs::file_time_type, fs::path>> known;
  for (const auto& entry : fs::directory_iterator(sweeps, none)) {
    known.emplace_back(entry.last_write_time(none), entry.path());
  }
  std::sort(known.rbegin(), known.rend());
  for (size_t i = mostViews; i < known.size(); ++i) {
    fs::remove_all(known[i].second, none);
  }
  return sweeps / view.hex();
}

SweepResults measure(const SweepRequest& request, int samples, const SweepProgress& progress) {
  const Options options = optionsOf(request);
  const Settings base = baseOf(request);
  Session session(options);
  if (!progress({"starting", 1.0})) {
    return {};
  }
  session.setCamera(request.camera);
  session.setSettings(base);
  SceneState state = evaluate(session.scene(), request.time);
  state.camera = request.camera;
  const SweepPlan plan = viewSweep(sweepContext(session));
  SessionSubject subject(session, request.time);
  SweepStore store(storeFolder(session, request));
  const SweepScene scene{.scene = session.scene(),
                         .state = state,
                         .width = options.size.width,
                         .height = options.size.height,
                         .truthSamples = samples};
  SweepResults results = describeSweep(session, plan, request.time);
  const bool finished = inBackground([&] { return runSweep(plan, base, scene, subject, store, results, progress); });
  if (finished && session.device().validationMessages() > 0) {
    throw std::runtime_error("the measurement made validation messages");
  }
  return finished ? results : SweepResults();
}

}  // namespace

SweepResults measureView(const SweepRequest& request, const SweepProgress& progress) {
  return measure(request, truthSamples, progress);
}

SweepResults measureRoughly(const SweepRequest& request, const SweepProgress& progress) {
  SweepRequest small = request;
  PictureSize& size = small.options.size;
  const double scale = std::min(1.0, std::sqrt(roughPixels / (size.width * size.height)));
  size = {std::max(1, static_cast<int>(size.width * scale)), std::max(1, static_cast<int>(size.height * scale))};
  SweepResults results = measure(small, roughSamples, progress);
  if (!results.points.empty()) {
    const double factor = baseMs(request) / baseMs(small);
    for (SweepPoint& point : results.points) {
      multiply(point.gpuMs, factor);
      multiply(point.frameMs, factor);
    }
  }
  return results;
}

}  // namespace speculum
