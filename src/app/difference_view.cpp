#include "app/difference_view.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "accuracy/fingerprint.hpp"
#include "accuracy/heat_map.hpp"
#include "app/background_threads.hpp"

namespace speculum {

namespace {

constexpr std::chrono::milliseconds stillFor{400};  // before tracing begins
constexpr std::array references = {4, 16, 64};      // samples a pixel: soon something to see, then better

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

std::string settingsKey(const Settings& settings) {
  std::string key;
  for (const SettingInfo& info : settingInfos()) {
    key += settingValue(settings, info.key) + "\n";
  }
  return key;
}

DifferenceView::Compared compared(const GroundTruth& truth, const Image8& drawn, const Settings& settings) {
  Plane2d map;
  const ErrorFigures errors = errorsAgainst(truth, drawn, settings, &map);
  Image8 heat(map.width, map.height);
  for (size_t i = 0; i < map.values.size(); ++i) {
    const glm::dvec3 color = heatColor(map.values[i]);
    for (int channel = 0; channel < 3; ++channel) {
      heat.rgba[4 * i + channel] = static_cast<uint8_t>(std::lround(255.0 * color[channel]));
    }
  }
  return {std::move(heat), errors.whole};
}

template <typename T>
bool ready(const std::future<T>& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

bool DifferenceView::reset() {
  cancelled_ = true;
  if (tracing_.valid()) {
    tracing_.wait();
    tracing_ = {};
  }
  if (comparing_.valid()) {
    abandoned_.push_back(std::move(comparing_));
  }
  truth_.reset();
  traced_ = 0;
  view_.clear();
  shown_.clear();
  return std::exchange(heatMap_, Image8()).width > 0;
}

void DifferenceView::startTracing(const Look& look) {
  cancelled_ = false;
  progress_ = 0.0;
  TruthRequest request{.width = look.width, .height = look.height, .samples = references[traced_], .noiseFloor = false};
  request.settings = look.settings;
  tracing_ = std::async(std::launch::async, [this, &scene = look.scene, state = look.state, request] {
    const auto progress = [this](double fraction) {
      progress_ = fraction;
      return !cancelled_;
    };
    return inBackground([&] { return traceGroundTruth(scene, state, request, progress); });
  });
}

// True for a new heat map.
bool DifferenceView::collect() {
  std::erase_if(abandoned_, [](const std::future<Compared>& future) { return ready(future); });
  const bool done = ready(comparing_);
  if (done) {
    Compared result = comparing_.get();
    heatMap_ = std::move(result.heatMap);
    metrics_ = result.metrics;
  }
  // Not while the one before is being compared with.
  if (ready(tracing_) && !comparing_.valid()) {
    truth_ = std::make_shared<const GroundTruth>(tracing_.get().value());
    ++traced_;
    shown_.clear();
  }
  return done;
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
  if (traced_ < references.size() && !tracing_.valid() && Clock::now() - still_ > stillFor) {
    startTracing(look);
  }
  if (!truth_) {
    return fresh;
  }
  const std::string settings = settingsKey(look.settings);
  if (settings != shown_ && !comparing_.valid()) {
    shown_ = settings;
    comparing_ = std::async(std::launch::async, [truth = truth_, drawn = picture(), current = look.settings] {
      return inBackground([&] { return compared(*truth, drawn, current); });
    });
  }
  return fresh;
}

std::string DifferenceView::status() const {
  char text[160];
  if (heatMap_.width > 0) {
    std::snprintf(text, sizeof(text), "mean FLIP %.4f, RMSE %.4f, largest difference %.0f/255%s", metrics_.flip,
                  metrics_.rmse, metrics_.maxDiff,
                  tracing_.valid() || comparing_.valid() ? " (a finer reference is on its way)" : "");
    return text;
  }
  if (truth_) {
    return "comparing";
  }
  if (tracing_.valid()) {
    std::snprintf(text, sizeof(text), "tracing the reference: %.0f %%", 100.0 * progress_);
    return text;
  }
  return "waiting for the view to stand still (pause the animation)";
}

}  // namespace speculum
