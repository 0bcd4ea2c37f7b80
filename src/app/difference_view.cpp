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

std::string viewKey(const DifferenceView::Look& look) {
  Fingerprint fingerprint;
  fingerprint.add(look.scene.file.string());
  fingerprint.add(look.width);
  fingerprint.add(look.height);
  if (moves(look.scene)) {
    fingerprint.add(look.state.time);
  }
  addVector(fingerprint, look.state.camera.eye);
  for (int column = 0; column < 3; ++column) {
    addVector(fingerprint, look.state.camera.worldToView[column]);
  }
  if (look.settings.view.clearColor) {
    addVector(fingerprint, *look.settings.view.clearColor);
  }
  return fingerprint.hex();
}

template <typename T>
bool ready(const std::future<T>& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

// A future of std::async waits when it is destroyed.
template <typename T>
void abandon(std::future<T>& future, std::vector<std::future<T>>& abandoned) {
  std::erase_if(abandoned, ready<T>);
  if (future.valid()) {
    abandoned.push_back(std::move(future));
  }
}

}  // namespace

bool DifferenceView::reset() {
  if (control_) {
    control_->cancelled = true;
  }
  abandon(tracing_, abandonedTraces_);
  abandon(comparing_, abandonedComparisons_);
  control_.reset();
  truth_.reset();
  traced_ = 0;
  view_.clear();
  shown_.clear();
  problem_.clear();
  return std::exchange(heatMap_, Image8()).width > 0;
}

void DifferenceView::end() {
  reset();
  abandonedTraces_.clear();
  abandonedComparisons_.clear();
}

void DifferenceView::startTracing(const Look& look) {
  TruthRequest request{.width = look.width, .height = look.height, .samples = references[traced_], .noiseFloor = false};
  request.settings = look.settings;
  control_ = std::make_shared<Control>();
  const auto trace = [control = control_, &scene = look.scene, state = look.state, request] {
    const auto progress = [&](double fraction) {
      control->progress = fraction;
      return !control->cancelled;
    };
    std::optional<GroundTruth> truth = inBackground([&] { return traceGroundTruth(scene, state, request, progress); });
    return truth ? std::make_shared<const GroundTruth>(std::move(*truth)) : nullptr;
  };
  tracing_ = std::async(std::launch::async, trace);
}

void DifferenceView::startComparing(const Look& look, Image8 picture) {
  const auto compare = [truth = truth_, drawn = std::move(picture), settings = look.settings] {
    Plane2d map;
    const ErrorFigures errors = inBackground([&] { return errorsAgainst(*truth, drawn, settings, &map); });
    return Compared{settingsKey(settings), heatColors(map), errors.whole};
  };
  comparing_ = std::async(std::launch::async, compare);
}

// True for a new heat map. One of settings that have changed meanwhile is dropped.
bool DifferenceView::collect() {
  bool fresh = false;
  try {
    if (ready(comparing_)) {
      Compared result = comparing_.get();
      if (result.settings == shown_) {
        heatMap_ = std::move(result.heatMap);
        metrics_ = result.metrics;
        fresh = true;
      }
    }
    // Not while the one before is being compared with.
    if (ready(tracing_) && !comparing_.valid()) {
      truth_ = tracing_.get();
      ++traced_;
      shown_.clear();
    }
  } catch (const std::exception& problem) {
    problem_ = problem.what();
  }
  return fresh;
}

bool DifferenceView::update(const Look& look, const std::function<Image8()>& picture) {
  const std::string view = viewKey(look);
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
  if (traced_ < references.size() && !tracing_.valid() && Clock::now() - still_ > stillFor) {
    startTracing(look);
  }
  const std::string settings = settingsKey(look.settings);
  if (truth_ && settings != shown_ && !comparing_.valid()) {
    shown_ = settings;
    startComparing(look, picture());
  }
  return fresh;
}

bool DifferenceView::working() const {
  return problem_.empty() && (tracing_.valid() || comparing_.valid() || traced_ < references.size());
}

std::string DifferenceView::status() const {
  if (!problem_.empty()) {
    return problem_;
  }
  char text[160];
  if (heatMap_.width > 0) {
    std::snprintf(text, sizeof(text), "mean FLIP %.4f, RMSE %.4f, largest difference %.0f/255%s", metrics_.flip,
                  metrics_.rmse, metrics_.maxDiff,
                  tracing_.valid() || comparing_.valid() ? " (a finer reference is on its way)" : "");
    return text;
  }
  if (tracing_.valid() && !truth_) {
    std::snprintf(text, sizeof(text), "tracing the reference: %.0f %%", 100.0 * control_->progress);
    return text;
  }
  return truth_ ? "comparing" : "waiting for the view to stand still (pause the animation)";
}

}  // namespace speculum
