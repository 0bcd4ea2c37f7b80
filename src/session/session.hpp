#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "accuracy/pareto.hpp"
#include "scene/scene_loader.hpp"
#include "session/frame_planner.hpp"
#include "session/options.hpp"
#include "settings/settings.hpp"
#include "systems/pass_log.hpp"
#include "systems/scene_renderer.hpp"

namespace speculum {

inline QualityBudget budgetOf(const Settings& settings) {
  return {settings.quality.budgetMs, settings.quality.maxError};
}

// The point of a sweep that the bounds of quality.* chose.
struct QualityChoice {
  SweepPoint point;
  bool met = true;  // false: no point meets the bounds, and this one comes closest
  std::string why;  // one sentence for users
};

// Reads the file of --sweep-results. Throws InputError as readSweepResults() does, and for a sweep in motion, whose
// points may not name the settings that its frames had.
SweepResults readStillSweep(const std::filesystem::path& file);

// Returns every setting that a point's figures depend on, with its value at the point.
std::vector<SettingChange> settingsOfPoint(const SweepResults& results, int point);
bool isAtPoint(const Settings& settings, const std::vector<SettingChange>& point);

// Sets settings to those of a point. Keys listed in `kept` stay, with a warning where they differ. Throws InputError
// with the message of setSetting().
void applyPoint(const SweepResults& results, int point, const std::set<std::string>& kept, Settings& settings);

// Finds the scene file of --scene: a path, a path within the program's data, or a shipped scene's name. Throws
// UsageError if there is none.
std::filesystem::path findScene(const std::string& wanted);

// A scene with its settings: defaults, [settings], --set, and a sweep's choice for the bounds of quality.*.
struct LoadedScene {
  Scene scene;
  Settings settings;
  std::optional<QualityChoice> quality;
};
// Returns the scene's settings, with those of --set. Throws UsageError.
Settings settingsOf(const Scene& scene, const Options& options);
// Load a scene, that of --scene or `file`, with its settings. Throw UsageError and InputError, with --strict also for a
// defect of a model.
LoadedScene loadSceneWithSettings(const Options& options);
LoadedScene loadSceneWithSettings(const std::filesystem::path& file, const Options& options,
                                  const LoadProgress& progress = {});

// Throws InputError with the first defect of a model, if there is one.
void requireNoDefects(const Scene& scene);

// Returns the camera of --camera; nothing if there is no such option. Throws UsageError for a camera without a
// direction.
std::optional<CameraPose> cameraOf(const Options& options, const Scene& scene);

// Returns what the renderer read back as an opaque picture.
Image8 pictureOf(Pixels pixels);

// A null `window` means that nothing is presented.
DeviceOptions deviceOptions(const Options& options, Window* window);
RendererOptions rendererOptions(const Options& options, Window* window);

// Applies debug.omit_barrier. Throws UsageError for a barrier that does not exist; the message lists all barriers.
void applyDebugSettings(const Settings& settings, Device& device);

// Returns the exit code of a run: 1 if the validation layer or debug.check_finite found anything. Prints a line on
// stderr for each of the two that did.
int exitCodeOfChecks(int validationMessages, uint64_t nonFinite);

// One frame as it was planned and recorded: a picture, or the mean of view.accumulate pictures. Times, draws and counts
// are sums over its pictures. The figures of the GPU are there after Session::finish.
struct DrawnFrame {
  SceneState state;
  FramePlan plan;     // of the last picture
  Settings settings;  // of the plan
  int pictures = 0;
  uint64_t number = 0;   // of the renderer's last frame that has finished
  double cpuMs = 0.0;    // planning and recording
  double planMs = 0.0;   // planning alone
  double gpuMs = 0.0;    // see FrameTimings
  double frameMs = 0.0;  // from the start of Session::draw until the GPU has finished
  PictureSums sums;
  EffectLedger ledger;
  bool complete = false;  // all pictures of the mean are drawn, or it has converged

  const std::vector<TimedPass>& passes() const { return sums.passes(); }
};

// A scene drawn without a window.
class Session {
 public:
  // Draws with `device`, which must outlive the session, or with a device of its own.
  explicit Session(const Options& options, Device* device = nullptr);

  // Replaces the scene's camera; without a value the scene's is used again.
  void setCamera(const std::optional<CameraPose>& camera) { camera_ = camera; }
  // Draws the scene at `time` (seconds). picture() needs `capture`. Calls `afterPicture` after each picture of a mean;
  // the mean ends early when it returns false. Throws std::runtime_error if a shader of --shader-dir does not compile.
  const DrawnFrame& draw(double time, bool capture, const std::function<bool()>& afterPicture = {});
  // Says that radiance() is not called, from the next frame on.
  void showOnly() { shownOnly_ = true; }
  // Drops all cached images: the next frame renders everything.
  void restart() { sceneRenderer_.restart(); }
  void resize(PictureSize size);  // from the next frame on
  // Plans pictures with `planning` from now on, which is given what is asked for and the session's planner; with an
  // empty one, as asked for.
  using Planning = std::function<FittedPlan(const FrameRequest& asked, PicturePlanner& planner)>;
  void setPlanning(Planning planning) { planning_ = std::move(planning); }
  // Changes the settings from the next frame on. Throws UsageError if debug.omit_barrier names no barrier.
  void setSettings(const Settings& settings);
  // Waits for the GPU, after which lastFrame() is complete.
  void finish();
  Image8 picture() { return pictureOf(renderer_.readback()); }  // of the last frame drawn with `capture`
  LinearImage radiance() { return sceneRenderer_.radiance(); }  // of the last frame, before the display pass
  // Returns exitCodeOfChecks() for the frames that have finished.
  int exitCode() { return exitCodeOfChecks(device_.validationMessages(), sceneRenderer_.finiteWatch().count()); }

  const Scene& scene() const { return loaded_.scene; }
  const Settings& settings() const { return loaded_.settings; }
  const std::optional<QualityChoice>& quality() const { return loaded_.quality; }
  PictureSize size() const { return size_; }
  Device& device() { return device_; }
  Renderer& renderer() { return renderer_; }
  SceneRenderer& sceneRenderer() { return sceneRenderer_; }
  const DrawnFrame& lastFrame() const { return frame_; }

 private:
  void drawPicture(bool capture);
  void collectFinished();

  PictureSize size_;
  LoadedScene loaded_;
  std::optional<CameraPose> camera_;
  std::unique_ptr<Device> ownDevice_;  // null: the device was passed in
  Device& device_;
  Renderer renderer_;
  SceneRenderer sceneRenderer_;
  FramePlanner planner_;
  Planning planning_;
  bool shownOnly_ = false;
  DrawnFrame frame_;
  std::deque<uint64_t> unfinished_;  // the renderer's frames whose figures are not in frame_ yet
  std::chrono::steady_clock::time_point start_;
};

}  // namespace speculum
