#include "accuracy/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "accuracy/pareto.hpp"
#include "compare/image_metrics.hpp"
#include "compare/picture_agreement.hpp"
#include "scene/fingerprint.hpp"
#include "settings/setting_fields.hpp"

namespace speculum {

namespace {

std::string keyOf(std::initializer_list<std::string_view> parts) {
  Fingerprint fingerprint;
  for (const std::string_view part : parts) {
    fingerprint.add(part);
  }
  return fingerprint.hex();
}

// Returns a key of everything that the reference of a frame and its noise floor depend on.
std::string truthKey(const SweepScene& scene, const Settings& settings, int frame) {
  std::string shown = settingValue(settings, "view.clear_color");
  for (const SettingField& field : settingFields()) {
    if (field.changes == FramePart::display) {
      shown += ";" + settingValue(settings, field.key);
    }
  }
  return keyOf({scene.identity, shown, std::to_string(scene.truth.samples), scene.truth.lattice ? "lattice" : "",
                std::to_string(scene.truth.floorSamples), "truth", std::to_string(frame)});
}

// Returns the mean over the phases of an update interval or over frames. Averages roots of mean squares as squares.
ImageMetrics meanMetrics(const std::vector<ImageMetrics>& all) {
  ImageMetrics mean{.pixels = all.front().pixels};
  const double share = 1.0 / static_cast<double>(all.size());
  for (const ImageMetrics& m : all) {
    mean.rmse += share * m.rmse * m.rmse;
    mean.relativeRmse += share * m.relativeRmse * m.relativeRmse;
    mean.psnr += share * std::pow(10.0, -0.1 * m.psnr);
    mean.ssim += share * m.ssim;
    mean.flip += share * m.flip;
    mean.maxDiff = std::max(mean.maxDiff, m.maxDiff);
    mean.p99Diff += share * m.p99Diff;
    mean.pixelsOver += m.pixelsOver;
  }
  mean.rmse = std::sqrt(mean.rmse);
  mean.relativeRmse = std::sqrt(mean.relativeRmse);
  mean.psnr = -10.0 * std::log10(mean.psnr);
  mean.pixelsOver = std::llround(share * static_cast<double>(mean.pixelsOver));
  return mean;
}

class Sweep {
 public:
  Sweep(const SweepPlan& plan, const Settings& base, const SweepScene& scene, SweepSubject& subject, SweepStore& store,
        const SweepProgress& progress)
      : plan_(plan), base_(base), scene_(scene), subject_(subject), store_(store), progress_(progress) {
    for (const SweepConfiguration& configuration : plan.configurations) {
      settings_.push_back(settingsWith(base, configuration.changes));
      keys_.push_back(keyOf({scene.identity, settingsKey(settings_.back())}));
    }
  }

  bool run() { return trace() && compare() && time(); }

  void fill(SweepResults& results) {
    results.width = scene_.truth.width;
    results.height = scene_.truth.height;
    results.truthMs = 0.0;
    for (const GroundTruth& truth : truths_) {
      results.truthMs += truth.ms / static_cast<double>(truths_.size());
    }
    results.truthThreads = truths_.back().threads;
    results.truthSamples = scene_.truth.samples;
    results.floor = floor();
    results.points.clear();
    results.leftOut = std::ssize(keys_) - std::ssize(kept_);
    for (const size_t i : kept_) {
      const Measurement& measurement = store_.at(keys_[i]);
      results.points.push_back({.name = plan_.configurations[i].name,
                                .changes = plan_.configurations[i].changes,
                                .whole = measurement.errors->whole,
                                .mirrors = measurement.errors->mirrors,
                                .flicker = measurement.errors->flicker,
                                .gpuMs = spreadOf(measurement.gpuMs),
                                .cpuMs = spreadOf(measurement.cpuMs),
                                .frameMs = spreadOf(measurement.frameMs),
                                .picture = measurement.picture,
                                .heatMap = measurement.heatMap,
                                .frames = measurement.frames});
    }
    const bool stamped =
        std::ranges::all_of(results.points, [](const SweepPoint& point) { return point.gpuMs.median > 0.0; });
    if (!stamped) {
      for (SweepPoint& point : results.points) {
        point.gpuMs = {};
      }
    }
    for (const int index : paretoFront(results.points)) {
      results.points[index].onFront = true;
    }
    results.series = plan_.series;
    for (SweepSeries& series : results.series) {
      std::ranges::transform(series.points, series.points.begin(), [&](int i) { return pointOf_[i]; });
    }
    const auto shown = [&](const GroundTruth& truth) { return toDisplay(truth.image, base_.view.displayCurve()); };
    results.truthPicture = store_.keepPicture("truth.png", shown(truths_.back()));
    std::vector<Image8> frames;
    for (int i = 0; i < keptFrames(); ++i) {
      frames.push_back(shown(truths_[i]));
    }
    results.truthFrames = keepFrames("truth", frames);
  }

