#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/projection.hpp"
#include "plan/depth_readout.hpp"
#include "plan/effects.hpp"
#include "plan/frame_plan.hpp"
#include "plan/target_display.hpp"
#include "ui/commands.hpp"
#include "ui/frame_history.hpp"
#include "ui/log_history.hpp"

namespace speculum {

// Everything that panels show. A class of src/window fills each struct: the one whose shown() or fill() has its type.

struct PassRow : PassId {
  std::string name;
  int framesAgo = 0;    // since it ran
  bool reused = false;  // by the frame that drew the scene last: no pass, the image of an earlier frame
  double gpuMs = 0.0;   // NaN until it was timed
  bool timed = false;   // `gpuMs` is of the frame that ShownFrame::timedGpuMs is of, not of an earlier one
  double areaPx = 0.0;
  uint32_t draws = 0;
  std::optional<DepthReadout> resolution;  // a mirror's, if it sees anything but the background
};

struct SkippedRow {
  std::string name;  // mirrors from the eye
  MirrorPath path;   // indices of these in Scene::mirrors
  std::string reason;
  std::string detail;
  bool byRays = false;  // rays show its reflection
};

struct EffectRow : Effect, EffectCost {};

// The target that UiOutput::target requested, in the last complete picture.
struct ShownTarget {
  MirrorPath path;                              // of the pass
  bool complete = false;                        // else it has not been drawn yet
  glm::ivec2 size{0};                           // texels
  std::vector<glm::vec2> mask;                  // texels that the pass shades
  std::vector<std::vector<glm::vec2>> mirrors;  // visible regions of the mirrors seen in it, texels
  double near = 0.0;                            // metres from the eye to the near plane
  std::optional<TexelValue> value;              // under the pointer, a few frames later
};

// Figures of the frame that drew the scene last.
struct ShownFrame {
  double frameMs = 0.0;  // smoothed, unless it is still
  bool still = false;    // later frames draw the panels only, or parts of a picture that is not complete
  double cpuMs = 0.0;
  double gpuMs = 0.0;
  double timedGpuMs = 0.0;  // of the last frame whose passes were timed; 0: none, or of another picture
  FrameHistory history;
  uint64_t deviceBytes = 0;
  uint64_t budgetBytes = 0;
  uint64_t usedBytes = 0;
  int validationMessages = -1;  // -1: the layer is off
  std::vector<PassRow> passes;  // in the order of recording; with reflection.update_interval, of that many frames
  std::vector<SkippedRow> skipped;
  std::vector<EffectRow> effects;  // all, in a fixed order
  std::string rays;                // how they are traced and why; empty: none are
  ShownTarget target;
  MirrorPath outlinedPath;         // of the mirror that is outlined; empty: none
  std::vector<PixelLine> outline;  // where it is, or would be, seen on the picture
};

struct FeatureRow {
  std::string name;
  bool present = false;
  std::string about;  // "yes", or what is done without it
};

struct ShownDevice {
  std::string name;
  std::string kind;  // e.g. discrete GPU
  std::string driver;
  std::string vulkan;  // version
  std::string renderPath;
  std::vector<int> samples;  // supported counts a pixel, ascending
  std::vector<FeatureRow> features;
  std::vector<std::string> presentModes;  // that the window offers
  size_t presentMode = 0;                 // index into them
};

struct SceneEntry {
  std::string name;
  std::string title;  // empty for a model
  std::filesystem::path file;
};

struct ShownScenes {
  std::vector<SceneEntry> scenes;
  size_t shown = 0;                           // index into them
  std::string loading;                        // file that is read in the background; empty: none
  double loaded = 0.0;                        // share of it, 0 .. 1
  bool poster = false;                        // the shown scene's thumbnail stands in the picture's place
  std::vector<std::filesystem::path> recent;  // opened or saved, the last one first
};

struct ShownCamera {
  CameraMode mode = CameraMode::orbit;
  int bookmark = -1;  // of Scene::bookmarks, the last one used; -1: none
};

inline constexpr double timeStep = 1.0 / 60.0;  // seconds, of a single step
inline constexpr double slowestTime = 1.0 / 64.0;
inline constexpr double fastestTime = 64.0;

struct ShownPlayback {
  double time = 0.0;   // seconds of animation
  double speed = 1.0;  // seconds of animation a second
  bool paused = false;
  std::string cost;  // label of a button to play, with what that costs; empty: nothing to speak of
};

// Drawn over the picture, in its pixels.
struct ShownOverlay {
  std::vector<PixelLine> outline;  // around the selected node, or its image that was clicked
  std::vector<PixelLine> itself;   // around the node itself, if its image was clicked
  std::vector<GizmoShape> gizmo;
  Grip active = Grip::none;  // hovered or dragged
  std::string label;         // distance or angle of the drag
  glm::dvec2 labelAt{0.0};
};

enum class Prompt { none, unsavedChanges, saveAs, open, recovery };

// The scene as it is edited.
struct ShownEdit {
  const Scene* scene = nullptr;  // must live as long as this
  Selection selected;
  std::vector<Selection> others;  // selected together with it
  MirrorPath through;             // mirrors that it was picked through, from the eye
  GizmoMode mode = GizmoMode::move;
  std::vector<std::filesystem::path> models;  // models of objects that a user can add
  std::string undo;                           // label of the step; empty: none
  std::string redo;
  bool unsaved = false;                           // scene or settings have changes to save
  bool isNew = false;                             // a model or a new scene, which has no file yet
  std::optional<std::filesystem::path> saveFile;  // file that Save writes; none: it asks for one
  Prompt prompt = Prompt::none;
  std::string afterPrompt;             // what the answer to unsavedChanges leads to, as in "quitting"
  std::filesystem::path proposedFile;  // for Prompt::saveAs and recovery; a folder for open
  std::string note;                    // what was saved, or why it was not
  ShownOverlay overlay;

