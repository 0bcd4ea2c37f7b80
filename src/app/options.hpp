#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/renderer.hpp"
#include "scene/scene.hpp"

namespace speculum {

struct PictureSize {
  int width = 1280;
  int height = 720;
};

// The command line, parsed and checked. The scene's [settings] are added when the scene is loaded.
struct Options {
  std::string command = "demo";
  std::string scene;  // empty: the default scene
  PictureSize size;
  std::vector<std::pair<std::string, std::string>> settings;  // --set key=value, in order
  std::filesystem::path out;
  std::filesystem::path stats;
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
  std::string logLevel = "warn";
  std::filesystem::path shaderDir;
  PresentMode presentMode = PresentMode::fifo;
  std::filesystem::path reference;  // compare
  std::filesystem::path test;
  std::filesystem::path mask;
  std::filesystem::path heatmap;
  std::optional<double> maxFlip;
  std::optional<int> maxDiff;
  std::string sweep = "quick";          // accuracy: quick, full or a file
  std::filesystem::path sweepResults;   // results.json of an earlier sweep; empty: none
  bool benchReference = false;          // bench: measures the ray tracer instead of the renderer
  bool benchPrices = false;             // bench: measures the cost of each effect too
  std::filesystem::path againstBinary;  // bench: another speculum to measure in turn; empty: none
  std::vector<std::pair<std::string, std::string>> againstSettings;  // bench: settings to measure in turn; may be none
  int benchRounds = 7;                                               // bench: runs of each of the two
  std::vector<std::string> benchArguments;  // those of bench without what it is measured against, and without --json
};

// Bad usage; what() is one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Parses the command line. Returns nothing when help or the version was printed. Throws UsageError.
std::optional<Options> parseOptions(int argc, const char* const* argv);

}  // namespace speculum
