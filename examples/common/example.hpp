#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>

#include "core/renderer.hpp"
#include "platform/window.hpp"

// Arguments, the window's loop and the finished picture. Every example needs them; the mirrors are clear without them.
namespace speculum::examples {

struct Options {
  std::string name;            // of the example
  std::filesystem::path out;   // PNG; empty: a window is opened
  VkExtent2D size{1280, 720};  // pixels
  std::optional<double> time;  // seconds; without it a window plays, and a picture shows the beginning
  std::optional<int> frames;   // without it a window stays open, and a picture takes one
  bool naive = false;          // draws the mirror as most demos do
  bool shaderObjects = false;  // in the place of pipelines
  RenderPath renderPath = RenderPath::automatic;
  bool validation = false;

  std::unique_ptr<Window> openWindow() const;  // null if a picture is written
  DeviceOptions device(Window* window) const;
  RendererOptions renderer(Window* window) const;  // finds the example's SPIR-V beside the executable
  // Finds a model by its path from the example's folder, as the scene file there names it.
  std::filesystem::path model(const std::string& path) const;
};

// Handles the window's events, waits while it is minimised, and counts frames. Esc ends it.
class Loop {
 public:
  Loop(const Options& options, Window* window) : options_(options), window_(window) {}

  bool next();                                                            // says whether there is a frame to draw
  double time() const { return options_.time.value_or(shown_.count()); }  // seconds of animation, one value a frame

 private:
  const Options& options_;
  Window* window_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::duration<double> shown_{0.0};  // from start_ to this frame
  int frames_ = 0;
};

// Returns a clear color for an OffScreen, which holds linear light, or for the window's images, which hold sRGB.
std::array<float, 4> radiance(const glm::vec3& linear);
std::array<float, 4> displayed(const glm::vec3& linear);

struct Drawn {
  Pixels picture;      // without pixels after a window
  double gpuMs = 0.0;  // of the last frame
  int validationMessages = 0;
};
// Waits for the last frame and reads it back if it was drawn for a picture.
Drawn finish(Renderer& renderer);

// Parses the arguments, runs the example and returns the exit code: 1 after a message of the validation layer, 2 with
// one line for bad usage and for what `run` throws. Examples without a scene file take no --naive.
int exampleMain(int argc, char** argv, const std::string& name, Drawn (*run)(const Options&));

}  // namespace speculum::examples
