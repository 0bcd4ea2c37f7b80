#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "core/renderer.hpp"

namespace speculum::examples {

// Values that the panel shows and changes.
struct UiState {
  glm::vec3 clearColor{0.0f};  // linear
  bool settings = false;       // the Settings checkbox: shows the rows below
  bool* naive = nullptr;       // null: no such row
  int* depth = nullptr;
  int mostDepth = 0;
};

// Dear ImGui in a window: a small panel with the frame's milliseconds, frames per second, and the values above.
class SimpleUI {
 public:
  SimpleUI(Renderer& renderer, Window& window);
  // Returns null without a window.
  static std::unique_ptr<SimpleUI> forWindow(Renderer& renderer, Window* window) {
    return window ? std::make_unique<SimpleUI>(renderer, *window) : nullptr;
  }
  ~SimpleUI();
  SimpleUI(const SimpleUI&) = delete;
  SimpleUI& operator=(const SimpleUI&) = delete;

  void build(UiState& state);           // once a frame
  void record(Frame& frame) const;      // draws the panel over the display image
  float turn() const { return turn_; }  // radians that the mouse has turned the camera by, dragging the picture

 private:
  bool inRenderPass() const;

  Renderer& renderer_;
  DescriptorPoolHandle pool_;
  float turn_ = 0.0f;
  IdleGuard idle_;
};

}  // namespace speculum::examples
