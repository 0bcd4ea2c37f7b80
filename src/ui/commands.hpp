#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "edit/gizmo.hpp"
#include "edit/transform.hpp"
#include "settings/settings.hpp"

namespace speculum {

enum class CameraMode { fly, orbit };
enum class MirrorSide { back, front };

// Camera.
struct ResetCamera {};
struct ToggleCameraMode {};
struct SetCameraMode {
  CameraMode mode = CameraMode::orbit;
};
struct FrameSelection {};  // looks at the selected node, or at the whole scene
struct LookFromMirror {    // the selected mirror, or the one that fills most of the picture
  MirrorSide side = MirrorSide::back;

  bool operator==(const LookFromMirror&) const = default;
};
struct AddBookmark {};
struct GoToBookmark {
  size_t index = 0;
};
struct GoToNextBookmark {};
struct RemoveBookmark {
  size_t index = 0;
};

// Animation.
struct Seek {
  double seconds = 0.0;
};
struct StepTime {  // pauses, and goes on by steps of timeStep
  int steps = 0;
};
struct SetPaused {
  bool paused = false;
};
struct TogglePaused {};
struct SetTimeSpeed {
  double factor = 1.0;
};
struct MultiplyTimeSpeed {
  double factor = 1.0;
};

// Settings.
struct SetSettings {
  Settings settings;
  bool continued = false;  // the widget of the last SetSettings is still held: one step of undo
};
struct ResetSettings {};

// A | B.
enum class SplitStart {
  current,  // A and B begin with the settings in use
  naive,    // B begins with the settings of most mirror demos
  point     // B begins with the picked point, A with the settings from before, which are ShownAccuracy::own
};
struct ToggleSplit {  // begins A | B, or ends it with SplitStart::current
  SplitStart start = SplitStart::current;

  bool operator==(const ToggleSplit&) const = default;
};
struct ChooseHalf {  // whose settings SetSettings changes
  int half = 0;      // 0 is A, 1 is B
};
struct ChooseOtherHalf {};
struct MoveDivider {
  double share = 0.5;  // of the picture's width, to the left
};
struct KeepHalf {};  // the chosen half's settings become those of the scene, and A | B ends

// Files.
struct NewScene {};
struct AskWhatToOpen {};
struct AskWhatToAdd {};  // asks for the model of an object
struct OpenScene {
  std::filesystem::path file;
  std::optional<size_t> lesson = {};  // begins this one of ShownSplit::lessons, whose scene the file is
};
struct OpenDropped {
  std::vector<std::filesystem::path> files;
};
struct CancelLoading {};
struct Save {};
struct AskWhereToSave {};
struct SaveAs {
  std::filesystem::path file;
  bool copyModels = false;  // copies the models beside the file, with their materials and textures
};
struct DiscardChanges {};
struct CancelPrompt {};
struct Quit {};

// Editing.
struct SelectNode {
  Selection node;
  bool inspect = true;  // opens the inspector
};
struct ToggleNode {  // adds the node to the selected ones, or takes it out
  Selection node;
};
struct SelectNext {
  int step = 1;
};
struct SetGizmoMode {
  GizmoMode mode = GizmoMode::move;
};
struct NextGizmoMode {};
struct EditNode {
  Selection target;
  SceneNode node;          // of the target's kind
  bool continued = false;  // a widget is held: edits until EndEdit belong to one step of undo
};
struct EditCamera {
  CameraSpec camera;
  bool continued = false;  // as of EditNode
};
struct TakeView {};  // makes the view of the window the scene's camera
struct EndEdit {};
struct AddMirror {};
struct AddLight {};
struct AddObject {
  std::filesystem::path model;  // absolute, or from the scene's folder
};
struct DuplicateSelected {};
struct RemoveSelected {};
struct Undo {};
struct Redo {};

// Accuracy.
struct MeasureAccuracy {};
struct CancelMeasurement {};
struct ApplyPoint {
  int point = -1;
};

// Output.
struct TakeScreenshot {
  bool withPanel = false;

  bool operator==(const TakeScreenshot&) const = default;
};
struct ToggleRecording {
  bool withPanel = true;

  bool operator==(const ToggleRecording&) const = default;
};
struct CopyCommandLine {};
struct CopyText {
  std::string text;
};

// The window and its panels.
struct SetPresentMode {
  size_t index = 0;  // into ShownDevice::presentModes
};
struct ToggleFullScreen {};
struct TogglePanel {};
struct ToggleHelp {};
struct ToggleInspector {};
struct Escape {};  // cancels a drag, closes what is on top, deselects, or dismisses the message
struct DismissMessage {};
struct PauseHistory {
  bool paused = false;
};
struct ClearHistory {};
struct ClearLog {};

// One action of the user. Panels, keys and the gamepad make commands; Workspace::apply carries them out.
using Command = std::variant<ResetCamera, ToggleCameraMode, SetCameraMode, FrameSelection, LookFromMirror, AddBookmark,
                             GoToBookmark, GoToNextBookmark, RemoveBookmark, Seek, StepTime, SetPaused, TogglePaused,
                             SetTimeSpeed, MultiplyTimeSpeed, SetSettings, ResetSettings, ToggleSplit, ChooseHalf,
                             ChooseOtherHalf, MoveDivider, KeepHalf, NewScene, AskWhatToOpen, AskWhatToAdd, OpenScene,
                             OpenDropped, CancelLoading, Save, AskWhereToSave, SaveAs, DiscardChanges, CancelPrompt,
                             Quit, SelectNode, ToggleNode, SelectNext, SetGizmoMode, NextGizmoMode, EditNode,
                             EditCamera, TakeView, EndEdit, AddMirror, AddLight, AddObject, DuplicateSelected,
                             RemoveSelected, Undo, Redo, MeasureAccuracy, CancelMeasurement, ApplyPoint, TakeScreenshot,
                             ToggleRecording, CopyCommandLine, CopyText, SetPresentMode, ToggleFullScreen, TogglePanel,
                             ToggleHelp, ToggleInspector, Escape, DismissMessage, PauseHistory, ClearHistory, ClearLog>;

// Functions for std::visit(), one for each type of command.
template <typename... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;  // clang before version 17 needs this guide

}  // namespace speculum
