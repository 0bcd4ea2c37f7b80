#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "session/frame_cost.hpp"
#include "settings/settings.hpp"

namespace speculum {

// Settings that a moving picture can be drawn with.
struct MotionLevel {
  Settings settings;
  double error = 0.0;  // mean FLIP, about
};

// Returns levels for a picture of a scene with the settings `chosen`, each cheaper than the one before: these settings,
// the front of the scene's measured sweep (most accurate first; may be empty), then steps in an order that holds for
// most scenes (docs/window.md). No setting of a level has better quality than that of the first. `sampleCounts` are
// those that the device has, as VkSampleCountFlags.
std::vector<MotionLevel> motionLevels(const Scene& scene, const Settings& chosen, std::span<const MotionLevel> front,
                                      unsigned sampleCounts);

// Describes what a level gives up, such as "0.5 scale, 1 sample (estimated error 0.05 FLIP)", or "full quality".
std::string motionText(const Settings& chosen, const MotionLevel& level);

// Describes what a still picture of a scene approximates with these settings, and how closely; empty if it is exact as
// docs/picture.md defines it. Roughness is exact if its mean is. `planned`: what an automatic shadow lookup became.
std::string stillText(const Scene& scene, const Settings& settings, ShadowLookup planned);

// Keeps the time of a moving picture's frames near a budget by choosing a level for each. The first level has the
// settings that the user chose; each further one costs less. The controller goes down, by as many levels as needed, as
// soon as a frame is predicted to take clearly longer, and up by one level after a while in which that level would have
// fitted. It needs no device. docs/window.md describes it for users.
class MotionController {
 public:
  explicit MotionController(bool cpuDevice) : model_(cpuDevice) {}

  // Chooses the level of the next frame, `seconds` after the last, for a budget of `budgetMs` (above 0). Plan the frame
  // at the level that begin() returns, then at each level that next() returns for the work of the last plan. The last
  // plan is the one to draw.
  size_t begin(std::span<const MotionLevel> levels, double budgetMs, double seconds);
  // Returns the level to plan next, or nothing if the one planned last is chosen.
  std::optional<size_t> next(std::span<const MotionLevel> levels, const FrameWork& work);
  // Call when the picture stands still: the next moving frame may have any level.
  void setStill() { moving_ = false; }

  // Call with the time of each frame, moving or still, unless it did unusual work that `work` does not contain.
  void learn(const FrameWork& work, double ms) { model_.learn(work, ms); }
  double predict(const FrameWork& work) const { return model_.predict(work); }

 private:
  // Why a level is planned.
  enum class Try {
    afterStanding,  // a movement begins, with the level of the movement before
    current,        // the level of the last frame, or the one that fits where a movement begins
    lower,          // the level planned last takes too long
    higher,         // a better level seems to fit
    back,           // the better level did not fit: the level of the last frame again
  };
  size_t fittingLevel(std::span<const MotionLevel> levels, size_t first, const FrameWork& work) const;
  std::optional<size_t> nextFromCurrent(std::span<const MotionLevel> levels, const FrameWork& work);
  std::optional<size_t> lower(std::span<const MotionLevel> levels, const FrameWork& work);
  std::optional<size_t> tryLevel(Try why, size_t level);
  void choose();

  CostModel model_;
  double budgetMs_ = 0.0;
  size_t level_ = 0;   // planned last
  size_t before_ = 0;  // chosen for the last frame
  Try try_ = Try::current;
  bool moving_ = false;
  bool begins_ = false;           // the movement begins with this frame
  double patience_ = 0.0;         // seconds at a level before a better one is tried
  double sinceChange_ = 0.0;      // seconds
  bool raised_ = false;           // the last change was to a better level
  bool refused_ = false;          // since the last change, a better level was planned and did not fit
  std::deque<double> predicted_;  // predicted milliseconds of the last frames, of one update interval at most
};

}  // namespace speculum
