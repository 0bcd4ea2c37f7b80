// Outlines over the picture, and the handles of the selected nodes.
#include <imgui.h>

#include <algorithm>
#include <span>

#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr ImU32 shade = IM_COL32(0, 0, 0, 120);  // below lines, so that they show on any picture
constexpr ImU32 outlineColor = IM_COL32(255, 166, 48, 255);
constexpr ImU32 itselfColor = IM_COL32(255, 166, 48, 110);
constexpr ImU32 activeColor = IM_COL32(255, 224, 84, 255);
constexpr ImU32 centerColor = IM_COL32(235, 235, 235, 255);
constexpr ImU32 axisColors[] = {IM_COL32(236, 70, 74, 255), IM_COL32(104, 196, 70, 255), IM_COL32(64, 134, 246, 255)};
constexpr int behindAlpha = 90;
constexpr int planeAlpha = 120;

ImU32 withAlpha(ImU32 color, int alpha) {
  return (color & ~IM_COL32_A_MASK) | (static_cast<ImU32>(alpha) << IM_COL32_A_SHIFT);
}

class Painter {
 public:
  Painter()
      : list_(*ImGui::GetBackgroundDrawList()),
        pixels_(ImGui::GetIO().DisplayFramebufferScale),
        scale_(ImGui::GetFontSize() / 15.0f) {}

  void lines(std::span<const PixelLine> lines, ImU32 color, float width) {
    for (const PixelLine& line : lines) {
      list_.AddLine(at(line.a), at(line.b), color, scale_ * width);
    }
  }
  void shaded(std::span<const PixelLine> all, ImU32 color, float width) {
    lines(all, shade, width + 2.0f);
    lines(all, color, width);
  }
  void shape(const GizmoShape& shape, bool active) {
    const int axis = axisOf(shape.handle);
    const ImU32 color = active ? activeColor : axis < 0 ? centerColor : axisColors[axis];
    if (!shape.filled) {
      std::vector<PixelLine> all;
      for (size_t i = 0; i + 1 < shape.points.size(); i += 2) {
        all.push_back({shape.points[i], shape.points[i + 1]});
      }
      const float width = active ? 4.0f : 3.0f;
      shape.behind ? lines(all, withAlpha(color, behindAlpha), 2.0f) : shaded(all, color, width);
      return;
    }
    std::vector<ImVec2> points;
    for (const glm::dvec2& p : shape.points) {
      points.push_back(at(p));
    }
    const int count = static_cast<int>(points.size());
    list_.AddConvexPolyFilled(points.data(), count, isPlane(shape.handle) ? withAlpha(color, planeAlpha) : color);
    const ImU32 edge = isPlane(shape.handle) ? color : shade;
    list_.AddPolyline(points.data(), count, edge, ImDrawFlags_Closed, 1.5f * scale_);
  }
  // Draws the label beside `where`, but within `room`.
  void label(const std::string& text, const glm::dvec2& where, const WindowRect& room) {
    const glm::vec2 edge = scale_ * glm::vec2(6.0f, 4.0f);
    const ImVec2 letters = ImGui::CalcTextSize(text.c_str());
    const glm::vec2 size = glm::vec2(letters.x, letters.y) + 2.0f * edge;
    const glm::vec2 wish = glm::vec2(at(where).x, at(where).y) + 2.0f * edge;
    const glm::vec2 low = glm::max(glm::min(wish, room.corner + room.size - size), room.corner);
    list_.AddRectFilled({low.x, low.y}, {low.x + size.x, low.y + size.y}, IM_COL32(0, 0, 0, 190), edge.y);
    list_.AddText({low.x + edge.x, low.y + edge.y}, IM_COL32_WHITE, text.c_str());
  }

 private:
  ImVec2 at(const glm::dvec2& p) const {
    return {static_cast<float>(p.x) / pixels_.x, static_cast<float>(p.y) / pixels_.y};
  }

  ImDrawList& list_;
  ImVec2 pixels_;  // pixels of the picture in one unit of ImGui's coordinates
  float scale_;    // of the panels' texts: widths are for 1
};

}  // namespace

// Draws light lines over wider dark ones, which show on any picture.
void passOutline(const PanelContext& ui) {
  if (ui.output.hoveredPath.empty() || ui.output.hoveredPath != ui.input.frame.outlinedPath) {
    return;
  }
  Painter painter;
  painter.lines(ui.input.frame.outline, IM_COL32(0, 0, 0, 190), 5.25f);
  painter.lines(ui.input.frame.outline, IM_COL32(255, 196, 40, 255), 2.1f);
}

void editOverlay(const ShownOverlay& overlay, const WindowRect& picture) {
  Painter painter;
  painter.lines(overlay.itself, itselfColor, 1.5f);
  painter.shaded(overlay.outline, outlineColor, 2.0f);
  for (const GizmoShape& shape : overlay.gizmo) {
    painter.shape(shape, shape.handle == overlay.active);
  }
  if (!overlay.label.empty()) {
    painter.label(overlay.label, overlay.labelAt, picture);
  }
}

}  // namespace speculum::panels
