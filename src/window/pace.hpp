#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/gpu_timer.hpp"
#include "plan/fitted_plan.hpp"
#include "plan/frame_plan.hpp"
#include "session/frame_cost.hpp"
#include "settings/settings.hpp"
#include "window/motion_controller.hpp"

namespace speculum {

// Says when a frame has to be drawn: after each change until everything shown is up to date, and never while the window
// is idle.
class FramePacer {
 public:
  // Call when something changed or is changing. `halves`: settings of the pictures that are drawn in turn.
  void change(std::span<const Settings> halves);
  void requestFrames(int frames) { due_ = std::max(due_, frames); }
  bool due() const { return due_ > 0; }
  void idle() { idled_ = true; }  // call when the window sleeps

  // Begins a frame, `seconds` after the last step. Returns the milliseconds since the last frame, NaN if the window was
  // idle.
  double beginFrame(double seconds);
  void frameDrawn() { due_ = std::max(0, due_ - 1); }

 private:
  int due_ = 0;        // frames to draw, although nothing changes any more
  bool idled_ = true;  // the window slept before the frame that is drawn next
};

// How a scene is shown at first. An animated scene moves at once, but if that proves too slow it is paused until the
// user plays it. On a CPU device the scene's thumbnail covers the first pictures.
class FirstPictures {
 public:
  // What the picture shows. Another content ends the cover, but panels may be used below it.
  struct Content {
    Settings settings;                 // those of imageSettings()
    uint64_t revision = 0;             // SceneDocument::pictureRevision()
    double time = 0.0;                 // seconds of the animation
    int seeks = 0;                     // how often the time was set
    std::optional<CameraPose> camera;  // to which the user moved it; none: the scene's own, which may move by itself

    bool operator==(const Content&) const = default;
  };

  // Call when another scene is shown. `moves`: the scene moves by itself, and its frames have a time budget. `covered`:
  // the thumbnail covers the picture until there is a good one, or for some seconds.
  void begin(bool moves, bool covered) {
    triesLeft_ = moves ? mostTries : 0;
    covered_ = covered;
    holds_ = returns_ = false;
    content_.reset();
  }
  // Call before each frame with what it shows. `split`: A | B is on, which compares drafts and not the thumbnail.
  void shows(const Content& content, bool split) {
    const bool returns = std::exchange(returns_, false);
    if (content_ && (triesLeft_ > 0 || returns)) {
      content_->time = content.time;
      content_->seeks = returns ? content.seeks : content_->seeks;
    }
    covered_ = covered_ && !split && (!content_ || *content_ == content);
    content_ = content;
  }
  // Call after each frame: with Pace::playCost(), whether the scene moves by itself, whether the frame was a complete
  // picture and not coarse, and the seconds since begin(). Returns true if the scene is to go back to its start
  // and to be paused.
  bool drawn(const std::optional<std::string>& playCost, bool moves, bool complete, double seconds) {
    const bool tried = triesLeft_ > 0;
    triesLeft_ = moves && !playCost ? triesLeft_ - tried : 0;
    const bool stands = tried && moves && !playCost.value_or("").empty();
    holds_ = stands || (holds_ && !moves);
    returns_ = stands;
    covered_ = covered_ && seconds < longestCover && (tried ? triesLeft_ > 0 || stands : !complete);
    return stands;
  }
  void uncover() { covered_ = false; }  // the user acts in the picture

  bool covered() const { return covered_; }  // the thumbnail covers the picture
  // Says what is prepared, below the thumbnail if there is a `preview`. `share`: of the first whole picture, if several
  // frames draw it.
  std::string text(bool preview, const std::optional<double>& share) const;
  bool holds() const { return holds_; }  // the scene was paused for being slow, and nobody has played it yet

 private:
  static constexpr int mostTries = 60;
  static constexpr double longestCover = 30.0;  // seconds, after which a draft is shown

