#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/projection.hpp"
#include "plan/depth_readout.hpp"
#include "plan/effects.hpp"
#include "plan/frame_plan.hpp"
#include "ui/commands.hpp"
#include "ui/frame_history.hpp"
#include "ui/log_history.hpp"

namespace speculum {

// Everything that panels show. A class of src/window fills each struct: the one whose shown() or fill() has its type.

struct PassRow : PassId {
  std::string name;
  int framesAgo = 0;    // frames since the pass ran
  bool reused = false;  // without a pass, the frame that drew the scene last showed an image of an earlier frame
  double gpuMs = 0.0;   // NaN until it was timed
  bool timed = false;   // `gpuMs` is of the frame of ShownFrame::timedGpuMs, not of an earlier one
  double areaPx = 0.0;
  uint32_t draws = 0;
  std::optional<DepthReadout> resolution;  // a mirror's, if it sees anything but the background
};

struct SkippedRow {
  std::string name;  // names of the mirrors from the eye
  MirrorPath path;   // indices of these mirrors in Scene::mirrors
  std::string reason;
  std::string detail;
  bool byRays = false;  // rays show its reflection
};

struct EffectRow : Effect, EffectCost {};

// The target that UiOutput::target requested, in the last complete picture.
struct ShownTarget {
  MirrorPath path;                              // of the pass
  bool complete = false;                        // the target has been drawn
  double share = 0.0;                           // of the picture that is being drawn
  glm::ivec2 size{0};                           // texels
  std::vector<glm::vec2> mask;                  // polygon around the texels that the pass shades
  std::vector<std::vector<glm::vec2>> mirrors;  // visible regions of the mirrors seen in it, texels
  double near = 0.0;                            // metres from the eye to the near plane
  std::optional<TexelValue> value;              // of the texel under the pointer, a few frames later
};

// Figures of the frame that drew the scene last.
struct ShownFrame {
  double frameMs = 0.0;  // smoothed, unless the picture is `still`
  bool still = false;    // later frames draw the panels only, or parts of a picture that is not complete
  double cpuMs = 0.0;
  double gpuMs = 0.0;
  double timedGpuMs = 0.0;  // of the last frame whose passes were timed; 0: none, or of another picture
  FrameHistory history;
  uint64_t deviceBytes = 0;     // device memory that the program has allocated
  uint64_t budgetBytes = 0;     // see MemoryBudget
  uint64_t usedBytes = 0;       // see MemoryBudget
  int validationMessages = -1;  // -1: the layer is off
  std::vector<PassRow> passes;  // in the order of recording; with reflection.update_interval, of that many frames
  std::vector<SkippedRow> skipped;
  std::vector<EffectRow> effects;  // all, in a fixed order
  std::string rays;                // how rays are traced and why; empty: none are
  ShownTarget target;
  MirrorPath outlinedPath;         // of the mirror that is outlined; empty: none
  std::vector<PixelLine> outline;  // where that mirror is, or would be, seen on the picture
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
  size_t presentMode = 0;                 // index into presentModes
};

struct SceneEntry {
  std::string name;
  std::string title;  // empty for a model
  std::filesystem::path file;
};

struct ShownScenes {
  std::vector<SceneEntry> scenes;
  size_t shown = 0;                           // index into scenes
  std::string loading;                        // file that is read in the background; empty: none
  double loaded = 0.0;                        // share of the loading that is done, 0 .. 1
  bool poster = false;                        // the shown scene's thumbnail stands in the picture's place
  std::vector<std::filesystem::path> recent;  // opened or saved, the last one first
};

struct ShownCamera {
  CameraMode mode = CameraMode::orbit;
  int bookmark = -1;  // index into Scene::bookmarks of the last one used; -1: none
};

inline constexpr double timeStep = 1.0 / 60.0;     // seconds, of a single step
inline constexpr double slowestTime = 1.0 / 64.0;  // bounds of ShownPlayback::speed
inline constexpr double fastestTime = 64.0;

struct ShownPlayback {
  double time = 0.0;   // seconds of animation
  double speed = 1.0;  // seconds of animation a second
  bool paused = false;
  std::string cost;  // label of a button to play, with what that costs; empty: nothing to speak of
};

// Shapes that are drawn over the picture, in pixels of the picture.
struct ShownOverlay {
  std::vector<PixelLine> outline;  // around the selected node, or its image that was clicked
  std::vector<PixelLine> itself;   // around the node itself, if its image was clicked
  std::vector<GizmoShape> gizmo;
  Grip active = Grip::none;  // handle that is hovered or dragged
  std::string label;         // distance or angle of the drag
  glm::dvec2 labelAt{0.0};   // where the pointer is
};

enum class Prompt { none, unsavedChanges, saveAs, open, addObject, recovery };

// The scene as it is edited.
struct ShownEdit {
  const Scene* scene = nullptr;  // must live as long as this
  Selection selected;
  std::vector<Selection> others;  // selected together with `selected`
  MirrorPath through;             // mirrors that `selected` was picked through, from the eye
  GizmoMode mode = GizmoMode::move;
  std::vector<std::filesystem::path> models;      // models of objects that a user can add
  std::string undo;                               // label of the step that Undo takes back; empty: none
  std::string redo;                               // label of the step that Redo repeats; empty: none
  bool unsaved = false;                           // scene or settings have changes to save
  bool isNew = false;                             // a model or a new scene, which has no file yet
  std::optional<std::filesystem::path> saveFile;  // file that Save writes; none: Save asks for one
  Prompt prompt = Prompt::none;
  std::string afterPrompt;             // what the answer to unsavedChanges leads to, as in "quitting"
  std::filesystem::path proposedFile;  // for Prompt::saveAs and recovery; a folder for open
  std::filesystem::path ownFile;       // the scene's, or what the copy is of that is shown or proposed; empty: unknown
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
  std::optional<Settings> own;  // settings from before the user picked a point; none: no point was picked
  int current = -1;             // index of the point that the settings are at; -1: none
  int chosen = -1;              // index of the point that a bound chose, while the settings are at it; -1: none
  double noiseFloor = 0.0;      // mean FLIP
  std::string about;            // what was measured, where
  bool alone = false;           // the picture shows the current point, as one picture without a mean
  bool otherView = false;       // the user changed camera or time since the measurement
  double secondsLeft = 0.0;     // until the stage that runs ends; 0: not known
  bool measuring = false;
  std::string stage;                 // of the measurement that runs
  double progress = 0.0;             // of the measurement, 0 .. 1
  std::string choice;                // text: point chosen by the budget, beside the most accurate one
  bool choiceMisses = false;         // no measured point meets the bounds
  std::string difference;            // text: error of the picture, or progress of the difference map
  std::vector<double> mirrorErrors;  // by mirror: mean FLIP of the difference map in its outline; NaN: not in view
  std::vector<glm::vec3> heatBar;    // colors from no error to an error of 1, display sRGB
};

// A | B: two sets of settings, side by side, and the lessons that show such pairs.
struct ShownSplit {
  bool on = false;
  int chosen = 1;        // half whose settings the panels edit: 0 is A, on the left, 1 is B
  double divider = 0.5;  // share of the picture's width to its left
  struct Half {
    std::vector<SettingChange> differs;  // its values of the settings that differ from the other half's
    double gpuMs = 0.0;                  // of its last picture of the scene; 0: not known
    int pictures = 1;                    // in its mean, each of which takes gpuMs
    std::optional<double> error;         // mean FLIP; none until both still pictures are complete and compared
    bool ofReference = false;            // `error` is against the reference, else against the other half
    std::string picture;                 // what it gives up, or how far it has converged
  };
  std::array<Half, 2> halves;
  struct LessonEntry {
    std::filesystem::path scene;
    std::string title;
    std::string text;
    std::string lookFor;
  };
  std::vector<LessonEntry> lessons;
  std::optional<size_t> lesson;  // index of the one that is shown
};

struct ShownStatus {
  std::string text;
  double age = 0.0;           // seconds
  std::string picture;        // how the picture is drawn, if it is not exact; shown with the panel only
  bool savesPicture = false;  // the window is saved as a picture: without panels `text` is hidden
};
inline constexpr double statusSeconds = 8.0;  // time for which a text is shown, fading in the last second
float statusAlpha(double age);                // opacity of a text that is `age` seconds old

// Everything that the panels show of the program. Made for each frame; refers to values that others own.
struct UiInput {
  const ShownFrame& frame;
  const ShownDevice& device;
  const ShownScenes& browser;
  const Settings& settings;       // of A | B: those of the chosen half
  const Settings& sceneSettings;  // values of the scene and the command line, to which a reset returns
  const ShownCamera& camera;
  const ShownPlayback& playback;
  const ShownEdit& edit;
  const ShownAccuracy& accuracy;
  const ShownSplit& split;
  const ShownStatus& status;
  const LogHistory& log;
  std::string message;  // an error to show until the next one, e.g. of a shader or a scene
  bool recording = false;
};

// Request to draw a pass's target over the picture.
struct TargetRequest {
  MirrorPath path;        // of the pass: mirrors from the eye; empty: the main view
  bool drawn = false;     // else only ShownTarget is wanted
  TargetDisplay display;  // all but its pass
};

// Commands from the panels of one frame, and their requests for the next frame.
struct UiOutput {
  std::vector<Command> commands;
  std::optional<TargetRequest> target;
  MirrorPath hoveredPath;           // of the mirror that is to be outlined; empty: none
  bool points = false;              // points of measurements are shown, and can be picked
  std::optional<double> errorGain;  // of the difference map over the picture; none: no map is wanted
  bool refusedEdit = false;         // the panels show an edit that could not be applied
};

}  // namespace speculum
