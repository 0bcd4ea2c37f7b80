#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr double smallestZoom = 1.0 / 16.0;  // pixels of the display a texel
constexpr double largestZoom = 64.0;
constexpr double wheelStep = 1.25;

struct Rect {
  ImVec2 low;
  ImVec2 high;
};

// `outer` without `inner`, which lies in it.
void fillAround(const Rect& outer, const Rect& inner, ImU32 color) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(outer.low, {outer.high.x, inner.low.y}, color);
  list.AddRectFilled({outer.low.x, inner.high.y}, outer.high, color);
  list.AddRectFilled({outer.low.x, inner.low.y}, {inner.low.x, inner.high.y}, color);
  list.AddRectFilled({inner.high.x, inner.low.y}, {outer.high.x, inner.high.y}, color);
}

// Of the window without its title bar, behind everything else in it but for the canvas.
void background(const Rect& canvas) {
  const ImVec2 corner = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  const Rect window{{corner.x, corner.y + ImGui::GetFrameHeight()}, {corner.x + size.x, corner.y + size.y}};
  ImVec4 color = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
  color.w = 1.0f;
  ImGui::PushClipRect(window.low, window.high, false);
  fillAround(window, canvas, ImGui::ColorConvertFloat4ToU32(color));
  ImGui::PopClipRect();
}

void passChoice(UiModel& model) {
  const UiPass* shown = model.debugPass >= 0 ? &model.passes[static_cast<size_t>(model.debugPass)] : nullptr;
  ImGui::SetNextItemWidth(10.0f * ImGui::GetFontSize());
  if (ImGui::BeginCombo("##pass", shown ? shown->name.c_str() : "")) {
    for (int i = 0; i < static_cast<int>(model.passes.size()); ++i) {
      ImGui::PushID(i);  // names may repeat
      if (hasTarget(model.passes[static_cast<size_t>(i)]) &&
          ImGui::Selectable(model.passes[static_cast<size_t>(i)].name.c_str(), i == model.debugPass)) {
        model.debugPass = i;
      }
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  notePlace(model, "targets.pass");
  tip("whose target is shown");
}

void controls(UiModel& model) {
  UiTargets& targets = model.targets;
  static constexpr std::array<const char*, 3> kinds{"colour", "depth", "mask"};
  static constexpr std::array<const char*, 3> about{
      "what the pass drew, through exposure and tone curve",
      "metres from the eye: white 0, grey the distance beside, black infinitely far; outside the mask white.\n"
      "With oblique clipping depth is another and the greys mean nothing.",
      "grey: what the pass shades; lines: the mirrors that are seen in it"};
  passChoice(model);
  for (int i = 0; i < 3; ++i) {
    ImGui::SameLine();
    ImGui::RadioButton(kinds[static_cast<size_t>(i)], &targets.kind, i);
    notePlace(model, std::string("targets.") + kinds[static_cast<size_t>(i)]);
    tip(about[static_cast<size_t>(i)]);
  }
  if (ImGui::Button("fit")) {
    targets.zoom = 0.0;
  }
  notePlace(model, "targets.fit");
  tip("the whole image");
  ImGui::SameLine();
  if (ImGui::Button("1:1")) {
    targets.zoom = 1.0;
  }
  notePlace(model, "targets.one");
  tip("one texel on one pixel");
  if (targets.kind == 1) {
    ImGui::SameLine();
    float half = static_cast<float>(targets.halfDistance);
    ImGui::SetNextItemWidth(8.0f * ImGui::GetFontSize());
    ImGui::SliderFloat("##half", &half, 0.1f, 1000.0f, "grey %.3g m", ImGuiSliderFlags_Logarithmic);
    targets.halfDistance = half;
    notePlace(model, "targets.half");
    tip("metres that are shown half bright");
  }
}

// Wheel and drag. `pixels` and positions are those of the display.
void moveView(UiTargets& targets, const glm::dvec2& room, const glm::dvec2& pointer) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemHovered() && io.MouseWheel != 0.0f) {
    const glm::dvec2 texel = targets.center + (pointer - 0.5 * room) / targets.shownZoom;
    targets.zoom = std::clamp(targets.shownZoom * std::pow(wheelStep, io.MouseWheel), smallestZoom, largestZoom);
    targets.center = texel - (pointer - 0.5 * room) / targets.zoom;
  } else if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0.0f)) {
    targets.zoom = targets.shownZoom;
    targets.center -= glm::dvec2(io.MouseDelta.x, io.MouseDelta.y) / targets.zoom;
  }
  targets.center = glm::clamp(targets.center, glm::dvec2(0.0), glm::dvec2(targets.size));
}

// Of the texel under the pointer; "..." until it has come from the GPU.
std::string valueText(const UiTargets& targets) {
  if (targets.kind == 2) {
    return "";
  }
  const std::optional<UiTexel>& value = targets.value;
  if (!value || value->texel != *targets.pointed || value->depth != (targets.kind == 1)) {
    return "...";
  }
  std::array<char, 128> text{};
  if (!value->depth) {
    const glm::dvec4& v = value->value;
    std::snprintf(text.data(), text.size(), "RGB %.5g %.5g %.5g  A %.5g", v.r, v.g, v.b, v.a);
  } else if (std::isinf(value->metres)) {
    return "infinitely far";
  } else {
    std::snprintf(text.data(), text.size(), "%.6g m", value->metres);
  }
  return text.data();
}

