#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frame/depth_readout.hpp"
#include "frame/frame_plan.hpp"
#include "frame/settings.hpp"
#include "geometry/projection.hpp"
#include "ui/edit_model.hpp"
#include "ui/frame_history.hpp"
#include "ui/log_history.hpp"

namespace speculum {

struct UiPass {
  std::string name;
  std::vector<int> path;  // mirrors from the eye, indices into Scene::mirrors; empty for other passes
  int depth = -1;         // -1: not a mirror's
  PassKind kind = PassKind::mirror;
  int framesAgo = 0;  // since it ran
  double gpuMs = 0.0;
  double areaPx = 0.0;
  uint32_t draws = 0;
  std::optional<DepthReadout> resolution;  // a mirror's, if it sees anything but the background
  std::vector<glm::vec2> outline;          // a mirror's: where it is seen, pixels of the picture
  PassId id;
};

struct UiSkipped {
  std::string path;  // mirrors from the eye
  std::string reason;
  std::string detail;
  std::vector<int> mirrors;  // of the path, indices into Scene::mirrors
};

struct UiEffect {
  std::string name;
  bool calledFor = false;
  std::string why;
  uint32_t draws = 0;
  uint64_t bytes = 0;
  uint32_t pipelines = 0;
};

struct UiFeature {
  std::string name;
  bool present = false;
  std::string about;  // what it is used for, or what is done without it
};

struct UiDevice {
  std::string name;
  std::string kind;  // e.g. discrete GPU
  std::string driver;
  std::string vulkan;  // version
  std::string renderPath;
  std::string samples;  // counts that it has
  uint64_t budgetBytes = 0;
  uint64_t usedBytes = 0;
  std::vector<UiFeature> features;
};

// What a target holds at a texel.
struct UiTexel {
  glm::ivec2 texel{0};
  bool depth = false;     // which of the next two it is
  double metres = 0.0;    // from the eye along the view; infinite where nothing is
  glm::dvec4 value{0.0};  // linear radiance; disparity, 1/m
};

// What the window of targets shows of the pass debugPass.
struct UiTargets {
  int kind = 0;                                 // colour, depth, mask; changed by the person
  double zoom = 0.0;                            // pixels of the display a texel; 0: as large as fits. Likewise.
  double shownZoom = 1.0;                       // set by the panel, never 0
  double halfDistance = 5.0;                    // metres that depth shows half bright; changed by the person
  glm::dvec2 center{0.0};                       // texel in the middle; likewise
  glm::dvec2 origin{0.0};                       // texel at the upper left corner of debugArea; set by the panel
  glm::ivec2 size{0};                           // texels of the image
  std::vector<glm::vec2> mask;                  // what the pass shades, in texels
  std::vector<std::vector<glm::vec2>> mirrors;  // what of the mirrors is seen in it, in texels
  std::optional<glm::ivec2> pointed;            // texel under the pointer; set by the panel
  std::optional<UiTexel> value;                 // what is there, a few frames later
};

struct UiLog {
  std::shared_ptr<LogHistory> history = std::make_shared<LogHistory>();
  std::array<char, 64> filter{};  // text that a line must contain; changed by the person
  LogLevel least = LogLevel::info;
};

// A measured configuration.
struct UiAccuracyPoint {
  std::string name;
  double error = 0.0;  // mean FLIP
  double ms = 0.0;     // GPU milliseconds a frame: median and quartiles
  double lowerMs = 0.0;
  double upperMs = 0.0;
};

// What was measured of the accuracy and the price of settings, and what the person wants of it.
struct UiAccuracy {
  std::vector<UiAccuracyPoint> points;
  std::vector<int> front;          // indices into points, cheapest first
  int current = -1;                // the point that the settings are at; -1: none
  double noiseFloor = 0.0;         // mean FLIP
  std::string about;               // what was measured, where
  std::string stage;               // of the measurement that runs; empty: none runs
  double progress = 0.0;           // of the stage, 0 .. 1
  std::string choice;              // what the budget chose and gave up
  std::string difference;          // what the difference view shows or waits for
  std::vector<glm::vec3> heatBar;  // colours from no error to an error of 1, display sRGB
  bool measure = false;            // set by the panel: measure the current view
  bool cancel = false;             // set by the panel
  int apply = -1;                  // set by the panel: bring the settings to this point
  bool open = false;               // the panel is; set by it
  bool showDifference = false;     // changed by the person
};

// What was done last, to be read and forgotten.
struct UiStatus {
  std::string text;
  double age = 0.0;            // seconds
  bool withPanelOnly = false;  // the window is saved as a picture: without the panel there is nothing to be read
};
inline constexpr double statusSeconds = 8.0;  // that it is shown, fading in the last one

inline float statusAlpha(double age) {
  return static_cast<float>(std::clamp(statusSeconds - age, 0.0, 1.0));
}

inline constexpr double timeStep = 1.0 / 60.0;  // seconds, of a single step
inline constexpr double slowestTime = 1.0 / 64.0;
inline constexpr double fastestTime = 64.0;

enum class CameraMode { fly, orbit };

// What the panel shows and edits. The application fills it before every frame and reads back what was changed.
struct UiModel {
  UiDevice device;
  UiLog log;
  bool copyLog = false;                   // set by the panel: put the lines that are shown into the clipboard
  std::vector<std::string> presentModes;  // that the window offers
  int presentMode = 0;                    // index into presentModes; changed by the person
  std::vector<std::string> scenes;        // names
  std::vector<std::string> sceneTitles;   // of the same
  std::vector<std::string> scenePaths;    // likewise
  int scene = 0;                          // index into scenes; changed by the person
  Settings settings;
  Settings sceneSettings;           // as the scene and the command line have them: what a reset goes back to
  bool sceneSky = false;            // shown in the place of the clear colour while none is set
  glm::vec3 sceneBackground{0.0f};  // linear; shown as the clear colour while none is set
  CameraMode cameraMode = CameraMode::orbit;
  bool paused = false;
  bool resetCamera = false;    // set by the panel
  bool resetSettings = false;  // set by the panel
  double time = 0.0;           // seconds of animation
  double timeSpeed = 1.0;      // seconds of animation a second; changed by the person
  std::optional<double> seek;  // set by the panel: seconds of animation to go to
  double frameMs = 0.0;        // smoothed
  double cpuMs = 0.0;
  double gpuMs = 0.0;
  FrameHistory history;      // of each frame drawn
  bool copyHistory = false;  // set by the panel: put its CSV into the clipboard
  uint64_t deviceBytes = 0;
  int validationMessages = -1;  // -1: the layer is off
  std::vector<UiPass> passes;   // in the order of recording; with reflection.update_interval, of that many frames
  std::vector<UiSkipped> skipped;
  std::vector<UiEffect> effects;                           // all, in a fixed order
  std::vector<std::pair<std::string, PixelRect>> widgets;  // where each setting's widget stands, by key
  int hoveredSkipped = -1;                                 // likewise, into skipped
  std::vector<int> outlinedSkipped;                        // path of the one that was pointed at in the last frame
  std::vector<PixelLine> skippedOutline;                   // where its mirror is seen, on the picture
  int hoveredPass = -1;      // index into passes of the one that is pointed at; -1: none. Set by the panel.
  int debugPass = -1;        // index into passes of the target to show; -1: none. Changed by the person.
  bool passClicked = false;  // set by the panel: debugPass was changed by a click on a pass
  UiTargets targets;
  std::optional<PixelRect> debugArea;  // pixels of the display image where it is to be drawn; set by the panel
  UiAccuracy accuracy;
  UiEdit edit;
  std::vector<std::string> bookmarks;  // of the scene
  int bookmark = -1;                   // the one that was gone to last
  std::optional<int> goToBookmark;     // set by the panel
  bool bookmarkView = false;           // set by the panel
  bool removeBookmark = false;         // set by the panel: the one that was gone to last
  bool copyCommand = false;            // set by the panel: put the command line of this view into the clipboard
  bool help = false;                   // the list of keys is open; changed by the person
  bool screenshot = false;             // set by the panel: save the window as a picture
  UiStatus status;
  std::string loading;         // the file that is read in the background; empty: none
  double loadingDone = 0.0;    // share, 0 .. 1
  bool cancelLoading = false;  // set by the panel
  std::string message;         // an error to show until the next one, e.g. of a shader or a scene
};

inline std::vector<LogLine> shownLog(const UiModel& model) {
  return model.log.history->lines(model.log.least, model.log.filter.data());
}

}  // namespace speculum
