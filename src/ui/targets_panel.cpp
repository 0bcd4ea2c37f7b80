#include <imgui.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>

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

// Fills `outer` without `inner`, which lies in it.
void fillAround(const Rect& outer, const Rect& inner, ImU32 color) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(outer.low, {outer.high.x, inner.low.y}, color);
  list.AddRectFilled({outer.low.x, inner.high.y}, outer.high, color);
  list.AddRectFilled({outer.low.x, inner.low.y}, {inner.low.x, inner.high.y}, color);
  list.AddRectFilled({inner.high.x, inner.low.y}, {outer.high.x, inner.high.y}, color);
}

// Fills the window below its title bar, except the canvas.
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

using Targets = PanelState::Targets;

void passChoice(PanelContext& ui, const PassView* shown) {
  ImGui::SetNextItemWidth(10.0f * ImGui::GetFontSize());
  if (ImGui::BeginCombo("##pass", shown ? shown->name.c_str() : "")) {
    for (size_t i = 0; i < ui.view.frame.passes.size(); ++i) {
      const PassView& pass = ui.view.frame.passes[i];
      ImGui::PushID(static_cast<int>(i));  // names may repeat
      if (hasTarget(pass) && ImGui::Selectable(pass.name.c_str(), &pass == shown)) {
        ui.state.targets.path = pass.path;
      }
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  recordWidget(ui, "targets.pass", "Pass whose target is shown.");
}

void controls(PanelContext& ui, const PassView* shown) {
  struct Choice {
    Targets::Kind kind;
    const char* label;
    const char* name;
    const char* about;
  };
  static constexpr std::array<Choice, 3> choices{
      {{Targets::Kind::color, "Color", "color", "Radiance, through exposure and tone curve."},
       {Targets::Kind::depth, "Depth", "depth",
        "Distance from the eye: white is near, half grey the distance set here, black infinitely far. Outside the mask "
        "it is white. With oblique clipping shades are no distances."},
       {Targets::Kind::mask, "Mask", "mask", "Grey: pixels that the pass shades. Lines: the mirrors seen in it."}}};
  Targets& targets = ui.state.targets;
  passChoice(ui, shown);
  for (const Choice& choice : choices) {
    continueRow(choice.label, ImGui::GetFrameHeight());
    if (ImGui::RadioButton(choice.label, targets.kind == choice.kind)) {
      targets.kind = choice.kind;
    }
    recordWidget(ui, std::string("targets.") + choice.name, choice.about);
  }
  continueRow("Fit 1:1", 2.0f * ImGui::GetStyle().FramePadding.x + ImGui::GetStyle().ItemSpacing.x);
  if (button(ui, "Fit", "targets.fit", "Shows the whole image.")) {
    targets.zoom = 0.0;
  }
  ImGui::SameLine();
  if (button(ui, "1:1", "targets.one", "Shows a texel on each pixel.")) {
    targets.zoom = 1.0;
  }
  if (targets.kind == Targets::Kind::depth) {
    const float width = 8.0f * ImGui::GetFontSize();
    continueRow("", width);
    float half = static_cast<float>(targets.halfDistance);
    ImGui::SetNextItemWidth(width);
    ImGui::SliderFloat("##half", &half, 0.1f, 1000.0f, "grey %.3g m", ImGuiSliderFlags_Logarithmic);
    targets.halfDistance = half;
    recordWidget(ui, "targets.half", "Distance that is shown half bright.");
  }
}

// Zooms by the wheel and moves by dragging. Sizes and positions are pixels of the display.
void moveView(Targets& targets, const glm::dvec2& image, const glm::dvec2& room, const glm::dvec2& pointer) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemHovered() && io.MouseWheel != 0.0f) {
    const glm::dvec2 texel = targets.center + (pointer - 0.5 * room) / targets.shownZoom;
    targets.zoom = std::clamp(targets.shownZoom * std::pow(wheelStep, io.MouseWheel), smallestZoom, largestZoom);
    targets.center = texel - (pointer - 0.5 * room) / targets.zoom;
  } else if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0.0f)) {
    targets.zoom = targets.shownZoom;
    targets.center -= glm::dvec2(io.MouseDelta.x, io.MouseDelta.y) / targets.zoom;
  }
  targets.center = glm::clamp(targets.center, glm::dvec2(0.0), image);
  targets.shownZoom = targets.zoom > 0.0 ? targets.zoom : targets.shownZoom;
}

