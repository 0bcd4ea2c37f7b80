#pragma once

#include <glm/glm.hpp>
#include <map>
#include <set>
#include <string>

namespace speculum {

// Places windows along the left and right edge of the display, those of an edge below each other, until a person moves
// them. What was moved keeps its place, also in the layout file; the others follow the display's size and each other.
class PanelDock {
 public:
  enum class Edge { left, right };

  // Makes the layout file of the present ImGui context say which windows are collapsed; once, before its first frame.
  // The dock must outlive the context.
  void rememberCollapsed();
  // In each ImGui frame before the first begin().
  void beginFrame();
  // ImGui::Begin with a size in sizes of the font; a height of 0 reaches down to the display's edge. ImGui::End must
  // follow whatever it returns.
  bool begin(const char* name, bool* open, Edge edge, const glm::vec2& ems, int windowFlags = 0);

 private:
  struct Panel {
    bool docked = true;
    glm::vec2 size{0.0f};   // pixels; what the person made of it, 0: nothing
    glm::vec2 given{0.0f};  // pixels; what it was given last
    glm::vec2 corner{-1.0f};
    bool begun = false;
  };
  // Where the next window of an edge goes.
  struct Column {
    float inset = 0.0f;  // pixels from the edge
    float top = 0.0f;
    float width = 0.0f;  // of the widest window in it
  };
  Panel& panel(const char* name);
  void place(Panel& panel, Edge edge, const glm::vec2& ems);
  void follow(Panel& panel, Edge edge);

  void followCollapsed(const char* name, Panel& panel);

  std::map<std::string, Panel> panels_;
  std::set<std::string> collapsed_;  // docked ones
  Column left_;
  Column right_;
};

}  // namespace speculum
