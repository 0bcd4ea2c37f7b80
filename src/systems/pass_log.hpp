#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/gpu_timer.hpp"
#include "core/renderer.hpp"
#include "plan/effects.hpp"
#include "plan/frame_plan.hpp"

namespace speculum {

// One pass as it was recorded. Its GPU figures follow under the same index in the FrameTimings of its frame.
struct RecordedPass : PassId {
  std::string name;  // for the user; two mirrors may share one
  uint32_t draws = 0;
  double areaPx = 0.0;
};

// Logs recorded passes: the passes of the picture, and for each of the last frames the passes or parts of passes that
// it recorded, because the GPU's timings arrive later.
class PassLog {
 public:
  void beginFrame() { frame_.clear(); }
  void beginPicture() { picture_.clear(); }

  void add(RecordedPass pass) {
    frame_.push_back(pass);
    picture_.push_back(std::move(pass));
  }
  // Says that the pass added last continues the pass before it in the picture. The frame's list keeps the part, without
  // draws.
  void joinLast() {
    picture_.pop_back();
    frame_.back().draws = 0;
  }
  // Keeps the passes of a frame that was recorded to its end.
  void endFrame(uint64_t number) { frames_[number % frames_.size()] = {number, frame_}; }

  // Passes of the picture, in order.
  const std::vector<RecordedPass>& passes() const { return picture_; }
  // Passes and parts of frame `number`; none if it is too old.
  std::span<const RecordedPass> passesOf(uint64_t number) const {
    const auto& [recorded, passes] = frames_[number % frames_.size()];
    return recorded == number ? std::span(passes) : std::span<const RecordedPass>();
  }

 private:
  std::vector<RecordedPass> picture_;
  std::vector<RecordedPass> frame_;
  std::array<std::pair<uint64_t, std::vector<RecordedPass>>, framesInFlight + 1> frames_;  // by frame number
};

// A recorded pass with the GPU's figures.
struct TimedPass : RecordedPass {
  PassTiming timing;
};

// Sums the draws and the GPU's figures of each pass over frames that draw the parts of a picture or the pictures of a
// mean.
class PictureSums {
 public:
  // Call before the first frame of a picture. Pictures may differ in passes at the edge of the view.
  void beginPicture() { place_ = 0; }
  // Adds the figures of a frame's passes to those of the same id. A new pass is inserted behind the pass before it.
  void add(std::span<const RecordedPass> passes, const FrameTimings& timings);

  const std::vector<TimedPass>& passes() const { return passes_; }

 private:
  std::vector<TimedPass> passes_;
  size_t place_ = 0;  // index behind the pass that was added last
};

// Number of frames without a call for an effect after which its resources are released.
inline constexpr int idleFramesKept = 120;

// How the rays of the last recorded frame were traced.
struct RayUse {
  bool traced = false;
  bool hardware = false;    // by ray queries
  std::string_view why;     // reason for the choice of rays; static lifetime
  uint32_t structures = 0;  // acceleration structures, alive
  uint64_t structureBytes = 0;
};

// Costs of the effects in a frame.
class EffectLedger {
 public:
  RayUse rays;

  EffectCost& operator[](EffectKind kind) { return costs_[static_cast<size_t>(kind)]; }
  const EffectCost& operator[](EffectKind kind) const { return costs_[static_cast<size_t>(kind)]; }
  // Counts a draw for an effect, if the effect takes part in it.
  void draw(EffectKind kind, bool takesPart = true) { (*this)[kind].draws += takesPart; }
  // Adds the draws of a later picture and takes over its bytes and pipelines.
  void add(const EffectLedger& later) {
    for (size_t i = 0; i < costs_.size(); ++i) {
      const uint32_t before = costs_[i].draws;
      costs_[i] = later.costs_[i];
      costs_[i].draws += before;
    }
    rays = later.rays;
  }
  void pipeline(EffectKind kind, bool takesPart = true) { (*this)[kind].pipelines += takesPart; }

 private:
  std::array<EffectCost, static_cast<size_t>(EffectKind::count)> costs_{};
};

// Finds passes by their id, so that lists of thousands can be joined. T derives from PassId.
template <typename T>
class PassIndex {
 public:
  // `passes` must outlive the index, and nothing else may insert into it. No two of them have the same id.
  explicit PassIndex(std::vector<T>& passes) : passes_(passes) { number(0); }

  // Returns the place of the pass with the id of `pass`. If there is none, inserts `pass` at `place`.
  size_t findOrInsert(const T& pass, size_t place) {
    const auto [found, isNew] = places_.try_emplace(pass, place);
    if (isNew) {
      passes_.insert(passes_.begin() + static_cast<std::ptrdiff_t>(place), pass);
      number(place + 1);
    }
    return found->second;
  }

 private:
  void number(size_t first) {
    for (size_t i = first; i < passes_.size(); ++i) {
      places_[passes_[i]] = i;
    }
  }

  std::vector<T>& passes_;
  std::map<PassId, size_t> places_;
};

}  // namespace speculum