 private:
  bool trace() {
    TruthRequest request = scene_.truth;
    request.settings = base_;
    for (int frame = 0; frame < scene_.frames; ++frame) {
      const auto progress = [&](double part) { return report("reference", (frame + part) / scene_.frames); };
      const std::string key = truthKey(scene_, base_, frame);
      std::optional<GroundTruth> truth = store_.truth(key);
      if (!truth) {
        truth = traceGroundTruth(scene_.scene, scene_.stateOf(frame), request, progress);
        if (!truth) {
          return false;
        }
        store_.keepTruth(key, *truth);
      }
      truths_.push_back(std::move(*truth));
      if (!progress(1.0)) {
        return false;
      }
    }
    return true;
  }

  bool moves() const { return scene_.frames > 1; }
  int keptFrames() const { return moves() ? std::min(scene_.frames, mostFramesKept) : 0; }

  // Keeps the first of the frames. Returns the names of their files.
  std::vector<std::string> keepFrames(const std::string& name, std::span<const Image8> frames) const {
    std::vector<std::string> files;
    for (const Image8& frame : frames.first(keptFrames())) {
      files.push_back(store_.keepPicture(name + "-frame" + std::to_string(files.size()) + ".png", frame));
    }
    return files;
  }

  // Compares pictures that differ in the age of mirror images with the one reference, or frames each with its own.
  // `map` receives the FLIP map of the last.
  ErrorFigures errorsOf(const std::vector<Image8>& pictures, const Settings& settings, Plane2d& map) {
    std::vector<ImageMetrics> whole;
    std::vector<ImageMetrics> mirrors;
    std::vector<glm::dvec3> before;
    double flicker = 0.0;
    for (size_t i = 0; i < pictures.size(); ++i) {
      std::vector<glm::dvec3> perceived;
      const size_t frame = moves() ? i : 0;
      const ErrorFigures errors = errorsAgainst(truths_[frame], shown(frame, settings.view.displayCurve()), pictures[i],
                                                &map, moves() ? &perceived : nullptr);
      whole.push_back(errors.whole);
      if (errors.mirrors) {
        mirrors.push_back(*errors.mirrors);
      }
      flicker += moves() && i > 0 ? flickerOf(before, perceived) : 0.0;
      before = std::move(perceived);
    }
    return {.whole = meanMetrics(whole),
            .mirrors = mirrors.empty() ? std::nullopt : std::optional(meanMetrics(mirrors)),
            .flicker = moves() ? std::optional(flicker / (scene_.frames - 1)) : std::nullopt};
  }

  // Returns shownTruth() of a frame. It stays the same for most configurations of a still picture.
  const ComparedImage& shown(size_t frame, const DisplayCurve& curve) {
    if (std::exchange(shownAs_, std::pair(frame, curve)) != std::pair(frame, curve)) {
      shown_ = shownTruth(truths_[frame], curve);
    }
    return shown_;
  }

