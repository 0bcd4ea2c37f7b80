#pragma once

#include <memory>
#include <optional>

#include "image/image.hpp"
#include "systems/accumulation.hpp"
#include "systems/display_system.hpp"
#include "systems/frame_data.hpp"

namespace speculum {

// The picture of the main view: the target that it is drawn to, the mean that it is added to, and what the display
// shows of both. While tiles of the next picture are drawn, the display shows what was there before, for which an
// earlier main view then has a target of its own.
class MainPicture {
 public:
  explicit MainPicture(Renderer& renderer) : renderer_(renderer), mean_(renderer) {}

  // Begins a picture of the plan, for the target drawn(), which has depth only if the plan encodes the main view. If
  // the plan has tiles and the display may show the last picture (`displayed`), that picture keeps its target, which is
  // shown() until endFrame(), and drawn() is another target.
  void begin(const Settings& settings, const FramePlan& plan, bool displayed, RetireQueue& retired);
  // Begins a frame of the picture. `watched`: a TargetDisplay shows a target of it.
  void beginFrame(const FrameInfo& info, bool watched);
  // Ends the drawing of a frame. Shows a picture whose last tile is drawn, and adds it to the mean, if there is one.
  void endFrame(const FrameInfo& info);
  void keep(const FrameInfo& info);      // lets the plan of the next frame reuse the picture
  void restart() { reusable_.reset(); }  // no later frame reuses it
  const MainImage* reusable() const { return reusable_ ? &*reusable_ : nullptr; }

  OffScreen& drawn() { return *drawn_; }
  OffScreen& shown() { return earlier_ ? *earlier_ : *drawn_; }
  const Accumulation& mean() const { return mean_; }
  bool unfinished() const { return unfinished_; }  // the last frame drew tiles, and not the last ones of its picture

  // About the last complete picture.
  bool hasGaps() const { return hasGaps_; }  // as SceneRenderer::hasGaps()
  bool hasRadiance() const { return size_.x > 0 && !encoded_; }
  bool hasColor() const { return !flat_ && !encoded_; }           // shown() has its colors
  const std::optional<glm::vec3>& flat() const { return flat_; }  // stored radiance of all its texels, not drawn then
  double radianceScale() const { return radianceScale_; }         // ViewSettings::radianceScale()

  // Curve that displays stored radiances with the settings of the last recorded frame.
  DisplayCurve curve() const { return scaled(view_.displayCurve(), radianceScale_); }
  DisplayedPicture displayed();  // without an area
  LinearImage radiance();        // as SceneRenderer::radiance()
  // Tiles for which the next picture of the mean is to be drawn, as Accumulation::refined().
  std::shared_ptr<const RefinedTiles> refined(double& waitedMs) { return mean_.refined(curve(), view_, waitedMs); }
  // Returns the curve of radiances that are stored times `radianceScale`.
  static DisplayCurve scaled(const DisplayCurve& curve, double radianceScale) {
    return {curve.exposure / radianceScale, curve.toneMap};
  }

 private:
  Renderer& renderer_;
  std::unique_ptr<OffScreen> drawn_;
  std::unique_ptr<OffScreen> earlier_;  // null if drawn_ is shown
  Accumulation mean_;
  std::optional<MainImage> reusable_;
  bool hasGaps_ = false;
  std::optional<glm::vec3> flat_;
  bool encoded_ = false;  // FramePlan::encodes
  bool unfinished_ = false;
  double radianceScale_ = 1.0;
  glm::ivec2 size_{0};  // of the last recorded frame; 0: none yet
  ViewSettings view_;   // of the last recorded frame
};

}  // namespace speculum