  bool canSave() const { return unsaved || isNew; }
};

// A measured configuration.
struct PointRow {
  std::string name;
  double error = 0.0;  // mean FLIP
  double ms = 0.0;     // GPU milliseconds a frame: median and quartiles
  double lowerMs = 0.0;
  double upperMs = 0.0;
};

struct ShownAccuracy {
  std::vector<PointRow> points;
  std::map<std::string, std::string, std::less<>> prices;  // by setting: its measured values with time and error
  std::vector<int> front;                                  // indices into points, cheapest first
  Settings own;                                            // the last ones that were not picked as a point
  int current = -1;                                        // the point that the settings are at; -1: none
  int chosen = -1;                                         // the point that a bound chose, if they still are; -1: none
  double noiseFloor = 0.0;                                 // mean FLIP
  std::string about;                                       // what was measured, where
  bool alone = false;                                      // the picture is one of the current point, without a mean
  bool otherView = false;                                  // the user changed the camera or the time since
  double secondsLeft = 0.0;                                // of the stage that runs; 0: not known
  bool measuring = false;
  std::string stage;                 // of the measurement that runs
  double progress = 0.0;             // of the measurement, 0 .. 1
  std::string choice;                // point chosen by the budget, beside the most accurate one
  bool choiceMisses = false;         // no measured point meets the bounds
  std::string difference;            // error of the picture, or progress of the difference map
  std::vector<double> mirrorErrors;  // by mirror: mean FLIP of the difference map in its outline; NaN: not in view
  std::vector<glm::vec3> heatBar;    // colors from no error to an error of 1, display sRGB
};

struct ShownStatus {
  std::string text;
  double age = 0.0;           // seconds
  std::string picture;        // how the picture is drawn, if it is not exact; shown with the panel only
  bool savesPicture = false;  // the window is saved as a picture: without panels `text` is hidden
};
inline constexpr double statusSeconds = 8.0;  // time for which it is shown, fading in the last second
float statusAlpha(double age);

// Everything that the panels show of the program. It refers to values of others and is made for each frame.
struct UiInput {
  const ShownFrame& frame;
  const ShownDevice& device;
  const ShownScenes& browser;
  const Settings& settings;
  const Settings& sceneSettings;  // values of the scene and the command line, to which a reset returns
  const ShownCamera& camera;
  const ShownPlayback& playback;
  const ShownEdit& edit;
  const ShownAccuracy& accuracy;
  const ShownStatus& status;
  const LogHistory& log;
  std::string message;  // an error to show until the next one, e.g. of a shader or a scene
};

// Request to draw a pass's target over the picture.
struct TargetRequest {
  MirrorPath path;        // of the pass: mirrors from the eye; empty: the main view
  bool drawn = false;     // else only ShownTarget is wanted
  TargetDisplay display;  // without the pass
};

// Commands from the panels of one frame, and their requests for the next frame.
struct UiOutput {
  std::vector<Command> commands;
  std::optional<TargetRequest> target;
  MirrorPath hoveredPath;           // of the mirror that is to be outlined; empty: none
  bool points = false;              // points of measurements are shown, and can be picked
  std::optional<double> errorGain;  // of the difference map that is wanted over the picture; none: it is not
  bool refusedEdit = false;         // an edit is shown that could not be applied
};

}  // namespace speculum