  ErrorFigures floor() {
    if (!moves() || scene_.truth.floorSamples == 0) {
      return truths_.back().floor;
    }
    std::vector<Image8> seconds;
    std::ranges::transform(truths_, std::back_inserter(seconds), &GroundTruth::second);
    Plane2d map;
    return errorsOf(seconds, base_, map);
  }

  void measureErrors(size_t index) {
    Measurement& measurement = store_.at(keys_[index]);
    const std::vector<Image8> pictures = subject_.pictures(settings_[index]);
    Plane2d flip;
    Fingerprint drawn;
    drawn.add(subject_.work());
    for (const Image8& picture : pictures) {
      drawn.add(std::as_bytes(std::span(picture.rgba)));
    }
    measurement.errors = errorsOf(pictures, settings_[index], flip);
    measurement.drawn = drawn.hex();
    measurement.frames = keepFrames(keys_[index], pictures);
    measurement.picture = store_.keepPicture(keys_[index] + ".png", pictures.back());
    measurement.heatMap = store_.keepPicture(keys_[index] + "-flip.png", heatMap(flip));
  }

  bool compare() {
    for (size_t i = 0; i < keys_.size(); ++i) {
      if (!store_.at(keys_[i]).errors) {
        measureErrors(i);
        store_.save();
      }
      if (!report("pictures", static_cast<double>(i + 1) / static_cast<double>(keys_.size()))) {
        return false;
      }
    }
    std::map<std::string, size_t> points;
    for (size_t i = 0; i < keys_.size(); ++i) {
      const auto [point, isNew] = points.try_emplace(store_.at(keys_[i]).drawn, kept_.size());
      pointOf_.push_back(static_cast<int>(point->second));
      if (isNew) {
        kept_.push_back(i);
      }
    }
    return true;
  }

  bool time() {
    const double total = static_cast<double>(plan_.repeats) * static_cast<double>(kept_.size());
    double done = 0.0;
    for (size_t round = 0; round < static_cast<size_t>(plan_.repeats); ++round) {
      bool measured = false;
      for (const size_t i : kept_) {
        Measurement& measurement = store_.at(keys_[i]);
        if (measurement.gpuMs.size() <= round) {
          const FrameCost cost = subject_.cost(settings_[i]);
          measurement.gpuMs.push_back(cost.gpuMs);
          measurement.cpuMs.push_back(cost.cpuMs);
          measurement.frameMs.push_back(cost.frameMs);
          measured = true;
        }
        if (!report("times", ++done / total)) {
          store_.save();
          return false;
        }
      }
      if (measured) {
        store_.save();
      }
    }
    return true;
  }

  bool report(const char* stage, double fraction) const { return !progress_ || progress_({stage, fraction}); }

  const SweepPlan& plan_;
  const Settings& base_;
  const SweepScene& scene_;
  SweepSubject& subject_;
  SweepStore& store_;
  const SweepProgress& progress_;
  std::vector<Settings> settings_;   // by configuration
  std::vector<std::string> keys_;    // by configuration
  std::vector<size_t> kept_;         // configurations that are points
  std::vector<int> pointOf_;         // by configuration, index into kept_
  std::vector<GroundTruth> truths_;  // by frame
  ComparedImage shown_;              // of a frame, under a curve
  std::optional<std::pair<size_t, DisplayCurve>> shownAs_;
};

}  // namespace

bool runSweep(const SweepPlan& plan, const Settings& base, const SweepScene& scene, SweepSubject& subject,
              SweepStore& store, SweepResults& results, const SweepProgress& progress) {
  Sweep sweep(plan, base, scene, subject, store, progress);
  try {
    if (sweep.run()) {
      sweep.fill(results);
      return true;
    }
  } catch (const SweepCancelled&) {
    store.save();
  }
  return false;
}

}  // namespace speculum