  int triesLeft_ = 0;  // frames in which the cost of playing may become known
  bool covered_ = false;
  bool holds_ = false;
  bool returns_ = false;            // the next frame shows the start of the scene
  std::optional<Content> content_;  // of the last frame; none: there was none
};

// A still picture that takes longer than a window may wait: several frames draw it, a few tiles each. Learns the time
// of each tile, for the next pictures of the same view. Tiles that are faces of maps come first, in frames of their
// own: they do not take as long as other tiles, and most pictures have none.
class SlowPicture {
 public:
  // Begins a picture of `faces` tiles that are faces of maps and `count` other tiles. The other tiles of the first
  // picture are expected to take `ms` together, those of a further picture as long as in the picture before.
  void begin(size_t faces, size_t count, double ms);
  // Returns the next tiles, at least one, that are expected to take `ms` together. Without `input` these are more, up
  // to one in 128, as long as that makes each faster.
  TileRange next(double ms, bool input = false);
  // Call with the milliseconds that the tiles of the last next() took.
  void took(double ms);

  bool begun() const { return !tileMs_.empty(); }                          // there was a picture
  bool finished() const { return tiles_.end == faces_ + tileMs_.size(); }  // all tiles are planned
  double share() const { return static_cast<double>(tiles_.end) / static_cast<double>(faces_ + tileMs_.size()); }
  double totalMs() const { return totalMs_; }

 private:
  size_t faces_ = 0;
  double faceMs_ = 0.0;         // of each of the faces drawn last
  std::vector<double> tileMs_;  // of each other tile, expected or measured
  TileRange tiles_;             // of the last next()
  bool pays_ = true;            // more tiles in a frame take less time each
  int framesAlike_ = 0;         // frames since a number of tiles was compared with another
  size_t lastCount_ = 0;        // tiles of the last frame; 0: none of this picture
  double lastTileMs_ = 0.0;     // of each of these
  size_t measured_ = 0;         // the first tiles of tileMs_ whose times were measured
  double dearestMs_ = 0.0;      // longest measured time of a tile, fading from frame to frame
  double totalMs_ = 0.0;        // of the picture's tiles so far
};

// Says whether the picture moves, by its camera or otherwise. A movement lasts until nothing has moved for a moment, so
// that the picture does not change its quality between two steps of the pointer.
class Movement {
 public:
  // Call once a frame, `seconds` after the last. `contentMoves`: something besides the camera moves.
  void update(const CameraPose& camera, bool contentMoves, double seconds) {
    const bool moves = contentMoves || (camera_ && *camera_ != camera);
    camera_ = camera;
    stillSeconds_ = moves ? 0.0 : stillSeconds_ + seconds;
    moving_ = moves || (moving_ && stillSeconds_ < longestRest);
  }
  bool moving() const { return moving_; }
  bool ending() const { return moving_ && stillSeconds_ > 0.0; }  // nothing moves in this frame
  void restart() { camera_.reset(); }                             // the next camera is that of another scene

 private:
  static constexpr double longestRest = 0.15;  // seconds

  std::optional<CameraPose> camera_;  // of the last frame
  double stillSeconds_ = 0.0;
  bool moving_ = false;
};

// Chooses the quality of the window's frames. While something moves, a picture has as much of the chosen settings as
// fits into a budget of milliseconds. A still picture has all of them; if it takes longer than the budget, a draft that
// fits comes first. Then follows the picture, or the pictures of its mean (view.accumulate, each with its own offset),
// one in each frame or, if one takes long, over several frames (FramePlan::tiles).
class Pace {
 public:
  // What the planned frame is. All but `moving` are for still pictures, or for moving ones without a budget.
  enum class State {
    moving,   // a picture that fits the budget, while something moves
    changed,  // not planned yet: something else is to be shown
    whole,    // a picture with the chosen settings
    draft,    // a picture that fits the budget, shown until the first one of the mean is complete
    mean,     // the next picture of the mean, or tiles of it
    redraw,   // the last picture of a complete mean, or tiles of it: for a target that was not kept
    done,     // the complete picture or mean that was there before, for the panels
  };

  // `sampleCounts`: those that the device supports, as VkSampleCountFlags.
  Pace(bool cpuDevice, unsigned sampleCounts)
      : cpuDevice_(cpuDevice), sampleCounts_(sampleCounts), controller_(cpuDevice) {}

