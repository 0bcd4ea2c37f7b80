#include <imgui.h>
#include <imgui_internal.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "platform/text.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr double smallestZoom = 1.0 / 16.0;  // pixels of the display a texel
constexpr double largestZoom = 64.0;
constexpr double wheelStep = 1.25;

glm::dvec2 vec(const ImVec2& v) {
  return {v.x, v.y};
}

// Returns the parts of `outer` above, below, left and right of `inner`, which lies in it.
std::array<ImRect, 4> partsAround(const ImRect& outer, const ImRect& inner) {
  return {ImRect(outer.Min, {outer.Max.x, inner.Min.y}), ImRect({outer.Min.x, inner.Max.y}, outer.Max),
          ImRect({outer.Min.x, inner.Min.y}, {inner.Min.x, inner.Max.y}),
          ImRect({inner.Max.x, inner.Min.y}, {outer.Max.x, inner.Max.y})};
}

void fillAround(const ImRect& outer, const ImRect& inner, ImU32 color) {
  for (const ImRect& part : partsAround(outer, inner)) {
    ImGui::GetWindowDrawList()->AddRectFilled(part.Min, part.Max, color);
  }
}

// Fills the window below its title bar, except the canvas.
void background(const ImRect& canvas) {
  ImRect window = ImGui::GetCurrentWindow()->Rect();
  window.Min.y += ImGui::GetFrameHeight();
  ImVec4 color = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
  color.w = 1.0f;
  ImGui::PushClipRect(window.Min, window.Max, false);
  fillAround(window, canvas, ImGui::ColorConvertFloat4ToU32(color));
  ImGui::PopClipRect();
}

using Targets = PanelState::Targets;

