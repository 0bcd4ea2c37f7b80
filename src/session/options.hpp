#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/renderer.hpp"
#include "image/image.hpp"
#include "scene/scene.hpp"
#include "settings/settings.hpp"

namespace speculum {

struct WindowArguments {
  PresentMode presentMode = PresentMode::fifo;
  std::optional<std::string> platform;  // x11 or wayland
};

struct RenderArguments {
  std::filesystem::path stats;                   // empty: none
  std::optional<std::filesystem::path> capture;  // file for RenderDoc's capture of the first picture
};

struct CompareArguments {
  std::filesystem::path reference;
  std::filesystem::path test;
  std::filesystem::path mask;     // empty: none
  std::filesystem::path heatmap;  // empty: none
  std::optional<double> maxFlip;
  std::optional<int> maxDiff;
};

struct BenchArguments {
  int warmup = 10;
  bool tracer = false;  // measures the ray tracer instead of the renderer
  bool prices = false;  // measures the cost of each effect too
};

struct RegressArguments {
  std::filesystem::path cases;
  std::string filter = "*";           // of the cases' names
  int jobs = 0;                       // worker processes; 0: by the processor
  int repeat = 1;                     // pictures of each case, which must be equal
  std::optional<std::string> update;  // names of the cases whose expected pictures are replaced
  std::filesystem::path junit;        // empty: none
  bool worker = false;                // draws the cases whose indices come on standard input
};

// The command line, parsed and checked: what several commands take, then a member for what a single command takes. The
// scene's [settings] are added when the scene is loaded.
struct Options {
  std::string command = "demo";
  std::vector<std::string> arguments;  // of the command line, without the program

  std::vector<std::pair<std::string, std::string>> settings;  // --set key=value, in order
  std::string gpu;
  RenderPath renderPath = RenderPath::automatic;
  bool validation = false;
  std::string logLevel = "warn";
  std::filesystem::path shaderDir;

  std::string scene;  // empty: the default scene
  PictureSize size{1280, 720};
  double time = 0.0;                   // seconds
  std::optional<Bookmark> camera;      // replaces the scene's; without a name
  std::string bookmark;                // name of a bookmark whose view replaces the camera's; empty: none
  int frames = 0;                      // 0: the command's default
  double fps = 30.0;                   // frames per second of animation
  bool strict = false;                 // defects of models are errors
  std::filesystem::path out;           // empty: none
  std::filesystem::path json;          // empty: none
  std::filesystem::path sweepResults;  // results.json of an earlier sweep; empty: none
  // Where camera and bookmark stand, for errors.
  std::string cameraPlace = "--camera";

  WindowArguments window;  // of the command demo
  RenderArguments render;
  int referenceSamples = 64;  // a pixel
  CompareArguments compare;
  std::string sweep;   // accuracy: quick, full, motion or a file
  std::string motion;  // accuracy: scene, or a file of a camera path; empty: a still picture
  RegressArguments regress;
  BenchArguments bench;
};

// Bad usage; what() is one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Adds --set for each of the settings.
void addSettings(std::span<const std::pair<std::string, std::string>> settings, std::vector<std::string>& arguments);

// Adds those of the options that are about the device and its shaders, if they were given.
void addDevice(const Options& options, std::vector<std::string>& arguments);

// Returns a shell command of `speculum render` that draws the view of `options` with `settings` to the same bytes. The
// command has scene, size, time, camera, device, and every setting that is not the scene's own, but neither quality.*,
// whose choice is among the other settings already, nor view.continuous, which only the window uses. `file` holds the
// scene that the picture shows: the scene's own file or a copy with the same [settings].
std::string viewCommand(const Options& options, const std::filesystem::path& file, const Scene& scene,
                        const Settings& settings);

}  // namespace speculum
