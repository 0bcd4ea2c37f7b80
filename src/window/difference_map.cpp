#include "window/difference_map.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "edit/picture_view.hpp"
#include "platform/text.hpp"

namespace speculum {

constexpr std::chrono::milliseconds stillFor{400};      // time without a change before tracing begins
constexpr std::array<int, 3> references = {4, 16, 64};  // samples a pixel: a quick first result, then better ones

namespace {

// Returns for each mirror the mean error of the pixels that would look at it if nothing stood before it; NaN if there
// are none.
std::vector<double> errorsOfMirrors(const Plane2d& map, const PictureView& picture, const SceneState& state) {
  std::vector<double> errors;
  for (const MirrorState& mirror : state.mirrors) {
    const bool inView = !visiblePart(picture.view(), mirror.polygon).empty();
    const RecycledVector<glm::dvec3> cone = coneThrough(picture.eye(), mirror.polygon);
    double sum = 0.0;
    int count = 0;
    for (size_t i = 0; inView && i < map.values.size(); ++i) {
      const glm::dvec2 pixel(static_cast<double>(i % map.width) + 0.5, static_cast<double>(i / map.width) + 0.5);
      const glm::dvec3 ray = picture.ray(pixel).direction;
      const bool meets = std::ranges::all_of(cone, [&](const glm::dvec3& n) { return glm::dot(n, ray) >= 0.0; });
      sum += meets ? map.values[i] : 0.0;
      count += meets;
    }
    errors.push_back(count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN());
  }
  return errors;
}

}  // namespace

bool DifferenceMap::reset() {
  tracing_.cancel();
  comparing_.cancel();
  truth_.reset();
  traced_ = 0;
  view_.reset();
  compared_.reset();
  problem_.clear();
  return std::exchange(result_, {}).map.width > 0;
}

void DifferenceMap::stop() {
  reset();
  tracing_.stop();
  comparing_.stop();
}

void DifferenceMap::startTracing(const ShownPicture& shown) {
  TruthRequest request{
      .width = shown.width, .height = shown.height, .samples = references[traced_], .lattice = true, .floorSamples = 0};
  request.settings = shown.settings;
  tracing_.start(0.0, [&scene = shown.scene, state = shown.state, request](const auto& report) {
    std::optional<GroundTruth> truth;
    inBackground([&] { truth = traceGroundTruth(scene, state, request, report); });
    return truth ? std::make_shared<const GroundTruth>(std::move(*truth)) : Truth();
  });
}

void DifferenceMap::startComparing(const ShownPicture& shown, Image8 image) {
  comparing_.start(0.0, [truth = truth_, drawn = std::move(image), settings = shown.settings, state = shown.state,
                         pictures = shown.pictures, complete = shown.complete](const auto&) {
    Compared result{.pictures = pictures, .wanted = complete ? pictures : settings.view.accumulate};
    Plane2d& map = result.map;
    inBackground([&] { result.metrics = errorsAgainst(*truth, drawn, settings, &map).whole; });
    result.mirrorErrors = errorsOfMirrors(map, PictureView(state.camera, map.width, map.height), state);
    return result;
  });
}

// Takes finished work. Returns true for a new heat map.
bool DifferenceMap::collect() {
  std::optional<Compared> result = comparing_.takeResult();
  const bool fresh = result.has_value();
  if (fresh) {
    result_ = std::move(*result);
  }
  // A finer reference waits until the comparison with the last one ends.
  if (tracing_.hasResult() && !comparing_.busy()) {
    truth_ = *tracing_.takeResult();
    ++traced_;
    compared_.reset();
  }
  for (const std::optional<std::string>& error : {comparing_.takeError(), tracing_.takeError()}) {
    problem_ = error.value_or(problem_);
  }
  return fresh;
}

bool DifferenceMap::lacksReference() const {
  return traced_ < references.size() && (!view_ || references[traced_] <= view_->samples);
}

bool DifferenceMap::update(const ShownPicture& shown, const std::function<Image8()>& image, int samples) {
  const View view{.file = shown.scene.file,
                  .samples = samples,
                  .width = shown.width,
                  .height = shown.height,
                  .time = contentTime(shown.scene, shown.state.time),
                  .camera = shown.state.camera,
                  .clearColor = shown.settings.view.clearColor};
  if (view != view_) {
    plays_ = view_ && view.time && view.time != view_->time;
    const bool cleared = reset();
    view_ = view;
    still_ = Clock::now();
    return cleared;
  }
  const bool fresh = collect();
  if (!problem_.empty()) {
    return fresh;
  }
  if (lacksReference() && !tracing_.busy() && Clock::now() - still_ > stillFor) {
    startTracing(shown);
  }
  if (const std::pair picture(shown.settings, shown.complete); truth_ && picture != compared_ && !comparing_.busy()) {
    compared_ = picture;
    startComparing(shown, image());
  }
  return fresh;
}

bool DifferenceMap::working() const {
  return problem_.empty() && (tracing_.busy() || comparing_.busy() || lacksReference());
}

std::string DifferenceMap::status() const {
  if (!problem_.empty()) {
    return problem_;
  }
  const auto& [pictures, wanted, map, metrics, mirrorErrors] = result_;
  if (map.width > 0) {
    const std::string count = pictures < wanted ? fmt::format("{} of {}", pictures, wanted) : fmt::format("{}", wanted);
    const std::string shown = wanted == 1 ? "one picture" : fmt::format("the mean of {} pictures", count);
    return fmt::format("Mean FLIP of {}: {}. RMSE {:.4f}, largest difference {:.0f}/255{}", shown,
                       significant(metrics.flip, 3), metrics.rmse, metrics.maxDiff,
                       tracing_.busy() || comparing_.busy() ? " (a finer reference is on its way)" : "");
  }
  if (tracing_.busy() && !truth_) {
    return fmt::format("Tracing the reference: {:.0f} %", 100.0 * tracing_.progress().value_or(1.0));
  }
  return truth_ ? "Comparing"
                : fmt::format("Waiting for the view to stand still{}", plays_ ? " (pause the animation)" : "");
}

}  // namespace speculum