void maskImage(const UiTargets& targets, const Rect& canvas, const glm::dvec2& corner) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto toScreen = [&](const std::vector<glm::vec2>& polygon) {
    std::vector<ImVec2> points;
    for (const glm::vec2& p : polygon) {
      const glm::dvec2 at = corner + targets.shownZoom * glm::dvec2(p);
      points.emplace_back(static_cast<float>(at.x), static_cast<float>(at.y));
    }
    return points;
  };
  ImGui::PushClipRect(canvas.low, canvas.high, true);
  list.AddRectFilled(canvas.low, canvas.high, IM_COL32(16, 16, 18, 255));
  const std::vector<ImVec2> mask = toScreen(targets.mask);
  list.AddConvexPolyFilled(mask.data(), static_cast<int>(mask.size()), IM_COL32(150, 150, 150, 255));
  for (const std::vector<glm::vec2>& mirror : targets.mirrors) {
    const std::vector<ImVec2> points = toScreen(mirror);
    list.AddPolyline(points.data(), static_cast<int>(points.size()), IM_COL32(255, 196, 40, 255), ImDrawFlags_Closed,
                     0.12f * ImGui::GetFontSize());
  }
  ImGui::PopClipRect();
}

}  // namespace

bool hasTarget(const UiPass& pass) {
  return pass.kind == PassKind::mirror || pass.kind == PassKind::main;
}

void targets(UiModel& model) {
  UiTargets& targets = model.targets;
  const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float top = start.y + 3.0f * ImGui::GetFrameHeightWithSpacing();
  const Rect canvas{{start.x, top}, {start.x + std::max(room.x, 1.0f), std::max(start.y + room.y, top + 1.0f)}};
  background(canvas);
  controls(model);
  const glm::dvec2 size(canvas.high.x - canvas.low.x, canvas.high.y - canvas.low.y);
  const bool there = model.debugPass >= 0 && targets.size.x > 0 && targets.size.y > 0;
  const glm::dvec2 image = glm::max(glm::dvec2(targets.size), glm::dvec2(1.0));
  if (targets.zoom == 0.0) {
    targets.center = 0.5 * image;
  }
  targets.shownZoom = targets.zoom > 0.0 ? targets.zoom : std::min(size.x / image.x, size.y / image.y);
  ImGui::SetCursorScreenPos(canvas.low);
  ImGui::InvisibleButton("canvas", {canvas.high.x - canvas.low.x, canvas.high.y - canvas.low.y});
  notePlace(model, "targets.canvas");
  const bool hovered = ImGui::IsItemHovered();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const glm::dvec2 pointer(mouse.x - canvas.low.x, mouse.y - canvas.low.y);
  moveView(targets, size, pointer);
  targets.shownZoom = targets.zoom > 0.0 ? targets.zoom : targets.shownZoom;
  const glm::dvec2 origin = targets.center - 0.5 * size / targets.shownZoom;
  const glm::dvec2 corner = glm::dvec2(canvas.low.x, canvas.low.y) - targets.shownZoom * origin;
  if (there && targets.kind == 2) {
    maskImage(targets, canvas, corner);
  } else if (there) {
    model.debugArea = PixelRect{static_cast<int>(canvas.low.x * scale.x), static_cast<int>(canvas.low.y * scale.y),
                                static_cast<int>(size.x * scale.x), static_cast<int>(size.y * scale.y)};
    targets.origin = origin;
    const glm::dvec2 low =
        glm::clamp(corner, glm::dvec2(canvas.low.x, canvas.low.y), glm::dvec2(canvas.high.x, canvas.high.y));
    const glm::dvec2 high =
        glm::clamp(corner + targets.shownZoom * image, low, glm::dvec2(canvas.high.x, canvas.high.y));
    fillAround(canvas,
               {ImVec2(static_cast<float>(std::ceil(low.x - 0.5)), static_cast<float>(std::ceil(low.y - 0.5))),
                ImVec2(static_cast<float>(std::floor(high.x)), static_cast<float>(std::floor(high.y)))},
               IM_COL32(16, 16, 18, 255));
  }
  ImGui::SetCursorScreenPos({start.x, top - ImGui::GetTextLineHeightWithSpacing()});
  const glm::dvec2 texel = glm::floor(origin + pointer / targets.shownZoom);
  targets.pointed.reset();
  if (there && hovered && texel.x >= 0 && texel.y >= 0 && texel.x < image.x && texel.y < image.y) {
    targets.pointed = glm::ivec2(texel);
    ImGui::Text("%d, %d  %s", targets.pointed->x, targets.pointed->y, valueText(targets).c_str());
  } else {
    ImGui::TextDisabled("%dx%d  %.0f %%  wheel: zoom  drag: move", targets.size.x, targets.size.y,
                        100.0 * targets.shownZoom);
  }
}

}  // namespace speculum::panels
