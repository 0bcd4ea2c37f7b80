#pragma once

#include <memory>
#include <string>

#include "core/off_screen.hpp"
#include "core/pass.hpp"
#include "plan/frame_plan.hpp"
#include "plan/view.hpp"
#include "systems/frame_data.hpp"
#include "systems/image_pool.hpp"

namespace speculum {

// Target of the main view. While its tiles are drawn, the display shows the main view of an earlier frame, which then
// has a target of its own.
class MainTargets {
 public:
  explicit MainTargets(Device& device) : device_(device) {}

  // Begins a picture of the plan. `samplesRead`: shaders read the samples. `displayed`: the display shows drawn(). If
  // the plan has tiles, that target then stays shown() until finish(), and drawn() is another one. If the plan encodes
  // the main view, drawn() has depth only.
  void begin(const Settings& settings, const FramePlan& plan, bool samplesRead, bool displayed, RetireQueue& retired);
  // Shows the picture, whose last tile is drawn.
  void finish(RetireQueue& retired) { retired.take(earlier_); }

  OffScreen& drawn() { return *drawn_; }
  OffScreen& shown() { return earlier_ ? *earlier_ : *drawn_; }

 private:
  Device& device_;
  std::unique_ptr<OffScreen> drawn_;
  std::unique_ptr<OffScreen> earlier_;  // null if drawn_ is shown
};

// The targets of environment maps: six faces in each, three to a row. Nothing exists while no frame has a map.
class EnvironmentTargets {
 public:
  explicit EnvironmentTargets(Device& device) : device_(device) {}

  void restart();  // drops the targets in the next frame

  // Takes targets for the plan's maps and frees those of other maps. Call it at the start of the plan's frame.
  void prepare(const FramePlan& plan, RetireQueue& retired);
  // Target of a map, by its index among the environment maps.
  OffScreen& operator[](size_t map) { return *targets_[map]; }
  void endFrame(RetireQueue& retired);
  uint64_t bytes() const { return pool_ ? pool_->bytes() + depth_->bytes() : 0; }

 private:
  void release(RetireQueue& retired);

  Device& device_;
  std::unique_ptr<SharedDepth> depth_;
  std::unique_ptr<ImagePool> pool_;
  std::vector<OffScreen*> targets_;  // of the environment maps of the plan that was prepared last
  bool restart_ = false;
};

// Returns the viewport that places the picture so that the target's corner shows the corner of the view's rectangle.
Viewport viewportOf(const View& view);
// Returns the color that scenePass() clears with: the background, as a target stores it in picture `picture` of a mean.
glm::vec3 storedBackground(const Environment& environment, const View& view, int picture);
// Describes a pass that draws the scene into `area` of its targets, in picture `picture` of a mean.
PassDesc scenePass(std::string name, const PassTargets& targets, const VkRect2D& area, const Viewport& viewport,
                   const View& view, const Environment& environment, int picture);

}  // namespace speculum
