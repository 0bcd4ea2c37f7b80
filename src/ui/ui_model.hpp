#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "frame/depth_readout.hpp"
#include "frame/settings.hpp"
#include "optics/projection.hpp"
#include "ui/edit_model.hpp"
#include "ui/frame_history.hpp"

namespace speculum {

struct UiPass {
  std::string name;
  std::vector<int> path;  // mirrors from the eye, indices into Scene::mirrors; empty for other passes
  int depth = -1;         // -1: not a mirror's
  int framesAgo = 0;      // since it ran
  double gpuMs = 0.0;
  double areaPx = 0.0;
  uint32_t draws = 0;
  std::optional<DepthReadout> resolution;  // a mirror's, if it sees anything but the background
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

inline constexpr double timeStep = 1.0 / 60.0;  // seconds, of a single step
inline constexpr double slowestTime = 1.0 / 64.0;
inline constexpr double fastestTime = 64.0;

enum class CameraMode { fly, orbit };

// What the panel shows and edits. The application fills it before every frame and reads back what was changed.
struct UiModel {
  std::string device;
  std::string driver;
  std::string renderPath;
  std::vector<std::string> scenes;       // names
  std::vector<std::string> sceneTitles;  // of the same
  int scene = 0;                         // index into scenes; changed by the person
  Settings settings;
  Settings sceneSettings;           // as the scene and the command line have them: what a reset goes back to
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
  int debugPass = -1;                  // index into passes of the image to show; -1: none. Changed by the person.
  std::optional<PixelRect> debugArea;  // pixels of the display image where it is to be drawn; set by the panel
  UiAccuracy accuracy;
  UiEdit edit;
  bool copyCommand = false;    // set by the panel: put the command line of this view into the clipboard
  std::string command;         // that was copied last
  bool help = false;           // the list of keys is open; changed by the person
  std::string picture;         // where the last screenshot is, or why it is not
  std::string loading;         // the file that is read in the background; empty: none
  double loadingDone = 0.0;    // share, 0 .. 1
  bool cancelLoading = false;  // set by the panel
  std::string message;         // an error to show until the next one, e.g. of a shader or a scene
};

}  // namespace speculum