void passChoice(PanelContext& ui, const PassRow* shown) {
  const float width = 10.0f * ImGui::GetFontSize();
  const float room = width - ImGui::GetFrameHeight() - 2.0f * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(width);
  const std::string preview = shown ? thatFits(oneLine(shown->name), room) : "";
  if (ImGui::BeginCombo("##pass", preview.c_str())) {
    for (size_t i = 0; i < ui.input.frame.passes.size(); ++i) {
      const PassRow& pass = ui.input.frame.passes[i];
      ImGui::PushID(static_cast<int>(i));  // names may repeat
      if (hasTarget(pass) && ImGui::Selectable(oneLine(pass.name).c_str(), &pass == shown)) {
        ui.state.targets.path = pass.path;
      }
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  recordWidget(ui, "targets.pass", "Pass whose target is shown, in the order of drawing.");
}

// Draws a button that goes to the next pass with a target, in the order of drawing: forward or back.
void stepButton(PanelContext& ui, const PassRow* shown, bool forward) {
  const std::vector<PassRow>& passes = ui.input.frame.passes;
  std::vector<const PassRow*> drawn;
  for (const PassRow& pass : passes) {
    if (hasTarget(pass)) {
      drawn.push_back(&pass);
    }
  }
  const auto at = std::ranges::find(drawn, shown);
  const bool more = at != drawn.end() && (forward ? at + 1 != drawn.end() : at != drawn.begin());
  if (button(ui, forward ? ">" : "<", forward ? "targets.next" : "targets.previous",
             forward ? "Steps to the pass that is drawn next." : "Steps to the pass that is drawn before.", more)) {
    ui.state.targets.path = (*(forward ? at + 1 : at - 1))->path;
  }
}

void controls(PanelContext& ui, const PassRow* shown) {
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
  continueRow("< >", 2.0f * ImGui::GetStyle().FramePadding.x + ImGui::GetStyle().ItemSpacing.x);
  stepButton(ui, shown, false);
  ImGui::SameLine();
  stepButton(ui, shown, true);
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
    targets.center -= vec(io.MouseDelta) / targets.zoom;
  }
  targets.center = glm::clamp(targets.center, glm::dvec2(0.0), image);
  targets.shownZoom = targets.zoom > 0.0 ? targets.zoom : targets.shownZoom;
}

// Returns the value of the texel under the pointer; "..." until it arrives from the GPU.
std::string valueText(const Targets& targets, const ShownTarget& target) {
  if (targets.kind == Targets::Kind::mask) {
    return "";
  }
  const std::optional<TexelValue>& value = target.value;
  if (!value || value->texel != *targets.pointed || value->depth != (targets.kind == Targets::Kind::depth)) {
    return "...";
  }
  const glm::dvec4 v = value->value;
  return !value->depth               ? fmt::format("RGB {:.5g} {:.5g} {:.5g}  A {:.5g}", v.r, v.g, v.b, v.a)
         : value->storedDepth > 0.0f ? fmt::format("{:.6g} m", target.near / static_cast<double>(value->storedDepth))
                                     : "infinitely far";
}

void maskImage(const ShownTarget& target, double zoom, const ImRect& canvas, const glm::dvec2& corner) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto toScreen = [&](const std::vector<glm::vec2>& polygon) {
    std::vector<ImVec2> points;
    for (const glm::vec2& p : polygon) {
      const glm::dvec2 at = corner + zoom * glm::dvec2(p);
      points.emplace_back(static_cast<float>(at.x), static_cast<float>(at.y));
    }
    return points;
  };
  ImGui::PushClipRect(canvas.Min, canvas.Max, true);
  list.AddRectFilled(canvas.Min, canvas.Max, IM_COL32(16, 16, 18, 255));
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
void coverAround(const ImRect& canvas, const glm::dvec2& corner, const glm::dvec2& size) {
  const glm::dvec2 low = glm::clamp(corner, vec(canvas.Min), vec(canvas.Max));
  const glm::dvec2 high = glm::clamp(corner + size, low, vec(canvas.Max));
  fillAround(canvas,
             {ImVec2(static_cast<float>(std::ceil(low.x - 0.5)), static_cast<float>(std::ceil(low.y - 0.5))),
              ImVec2(static_cast<float>(std::floor(high.x)), static_cast<float>(std::floor(high.y)))},
             IM_COL32(16, 16, 18, 255));
}

PixelRect inPixels(const ImRect& rect) {
  const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
  const auto pixels = [](float position, float by) { return static_cast<int>(position * by); };
  return {pixels(rect.Min.x, scale.x), pixels(rect.Min.y, scale.y), pixels(rect.GetWidth(), scale.x),
          pixels(rect.GetHeight(), scale.y)};
}

// Returns the pass whose target is shown: the chosen pass, at first that of the selected mirror, or the main view if
// there is no such pass.
const PassRow* shownPass(PanelContext& ui) {
  const std::vector<PassRow>& passes = ui.input.frame.passes;
  const Selection& selected = ui.input.edit.selected;
  if (!ui.state.targets.path && selected.kind == Selection::Kind::mirror) {
    ui.state.targets.path = MirrorPath{selected.index};
  }
  const auto pass =
      std::ranges::find_if(passes, [&](const PassRow& p) { return hasTarget(p) && ui.state.targets.path == p.path; });
  const auto main = std::ranges::find(passes, PassKind::main, &PassRow::kind);
  const auto shown = pass != passes.end() ? pass : main;
  ui.state.targets.path = shown != passes.end() ? std::optional(shown->path) : std::nullopt;
  return shown != passes.end() ? &*shown : nullptr;
}

void caption(PanelContext& ui, const ImRect& canvas, bool hovered, const glm::dvec2& texel) {
  const ShownTarget& target = ui.input.frame.target;
  Targets& targets = ui.state.targets;
  ImGui::SetCursorScreenPos({canvas.Min.x, canvas.Min.y - ImGui::GetTextLineHeightWithSpacing()});
  if (!target.complete && targets.kind != Targets::Kind::mask) {
    const std::string share = target.share > 0.0 ? fmt::format(": {} %", static_cast<int>(100.0 * target.share)) : "";
    ImGui::TextDisabled("Being drawn with the next picture%s", share.c_str());
  } else if (hovered && texel.x >= 0 && texel.y >= 0 && texel.x < target.size.x && texel.y < target.size.y) {
    targets.pointed = glm::ivec2(texel);
    ImGui::Text("%d, %d  %s", targets.pointed->x, targets.pointed->y, valueText(targets, target).c_str());
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
  const glm::vec2 end = canvas.corner + canvas.size;
  for (const ImRect& part :
       partsAround({{0.0f, 0.0f}, ImGui::GetIO().DisplaySize}, {{canvas.corner.x, canvas.corner.y}, {end.x, end.y}})) {
    ImGui::GetBackgroundDrawList()->PushClipRect(part.Min, part.Max);
    draw();
    ImGui::GetBackgroundDrawList()->PopClipRect();
  }
}

bool hasTarget(const PassRow& pass) {
  return pass.kind == PassKind::mirror || pass.kind == PassKind::main;
}

void targets(PanelContext& ui) {
  const ShownTarget& target = ui.input.frame.target;
  Targets& targets = ui.state.targets;
  const PassRow* shown = shownPass(ui);
  // The controls are drawn first, because the canvas begins below as many lines as they take. The background around the
  // canvas is then put under the controls.
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.ChannelsSplit(2);
  list.ChannelsSetCurrent(1);
  controls(ui, shown);
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float top = start.y + ImGui::GetFrameHeightWithSpacing();
  const ImRect canvas({start.x, top}, {start.x + std::max(room.x, 1.0f), std::max(start.y + room.y, top + 1.0f)});
  list.ChannelsSetCurrent(0);
  background(canvas);
  list.ChannelsMerge();
  const glm::dvec2 size = vec(canvas.GetSize());
  targets.canvas = WindowRect{vec(canvas.Min), size};
  const glm::dvec2 image = glm::max(glm::dvec2(target.size), glm::dvec2(1.0));
  if (targets.zoom == 0.0) {
    targets.center = 0.5 * image;
  }
  targets.shownZoom = targets.zoom > 0.0 ? targets.zoom : std::min(size.x / image.x, size.y / image.y);
  ImGui::SetCursorScreenPos(canvas.Min);
  ImGui::InvisibleButton("canvas", canvas.GetSize());
  recordWidget(ui, "targets.canvas");
  const bool hovered = ImGui::IsItemHovered();
  const glm::dvec2 pointer = vec(ImGui::GetIO().MousePos) - vec(canvas.Min);
  moveView(targets, glm::dvec2(target.size), size, pointer);
  const glm::dvec2 origin = targets.center - 0.5 * size / targets.shownZoom;
  const glm::dvec2 corner = vec(canvas.Min) - targets.shownZoom * origin;
  const bool there = shown && target.size.x > 0 && target.size.y > 0;
  const bool isMask = targets.kind == Targets::Kind::mask;
  if (there && isMask) {
    maskImage(target, targets.shownZoom, canvas, corner);
  } else {
    coverAround(canvas, corner, target.complete ? targets.shownZoom * image : glm::dvec2(0.0));
  }
  caption(ui, canvas, there && hovered, glm::floor(origin + pointer / targets.shownZoom));
  if (shown) {
    ui.output.target = {
        .path = shown->path,
        .drawn = !isMask,
        .display = {.area = inPixels(canvas),
                    .kind = targets.kind == Targets::Kind::depth ? TargetKind::depth : TargetKind::color,
                    .zoom = targets.zoom,
                    .origin = origin,
                    .halfDistance = targets.halfDistance,
                    .probe = isMask ? std::nullopt : targets.pointed}};
  }
}

}  // namespace speculum::panels
