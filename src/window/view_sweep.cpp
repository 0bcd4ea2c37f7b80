#include "window/view_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "accuracy/pareto.hpp"
#include "platform/files.hpp"
#include "platform/folders.hpp"
#include "scene/fingerprint.hpp"
#include "session/session_subject.hpp"
#include "window/background_job.hpp"

namespace speculum {

namespace {

// Samples a pixel: enough to rank errors, in a fraction of the time of a report's 256.
constexpr int truthSamples = 64;
constexpr int floorSamples = 81;
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
  base.ui = {};
  base.reflection.updateInterval = base.limit.mostInterval = 1;  // the view stands still
  base.debug.checkFinite = false;                                // the time of the check would be counted
  return base;
}

// Returns the folder in which a view's measurement is kept, so that measuring the view again takes no time. Removes the
// oldest of such folders.
std::filesystem::path storeFolder(Session& session, const SweepRequest& request) {
  namespace fs = std::filesystem;
  constexpr size_t mostViews = 20;
  Fingerprint view;
  Options options = request.options;
  options.time = contentTime(session.scene(), options.time).value_or(0.0);  // content only: `request` has the camera
  view.add(sweepIdentity(session, options));
  view.add(std::as_bytes(std::span(&request.camera.eye, 1)));
  view.add(std::as_bytes(std::span(&request.camera.worldToView, 1)));
  view.add(request.camera.verticalFov);
  const fs::path sweeps = userCacheDir() / "sweeps";
  keepNewest(sweeps, mostViews);
  return sweeps / view.hex();
}

}  // namespace

ViewMeasurement::ViewMeasurement(const SweepRequest& request)
    : request_(request), base_(baseOf(request)), session_(optionsOf(request)) {
  session_.setCamera(request.camera);
}

SweepResults ViewMeasurement::measure(PictureSize size, const Effort& effort, const SweepProgress& progress) {
  if (!progress({"starting", 0.0})) {
    return {};
  }
  session_.resize(size);
  session_.setSettings(base_);
  SceneState state = evaluate(session_.scene(), request_.options.time);
  state.camera = request_.camera;
  SweepPlan plan = viewSweep(sweepContext(session_));
  plan.repeats = effort.rounds;
  SessionSubject subject(session_, request_.options.time);
  SweepStore store(storeFolder(session_, request_));
  const SweepScene scene{.scene = session_.scene(),
                         .stateOf = [&](int) { return state; },
                         .width = size.width,
                         .height = size.height,
                         .truthSamples = effort.samples,
                         .lattice = true,
                         .floorSamples = effort.floorSamples};
  SweepResults results = describeSweep(session_, plan, request_.options.time);
  bool finished = false;
  inBackground([&] { finished = runSweep(plan, base_, scene, subject, store, results, progress); });
  if (finished && session_.device().validationMessages() > 0) {
    throw std::runtime_error("the measurement made validation messages");
  }
  return finished ? results : SweepResults();
}

SizedMs ViewMeasurement::sizedMs(const SweepPoint& point, PictureSize small) {
  const auto [known, isNew] = sizedMs_.try_emplace(point.name);
  if (isNew) {
    const auto time = [&](PictureSize size) {
      session_.resize(size);
      const FrameCost cost = SessionSubject(session_, request_.options.time).cost(settingsWith(base_, point.changes));
      return cost.gpuMs > 0.0 ? cost.gpuMs : cost.frameMs;
    };
    time(small);  // not counted, because it compiles the point's pipelines
    known->second.small = time(small);
    known->second.whole = time(request_.options.size);
  }
  return known->second;
}

SweepResults ViewMeasurement::whole(const SweepProgress& progress) {
  return measure(request_.options.size, {.samples = truthSamples, .floorSamples = floorSamples}, progress);
}

SweepResults ViewMeasurement::rough(int rounds, const SweepProgress& progress) {
  const PictureSize whole = request_.options.size;
  const double scale = std::min(1.0, std::sqrt(roughPixels / (whole.width * whole.height)));
  const PictureSize small{std::max(1, static_cast<int>(whole.width * scale)),
                          std::max(1, static_cast<int>(whole.height * scale))};
  SweepResults results = measure(small, {.samples = roughSamples, .rounds = rounds}, progress);
  if (results.points.empty()) {
    return results;
  }
  const SizedMs base = sizedMs(results.points.front(), small);
  if (!progress({"times", 0.0})) {
    return {};
  }
  enlargeTimes(results, base, sizedMs(*std::ranges::min_element(results.points, {}, costMs), small),
               static_cast<double>(whole.width) * whole.height / (static_cast<double>(small.width) * small.height));
  return progress({"times", 1.0}) ? results : SweepResults();
}

void enlargeTimes(SweepResults& results, const SizedMs& base, const SizedMs& fastest, double pixels) {
  constexpr double leastRatio = 1.2;  // of two times that give a line: noise must not decide the line's slope
  const double proportion = base.whole / base.small;
  const bool line = base.small > leastRatio * fastest.small && base.whole > fastest.whole;
  const double slope = line ? (base.whole - fastest.whole) / (base.small - fastest.small) : proportion;
  const double factor = std::clamp(slope, proportion, std::max(proportion, pixels));
  const double constant = base.whole - factor * base.small;
  for (SweepPoint& point : results.points) {
    for (Spread* spread : {&point.gpuMs, &point.frameMs}) {
      if (spread->repeats == 0) {
        continue;
      }
      for (double* ms : {&spread->median, &spread->minimum, &spread->lowerQuartile, &spread->upperQuartile}) {
        *ms = std::max(*ms, constant + factor * *ms);  // a larger picture takes no less
      }
    }
  }
}

}  // namespace speculum