// Returns the value of the texel under the pointer; "..." until it arrives from the GPU.
std::string valueText(const Targets& targets, const std::optional<TexelView>& value) {
  if (targets.kind == Targets::Kind::mask) {
    return "";
  }
  if (!value || value->texel != *targets.pointed || value->depth != (targets.kind == Targets::Kind::depth)) {
    return "...";
  }
  const glm::dvec4& v = value->value;
  return !value->depth               ? fmt::format("RGB {:.5g} {:.5g} {:.5g}  A {:.5g}", v.r, v.g, v.b, v.a)
         : std::isinf(value->metres) ? "infinitely far"
                                     : fmt::format("{:.6g} m", value->metres);
}

void maskImage(const TargetView& target, double zoom, const Rect& canvas, const glm::dvec2& corner) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto toScreen = [&](const std::vector<glm::vec2>& polygon) {
    std::vector<ImVec2> points;
    for (const glm::vec2& p : polygon) {
      const glm::dvec2 at = corner + zoom * glm::dvec2(p);
      points.emplace_back(static_cast<float>(at.x), static_cast<float>(at.y));
    }
    return points;
  };
  ImGui::PushClipRect(canvas.low, canvas.high, true);
  list.AddRectFilled(canvas.low, canvas.high, IM_COL32(16, 16, 18, 255));
  const std::vector<ImVec2> mask = toScreen(target.mask);
  list.AddConvexPolyFilled(mask.data(), static_cast<int>(mask.size()), IM_COL32(150, 150, 150, 255));
  for (const std::vector<glm::vec2>& mirror : target.mirrors) {
    const std::vector<ImVec2> points = toScreen(mirror);
    list.AddPolyline(points.data(), static_cast<int>(points.size()), IM_COL32(255, 196, 40, 255), ImDrawFlags_Closed,
                     0.12f * ImGui::GetFontSize());
  }
  ImGui::PopClipRect();
}

// Fills the canvas around the image, whose upper left corner is at `corner` of the screen.
void coverAround(const Rect& canvas, const glm::dvec2& corner, const glm::dvec2& size) {
  const glm::dvec2 first(canvas.low.x, canvas.low.y);
  const glm::dvec2 last(canvas.high.x, canvas.high.y);
  const glm::dvec2 low = glm::clamp(corner, first, last);
  const glm::dvec2 high = glm::clamp(corner + size, low, last);
  fillAround(canvas,
             {ImVec2(static_cast<float>(std::ceil(low.x - 0.5)), static_cast<float>(std::ceil(low.y - 0.5))),
              ImVec2(static_cast<float>(std::floor(high.x)), static_cast<float>(std::floor(high.y)))},
             IM_COL32(16, 16, 18, 255));
}

PixelRect inPixels(const Rect& rect) {
  const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
  const auto pixels = [](float position, float by) { return static_cast<int>(position * by); };
  return {pixels(rect.low.x, scale.x), pixels(rect.low.y, scale.y), pixels(rect.high.x - rect.low.x, scale.x),
          pixels(rect.high.y - rect.low.y, scale.y)};
}

// Returns the pass whose target is shown: the chosen one, or the main view if that is gone.
const PassView* shownPass(PanelContext& ui) {
  const std::vector<PassView>& passes = ui.view.frame.passes;
  const auto pass =
      std::ranges::find_if(passes, [&](const PassView& p) { return hasTarget(p) && ui.state.targets.path == p.path; });
  const auto main = std::ranges::find(passes, PassKind::main, &PassView::kind);
  const auto shown = pass != passes.end() ? pass : main;
  ui.state.targets.path = shown != passes.end() ? std::optional(shown->path) : std::nullopt;
  return shown != passes.end() ? &*shown : nullptr;
}

void caption(PanelContext& ui, const Rect& canvas, bool hovered, const glm::dvec2& texel) {
  const TargetView& target = ui.view.frame.target;
  Targets& targets = ui.state.targets;
  ImGui::SetCursorScreenPos({canvas.low.x, canvas.low.y - ImGui::GetTextLineHeightWithSpacing()});
  if (hovered && texel.x >= 0 && texel.y >= 0 && texel.x < target.size.x && texel.y < target.size.y) {
    targets.pointed = glm::ivec2(texel);
    ImGui::Text("%d, %d  %s", targets.pointed->x, targets.pointed->y, valueText(targets, target.value).c_str());
  } else {
    ImGui::TextDisabled("%dx%d  %.0f %%  wheel: zoom  drag: pan", target.size.x, target.size.y,
                        100.0 * targets.shownZoom);
  }
}

}  // namespace

