#include "app/difference_view.hpp"

#include <cmath>
#include <cstdio>
#include <utility>

#include "accuracy/fingerprint.hpp"
#include "accuracy/heat_map.hpp"

namespace speculum {

namespace {

constexpr std::chrono::milliseconds stillFor{400};  // before tracing begins
constexpr int truthSamples = 16;

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
    comparing_.wait();
    comparing_ = {};
  }
  truth_.reset();
  view_.clear();
  shown_.clear();
  return std::exchange(heatMap_, Image8()).width > 0;
}

void DifferenceView::startTracing(const Look& look) {
  cancelled_ = false;
  traced_ = 0.0;
  TruthRequest request{.width = look.width, .height = look.height, .samples = truthSamples, .noiseFloor = false};
  request.settings = look.settings;
  tracing_ = std::async(std::launch::async, [this, &scene = look.scene, state = look.state, request] {
    return traceGroundTruth(scene, state, request, [this](double fraction) {
      traced_ = fraction;
      return !cancelled_;
    });
  });
}

// True for a new heat map. One of settings that have changed meanwhile is dropped.
bool DifferenceView::collect() {
  if (ready(tracing_)) {
    truth_ = tracing_.get();
  }
  if (!ready(comparing_)) {
    return false;
  }
  Compared compared = comparing_.get();
  heatMap_ = std::move(compared.heatMap);
  metrics_ = compared.metrics;
  return true;
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
  if (!truth_) {
    if (!tracing_.valid() && Clock::now() - still_ > stillFor) {
      startTracing(look);
    }
    return fresh;
  }
  const std::string settings = settingsKey(look.settings);
  if (settings != shown_ && !comparing_.valid()) {
    shown_ = settings;
    comparing_ = std::async(std::launch::async, [this, drawn = picture(), current = look.settings] {
      Plane2d map;
      const ErrorFigures errors = errorsAgainst(*truth_, drawn, current, &map);
      Image8 heat(map.width, map.height);
      for (size_t i = 0; i < map.values.size(); ++i) {
        const glm::dvec3 color = heatColor(map.values[i]);
        for (int channel = 0; channel < 3; ++channel) {
          heat.rgba[4 * i + channel] = static_cast<uint8_t>(std::lround(255.0 * color[channel]));
        }
      }
      return Compared{std::move(heat), errors.whole};
    });
  }
  return fresh;
}

std::string DifferenceView::status() const {
  char text[128];
  if (heatMap_.width > 0) {
    std::snprintf(text, sizeof(text), "mean FLIP %.4f, RMSE %.4f, largest difference %.0f/255%s", metrics_.flip,
                  metrics_.rmse, metrics_.maxDiff, comparing_.valid() ? " (updating)" : "");
    return text;
  }
  if (truth_) {
    return "comparing";
  }
  if (tracing_.valid()) {
    std::snprintf(text, sizeof(text), "tracing the reference: %.0f %%", 100.0 * traced_);
    return text;
  }
  return "waiting for the view to stand still (pause the animation)";
}

}  // namespace speculum