  // Begins a frame. `contentMoves`: something besides the camera moves.
  void begin(const CameraPose& camera, bool contentMoves, double seconds);
  void sceneChanged() {
    movement_.restart();
    shown_.reset();
    drawn_.clear();
    learned_ = 0;
  }
  void forgetPlayCost() { playCost_.reset(); }  // another scene is shown
  bool moving() const { return movement_.moving(); }
  // Says whether another frame is needed although nothing happens.
  bool wantsFrame() const { return movement_.ending() || (!moving() && (!isComplete() || !slow_.finished())); }
  int pictures() const { return pictures_; }  // in the mean of the planned still picture; 1 while something moves
  // Says whether the last frame drew tiles of a picture. finished() learns from their time if that frame has ended
  // when the next one begins.
  bool drawsTiles() const { return fitted_.plan.tiles.has_value(); }
  // Says whether the last frame was a still picture, or tiles of one, that takes longer than the budget. If so, wait
  // for that frame before you handle events: no second frame then delays them.
  bool drawsLong() const { return drawsTiles() || long_; }
  // Returns the share of the first whole picture that is drawn, if several frames draw it; else nothing.
  std::optional<double> firstShare() const {
    return picture_ == 0 && !slow_.finished() ? std::optional(slow_.share()) : std::nullopt;
  }
  // Says whether the planned frame has a lower quality than the chosen settings.
  bool lowers() const { return level_ > 0; }
  bool coarse() const { return lowers() && !sharpDraft_; }  // its resolution is lower too, or may be
  // Returns a number that each still picture has of its own, once it is complete.
  std::optional<uint64_t> completeStill() const {
    return !moving() && isComplete() && slow_.finished() ? std::optional(still_) : std::nullopt;
  }
  const FittedPlan& planned() const { return fitted_; }  // by the last plan()
  // Says whether the planned frame draws the picture again that was there before.
  bool repeats() const { return state_ == State::redraw || state_ == State::done; }
  // Says whether the next frames are likely to draw tiles.
  bool drawsSlowly() const { return !moving() && (slow_.begun() || !draft_.empty()); }

  // Identifies what a still picture shows, besides the chosen settings.
  struct Shown {
    uint64_t revision = 0;       // SceneDocument::pictureRevision()
    uint64_t shaders = 0;        // revision of the pipelines
    std::optional<double> time;  // of a scene that moves
    glm::ivec2 size{0};          // pixels of the picture

    bool operator==(const Shown&) const = default;
  };
  // Pass and kind of a target.
  using Target = std::pair<MirrorPath, TargetKind>;
  struct Request {
    FrameRequest frame;       // with the chosen settings
    PicturePlanner& planner;  // is asked a few times, or not at all between tiles of a picture
    Shown shown;
    double budgetMs = 0.0;               // 0: nothing is lowered
    std::span<const MotionLevel> front;  // of the scene's sweep, see motionLevels()
    bool input = false;                  // there is input, which a long frame must not hold up
    bool covered = false;                // something else is shown until there is a picture that is not coarse
    std::optional<Target> target;        // target that the panels show and that is not there yet
  };
  // Plans the frame. The plan is valid until the next frame's.
  const FittedPlan& plan(const Request& request);
  // Leaves textures out of the frame that was planned.
  void leaveOutTextures() { fitted_.settings.effects.textures = false; }

  // Call when the frame was recorded. `cpuMs`: without the `waitedMs` in which the CPU waited for parts of the frame.
  // `learns`: nothing but drawing took time, so the cost model may learn from this frame.
  void drawn(uint64_t number, double cpuMs, double waitedMs, bool learns);
  // Call when the frame was presented, which took `ms`.
  void presented(double ms) { drawn_.back().presentMs = ms; }
  // Call with the GPU's times of an earlier frame.
  void finished(const FrameTimings& timings);

  // Returns the label of a button to play a scene that this device cannot move at half of its resolution, with the
  // frames a second and the resolution to expect; empty for a faster device, nothing until it is known.
  const std::optional<std::string>& playCost() const { return playCost_; }

  // Text for the user: what the picture gives up for its pace, or how far it has converged; empty if neither applies.
  const std::string& text() const { return text_; }
  // Says whether the picture that is shown is finished, and if not why, to be read at a glance; empty for a picture
  // that one frame has drawn as it was chosen.
  std::string progress() const;

