#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/renderer.hpp"
#include "image/image.hpp"
#include "scene/scene.hpp"

namespace speculum {

// The command line, parsed and checked. The scene's [settings] are added when the scene is loaded.
struct Options {
  std::string command = "demo";
  std::string scene;  // empty: the default scene
  PictureSize size{1280, 720};
  std::vector<std::pair<std::string, std::string>> settings;  // --set key=value, in order
  std::filesystem::path out;
  std::filesystem::path stats;
  std::optional<std::filesystem::path> capture;  // render: RenderDoc's, of the first picture
  std::filesystem::path json;
  double time = 0.0;               // seconds
  std::optional<Bookmark> camera;  // replaces the scene's; without a name
  std::string bookmark;            // name of a bookmark whose view replaces the camera's; empty: none
  int frames = 0;                  // 0: the command's default
  double fps = 30.0;
  int warmup = 10;
  int samples = 64;
  std::string gpu;
  RenderPath renderPath = RenderPath::automatic;
  bool validation = false;
  bool strict = false;  // render, reference, regress: defects of models are errors
  std::string logLevel = "warn";
  std::filesystem::path shaderDir;
  PresentMode presentMode = PresentMode::fifo;
  std::optional<std::string> platform;  // of the window: x11 or wayland
  std::filesystem::path reference;      // compare
  std::filesystem::path test;
  std::filesystem::path mask;
  std::filesystem::path heatmap;
  std::optional<double> maxFlip;
  std::optional<int> maxDiff;
  std::string sweep = "quick";         // accuracy: quick, full or a file
  std::filesystem::path sweepResults;  // results.json of an earlier sweep; empty: none
  bool benchReference = false;         // bench: measures the ray tracer instead of the renderer
  bool benchPrices = false;            // bench: measures the cost of each effect too
  std::filesystem::path cases;         // regress
  std::string filter = "*";            // of the cases' names
  int jobs = 0;                        // worker processes; 0: by the processor
  int repeat = 1;                      // pictures of each case, which must be equal
  std::optional<std::string> update;   // names of the cases whose expected pictures are replaced
  std::filesystem::path junit;         // empty: none
  bool worker = false;                 // draws the cases whose indices come on standard input
  std::vector<std::string> arguments;  // of the command line, without the program
};

// Bad usage; what() is one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Takes the text of --camera: points, or the name of a bookmark. Throws UsageError.
void setCamera(Options& options, const std::string& text);

// Parses the command line. Returns nothing when help or the version was printed. Throws UsageError.
std::optional<Options> parseOptions(int argc, const char* const* argv);

}  // namespace speculum
