#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "frame/settings.hpp"
#include "optics/projection.hpp"

namespace speculum {

struct UiPass {
  std::string name;
  std::vector<int> path;  // mirrors from the eye, indices into Scene::mirrors; empty for other passes
  int depth = -1;         // -1: not a mirror's
  int framesAgo = 0;      // since it ran
  double gpuMs = 0.0;
  double areaPx = 0.0;
  uint32_t draws = 0;
};

struct UiSkipped {
  std::string path;  // mirrors from the eye
  std::string reason;
  std::string detail;
};

enum class CameraMode { fly, orbit };

// What the panel shows and edits. The application fills it before every frame and reads back what was changed.
struct UiModel {
  std::string device;
  std::string driver;
  std::string renderPath;
  std::vector<std::string> scenes;  // names
  int scene = 0;                    // index into scenes; changed by the person
  Settings settings;
  glm::vec3 sceneBackground{0.0f};  // linear; shown as the clear colour while none is set
  CameraMode cameraMode = CameraMode::orbit;
  bool paused = false;
  bool resetCamera = false;    // set by the panel
  bool resetSettings = false;  // set by the panel
  double time = 0.0;           // seconds of animation
  double frameMs = 0.0;        // smoothed
  double cpuMs = 0.0;
  double gpuMs = 0.0;
  uint64_t deviceBytes = 0;
  int validationMessages = -1;  // -1: the layer is off
  std::vector<UiPass> passes;   // in the order of recording; with reflection.update_interval, of that many frames
  std::vector<UiSkipped> skipped;
  std::vector<std::pair<std::string, PixelRect>> widgets;  // where each setting's widget stands, by key
  int debugPass = -1;                  // index into passes of the image to show; -1: none. Changed by the person.
  std::optional<PixelRect> debugArea;  // pixels of the display image where it is to be drawn; set by the panel
  std::string message;                 // an error to show until the next one, e.g. of a shader or a scene
};

}  // namespace speculum