 private:
  // Plan a frame: set fitted_, work_, level_ and text_.
  void planWith(const Request& request, const Settings& settings, int picture);
  void planWithinBudget(const Request& request);
  // Plan a frame, and set state_ too.
  void planMoving(const Request& request);
  void planStill(const Request& request);
  void planFirst(const Request& request);
  void planPicture(const Request& request, State state);
  void planTiles(const Request& request);
  // Returns the longest time of a frame, in budgets: `touched`, or more after a while without input.
  double longestFrame(double touched) const;
  double sendMs() const;
  bool isComplete() const { return picture_ == pictures_ && state_ != State::changed && state_ != State::moving; }
  State stateAfter(const Request& request);
  void forgetStill();
  bool sharpens(Settings settings, const Request& request);
  void findPlayCost(std::span<const MotionLevel> levels, const Request& request);
  std::string tilesText(int complete) const;
  std::string meanText(int complete) const;

  using Clock = std::chrono::steady_clock;
  struct Drawn {
    uint64_t number = 0;
    double cpuMs = 0.0;
    double waitedMs = 0.0;
    Clock::time_point begun;
    double presentMs = 0.0;
    double frameMs = 0.0;           // until the next frame began; 0: not yet
    std::optional<FrameWork> work;  // none if the cost model may not learn from it
  };

  bool cpuDevice_;
  unsigned sampleCounts_;
  Movement movement_;
  MotionController controller_;
  double seconds_ = 0.0;    // since the last frame
  double untouched_ = 0.0;  // seconds since the last input
  int answers_ = 0;         // frames, with this one, that are to show input soon
  Clock::time_point begun_;
  std::deque<Drawn> drawn_;  // frames whose GPU times are awaited
  int learned_ = 0;          // moving frames of this scene that were timed
  std::optional<std::string> playCost_;
  std::deque<double> sendMs_;  // of the last frames: milliseconds of presenting beyond drawing
  FittedPlan fitted_;          // of the frame that was planned last
  FrameWork work_;             // of fitted_
  size_t level_ = 0;           // of fitted_; 0: the chosen settings
  bool sharpDraft_ = false;    // fitted_ has the chosen resolution, whatever level_ is
  State state_ = State::changed;
  // Settings and content of the still pictures; nothing while the picture moves.
  std::optional<std::pair<Settings, Shown>> shown_;
  uint64_t still_ = 0;             // still views begun so far
  int picture_ = 0;                // complete pictures of the mean
  int pictures_ = 0;               // in the mean; 1: a single picture instead
  int converged_ = 0;              // pictures after which the mean has converged; 0: it has not
  std::optional<Target> target_;   // of the latest redraw
  SlowPicture slow_;               // picture that is drawn in tiles while another picture or a draft is shown
  FrameWork slowWork_;             // of the whole slow_
  std::string draft_;              // what the draft gives up; empty: none was needed
  std::optional<double> refined_;  // share of the mean's tiles that its next picture is drawn for; none: not decided
  std::string text_;
  bool long_ = false;              // the planned frame is a still picture that takes longer than the budget
  double cpuMs_ = 0.0;             // of the last frame
  std::optional<double> shownMs_;  // the GPU's for picture and panels, of the last frame whose passes were timed
  // Expected milliseconds of a frame besides its tiles: the program, the display pass, panels, and sending the picture.
  double besidesMs_ = 0.0;
};

// Returns the number of pictures in the mean of a still picture.
int stillPictures(const Settings& settings);
// Resets what changes no pixel of a still picture: ui.*, view.continuous and quality.motion_ms.
Settings imageSettings(Settings settings);
// Returns the settings for a mean of so many pictures, or for a single one.
Settings withPictures(Settings settings, int pictures);

// Returns the budget of a frame in milliseconds: quality.motion_ms or, if that is auto, 50 on a CPU device and 0.8 of
// the monitor's refresh interval elsewhere.
double motionBudget(const Settings& settings, bool cpuDevice, double refreshHz);

}  // namespace speculum