void besideTarget(const PanelContext& ui, const std::function<void()>& draw) {
  if (!ui.state.targets.canvas) {
    return draw();
  }
  const WindowRect& canvas = *ui.state.targets.canvas;
  const ImVec2 low(canvas.corner.x, canvas.corner.y);
  const ImVec2 high(low.x + canvas.size.x, low.y + canvas.size.y);
  const ImVec2 end = ImGui::GetIO().DisplaySize;
  for (const Rect& part : {Rect{{0.0f, 0.0f}, {end.x, low.y}}, Rect{{0.0f, high.y}, end},
                           Rect{{0.0f, low.y}, {low.x, high.y}}, Rect{{high.x, low.y}, {end.x, high.y}}}) {
    ImGui::GetBackgroundDrawList()->PushClipRect(part.low, part.high);
    draw();
    ImGui::GetBackgroundDrawList()->PopClipRect();
  }
}

bool hasTarget(const PassView& pass) {
  return pass.kind == PassKind::mirror || pass.kind == PassKind::main;
}

void targets(PanelContext& ui) {
  const TargetView& target = ui.view.frame.target;
  Targets& targets = ui.state.targets;
  const PassView* shown = shownPass(ui);
  // The controls are drawn first, because the canvas begins below as many lines as they take. The background around the
  // canvas is then put under them.
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.ChannelsSplit(2);
  list.ChannelsSetCurrent(1);
  controls(ui, shown);
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float top = start.y + ImGui::GetFrameHeightWithSpacing();
  const Rect canvas{{start.x, top}, {start.x + std::max(room.x, 1.0f), std::max(start.y + room.y, top + 1.0f)}};
  list.ChannelsSetCurrent(0);
  background(canvas);
  list.ChannelsMerge();
  targets.canvas =
      WindowRect{{canvas.low.x, canvas.low.y}, {canvas.high.x - canvas.low.x, canvas.high.y - canvas.low.y}};
  const glm::dvec2 size(canvas.high.x - canvas.low.x, canvas.high.y - canvas.low.y);
  const glm::dvec2 image = glm::max(glm::dvec2(target.size), glm::dvec2(1.0));
  if (targets.zoom == 0.0) {
    targets.center = 0.5 * image;
  }
  targets.shownZoom = targets.zoom > 0.0 ? targets.zoom : std::min(size.x / image.x, size.y / image.y);
  ImGui::SetCursorScreenPos(canvas.low);
  ImGui::InvisibleButton("canvas", {canvas.high.x - canvas.low.x, canvas.high.y - canvas.low.y});
  recordWidget(ui, "targets.canvas");
  const bool hovered = ImGui::IsItemHovered();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const glm::dvec2 pointer(mouse.x - canvas.low.x, mouse.y - canvas.low.y);
  moveView(targets, glm::dvec2(target.size), size, pointer);
  const glm::dvec2 origin = targets.center - 0.5 * size / targets.shownZoom;
  const glm::dvec2 corner = glm::dvec2(canvas.low.x, canvas.low.y) - targets.shownZoom * origin;
  const bool there = shown && target.size.x > 0 && target.size.y > 0;
  const bool isMask = targets.kind == Targets::Kind::mask;
  if (there) {
    isMask ? maskImage(target, targets.shownZoom, canvas, corner)
           : coverAround(canvas, corner, targets.shownZoom * image);
  }
  caption(ui, canvas, there && hovered, glm::floor(origin + pointer / targets.shownZoom));
  if (shown) {
    ui.output.target = {.path = shown->path,
                        .area = there && !isMask ? std::optional(inPixels(canvas)) : std::nullopt,
                        .depth = targets.kind == Targets::Kind::depth,
                        .zoom = targets.shownZoom,
                        .origin = origin,
                        .halfDistance = targets.halfDistance,
                        .probe = isMask ? std::nullopt : targets.pointed};
  }
}

}  // namespace speculum::panels
