#include "app/difference_view.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "accuracy/fingerprint.hpp"
#include "accuracy/heat_map.hpp"
#include "app/background_threads.hpp"

namespace speculum {

namespace {

constexpr std::chrono::milliseconds stillFor{400};      // before tracing begins
constexpr std::array<int, 3> references = {4, 16, 64};  // samples a pixel: soon something to see, then better

void addVector(Fingerprint& fingerprint, const glm::dvec3& v) {
  for (int i = 0; i < 3; ++i) {
    fingerprint.add(v[i]);
  }
}

std::string viewKey(const ShownPicture& shown) {
  Fingerprint fingerprint;
  fingerprint.add(shown.scene.file.string());
  fingerprint.add(shown.width);
  fingerprint.add(shown.height);
  if (moves(shown.scene)) {
    fingerprint.add(shown.state.time);
  }
  addVector(fingerprint, shown.state.camera.eye);
  for (int column = 0; column < 3; ++column) {
    addVector(fingerprint, shown.state.camera.worldToView[column]);
  }
  fingerprint.add(shown.state.camera.verticalFov);
  if (shown.settings.view.clearColor) {
    addVector(fingerprint, *shown.settings.view.clearColor);
  }
  return fingerprint.hex();
}

}  // namespace

bool DifferenceView::reset() {
  tracing_.cancel();
  comparing_.cancel();
  truth_.reset();
  traced_ = 0;
  view_.clear();
  compared_.clear();
  problem_.clear();
  return std::exchange(heatMap_, Image8()).width > 0;
}

void DifferenceView::stop() {
  reset();
  tracing_.stop();
  comparing_.stop();
}

void DifferenceView::startTracing(const ShownPicture& shown) {
  TruthRequest request{
      .width = shown.width, .height = shown.height, .samples = references[traced_], .noiseFloor = false};
  request.settings = shown.settings;
  tracing_.start(0.0, [&scene = shown.scene, state = shown.state, request](const auto& report) {
    std::optional<GroundTruth> truth = inBackground([&] { return traceGroundTruth(scene, state, request, report); });
    return truth ? std::make_shared<const GroundTruth>(std::move(*truth)) : Truth();
  });
}

void DifferenceView::startComparing(const ShownPicture& shown, Image8 image) {
  comparing_.start(0.0, [truth = truth_, drawn = std::move(image), settings = shown.settings](const auto&) {
    Plane2d map;
    const ErrorFigures errors = inBackground([&] { return errorsAgainst(*truth, drawn, settings, &map); });
    return Compared{settingsKey(settings), heatColors(map), errors.whole};
  });
}

// True for a new heat map. One of settings that have changed meanwhile is dropped.
bool DifferenceView::collect() {
  bool fresh = false;
  if (std::optional<Compared> result = comparing_.takeResult(); result && result->settings == compared_) {
    heatMap_ = std::move(result->heatMap);
    metrics_ = result->metrics;
    fresh = true;
  }
  // A finer reference waits while the one before is being compared with.
  if (tracing_.hasResult() && !comparing_.busy()) {
    truth_ = *tracing_.takeResult();
    ++traced_;
    compared_.clear();
  }
  for (const std::optional<std::string>& error : {comparing_.takeError(), tracing_.takeError()}) {
    problem_ = error.value_or(problem_);
  }
  return fresh;
}

bool DifferenceView::update(const ShownPicture& shown, const std::function<Image8()>& image) {
  const std::string view = viewKey(shown);
  if (view != view_) {
    const bool cleared = reset();
    view_ = view;
    still_ = Clock::now();
    return cleared;
  }
  const bool fresh = collect();
  if (!problem_.empty()) {
    return fresh;
  }
  if (traced_ < references.size() && !tracing_.busy() && Clock::now() - still_ > stillFor) {
    startTracing(shown);
  }
  const std::string settings = settingsKey(shown.settings);
  if (truth_ && settings != compared_ && !comparing_.busy()) {
    compared_ = settings;
    startComparing(shown, image());
  }
  return fresh;
}

bool DifferenceView::working() const {
  return problem_.empty() && (tracing_.busy() || comparing_.busy() || traced_ < references.size());
}

std::string DifferenceView::status() const {
  if (!problem_.empty()) {
    return problem_;
  }
  char text[160];
  if (heatMap_.width > 0) {
    std::snprintf(text, sizeof(text), "mean FLIP %.4f, RMSE %.4f, largest difference %.0f/255%s", metrics_.flip,
                  metrics_.rmse, metrics_.maxDiff,
                  tracing_.busy() || comparing_.busy() ? " (a finer reference is on its way)" : "");
    return text;
  }
  if (tracing_.busy() && !truth_) {
    std::snprintf(text, sizeof(text), "tracing the reference: %.0f %%", 100.0 * tracing_.progress().value_or(1.0));
    return text;
  }
  return truth_ ? "comparing" : "waiting for the view to stand still (pause the animation)";
}

}  // namespace speculum
