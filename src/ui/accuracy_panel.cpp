#include <imgui.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "platform/text.hpp"
#include "settings/setting_fields.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr ImU32 frontColor = IM_COL32(230, 145, 30, 255);
constexpr ImU32 chosenColor = IM_COL32(60, 170, 85, 255);  // of a point off the front that a bound chose
constexpr ImU32 otherColor = IM_COL32(130, 150, 180, 200);
constexpr float gridOpacity = 0.16f;
constexpr double leastError = 1e-4;  // where a point of error 0 is drawn
constexpr double mostRoom = 2.0;     // factor by which the plot may reach below the points, for a far noise floor

// A plot with logarithmic axes that fit the points, in screen coordinates.
struct Plot {
  ImVec2 corner;  // top left
  ImVec2 size;
  double lowMs, highMs, lowError, highError;

  static float part(double value, double low, double high) {
    return static_cast<float>(std::log(value / low) / std::log(high / low));
  }
  float x(double ms) const { return corner.x + size.x * part(std::clamp(ms, lowMs, highMs), lowMs, highMs); }
  float y(double error) const {
    const float title = ImGui::GetFontSize();  // of an axis; points are drawn neither over it nor over the other one
    const float share = part(std::clamp(error, lowError, highError), lowError, highError);
    return corner.y + title + std::max(size.y - 2.0f * title, 0.0f) * (1.0f - share);
  }
  ImVec2 at(const PointRow& point) const { return {x(point.ms), y(point.error)}; }
};

Plot plotOf(const ShownAccuracy& accuracy, const ImVec2& corner, const ImVec2& size) {
  Plot plot{corner, size, DBL_MAX, 0.0, DBL_MAX, 0.0};
  for (const PointRow& point : accuracy.points) {
    plot.lowMs = std::min(plot.lowMs, point.lowerMs);
    plot.highMs = std::max(plot.highMs, point.upperMs);
    plot.lowError = std::min(plot.lowError, std::max(point.error, leastError));
    plot.highError = std::max(plot.highError, std::max(point.error, leastError));
  }
  if (accuracy.noiseFloor > leastError) {
    plot.lowError = std::clamp(accuracy.noiseFloor, plot.lowError / mostRoom, plot.lowError);
  }
  plot.lowMs = std::max(plot.lowMs, 1e-4) / 1.15;
  plot.highMs = std::max(plot.highMs, plot.lowMs) * 1.3;
  plot.lowError /= 1.1;
  plot.highError *= 1.1;
  return plot;
}

// Calls draw() with 1, 2 and 5 times each power of ten in the range.
template <typename Draw>
void forTicks(double low, double high, const Draw& draw) {
  const int last = static_cast<int>(std::floor(std::log10(high)));
  for (int exponent = static_cast<int>(std::floor(std::log10(low))); exponent <= last; ++exponent) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double value = digit * std::pow(10.0, exponent);
      if (value >= low && value <= high) {
        draw(value);
      }
    }
  }
}

void drawAxes(ImDrawList& list, const Plot& plot, double noiseFloor) {
  const ImVec2 end(plot.corner.x + plot.size.x, plot.corner.y + plot.size.y);
  const ImU32 grid = ImGui::GetColorU32(ImGuiCol_Text, gridOpacity);
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  const float line = ImGui::GetFontSize();
  list.AddRect(plot.corner, end, grid);
  float free = plot.corner.x;  // right end of the last label
  forTicks(plot.lowMs, plot.highMs, [&](double ms) {
    list.AddLine({plot.x(ms), plot.corner.y}, {plot.x(ms), end.y}, grid);
    const std::string text = significant(ms, 3);
    const float width = textWidth(text);
    const float left = std::min(plot.x(ms) - 0.5f * width, end.x - width);
    if (left >= free) {
      list.AddText({left, end.y}, ink, text.c_str());
      free = left + width + 0.5f * line;
    }
  });
  float top = end.y;  // of the last label
  forTicks(plot.lowError, plot.highError, [&](double error) {
    const float y = plot.y(error);
    list.AddLine({plot.corner.x, y}, {end.x, y}, grid);
    if (y + line <= top) {
      list.AddText({plot.corner.x + 2.0f, y}, ink, significant(error, 3).c_str());
      top = y;
    }
  });
  const char* across = "GPU ms of one picture";
  list.AddText({end.x - textWidth(across) - 2.0f, end.y - line}, ink, across);
  const char* up = "mean FLIP of one picture";
  list.AddText({end.x - textWidth(up) - 2.0f, plot.corner.y}, ink, up);
  if (noiseFloor > 0.0) {
    const float y = plot.y(noiseFloor);
    for (float x = plot.corner.x; x < end.x; x += 8.0f) {
      list.AddLine({x, y}, {std::min(x + 4.0f, end.x), y}, ink);
    }
    list.AddText({plot.corner.x + 4.0f * line, y - line}, ink, ("noise floor " + significant(noiseFloor, 3)).c_str());
  }
}

bool isOnFront(const ShownAccuracy& accuracy, int point) {
  return std::ranges::find(accuracy.front, point) != accuracy.front.end();
}

// Returns what the color of a point off the front means.
const char* colorHelp(const ShownAccuracy& accuracy, int point) {
  return isOnFront(accuracy, point) ? ""
         : point == accuracy.chosen ? "\nGreen: a bound chose it by its median, though a more accurate point may take "
                                      "no longer, as far as the bars tell."
                                    : "\nGrey: a point at least as accurate takes no longer, as far as the bars tell.";
}

void drawPoints(ImDrawList& list, const Plot& plot, const ShownAccuracy& accuracy, int hovered) {
  const float em = ImGui::GetFontSize();
  for (size_t i = 1; i < accuracy.front.size(); ++i) {
    list.AddLine(plot.at(accuracy.points[accuracy.front[i - 1]]), plot.at(accuracy.points[accuracy.front[i]]),
                 frontColor, 0.1f * em);
  }
  for (int i = 0; i < static_cast<int>(accuracy.points.size()); ++i) {
    const PointRow& point = accuracy.points[i];
    const ImU32 color = isOnFront(accuracy, i) ? frontColor : i == accuracy.chosen ? chosenColor : otherColor;
    const ImVec2 place = plot.at(point);
    list.AddLine({plot.x(point.lowerMs), place.y}, {plot.x(point.upperMs), place.y}, color, 0.07f * em);
    list.AddCircleFilled(place, (i == hovered ? 0.4f : 0.27f) * em, color);
    if (i == accuracy.current) {
      list.AddCircle(place, 0.53f * em, ImGui::GetColorU32(ImGuiCol_Text), 0, 0.13f * em);
    }
  }
}

int nearestPoint(const Plot& plot, const ShownAccuracy& accuracy, const ImVec2& mouse) {
  int nearest = -1;
  float best = 0.8f * ImGui::GetFontSize();
  for (int i = 0; i < static_cast<int>(accuracy.points.size()); ++i) {
    const ImVec2 place = plot.at(accuracy.points[i]);
    const float distance = std::hypot(place.x - mouse.x, place.y - mouse.y);
    if (distance < best) {
      best = distance;
      nearest = i;
    }
  }
  return nearest;
}

// Plots error against milliseconds; a click on a point applies it.
void plot(PanelContext& ui) {
  const ShownAccuracy& accuracy = ui.input.accuracy;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float em = ImGui::GetFontSize();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const ImVec2 size(room.x, std::clamp(room.y - 11.0f * em, 7.0f * em, 15.0f * em));  // the rest is for what is below
  ImGui::InvisibleButton("plot", size);
  recordWidget(ui, "accuracy.plot");
  const Plot plot = plotOf(accuracy, corner, {size.x, size.y - 1.2f * em});  // labels are below
  const int hovered = ImGui::IsItemHovered() ? nearestPoint(plot, accuracy, ImGui::GetMousePos()) : -1;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
  drawAxes(list, plot, accuracy.noiseFloor);
  drawPoints(list, plot, accuracy, hovered);
  list.PopClipRect();
  for (int i = 0; i < static_cast<int>(accuracy.points.size()); ++i) {
    const ImVec2 place = plot.at(accuracy.points[i]);
    ui.state.widgets.emplace_back("accuracy.point " + accuracy.points[i].name,
                                  PixelRect{static_cast<int>(place.x) - 2, static_cast<int>(place.y) - 2, 4, 4});
  }
  if (hovered >= 0) {
    const PointRow& point = accuracy.points[hovered];
    showTip(fmt::format("{}\nMean FLIP of one picture {}, {} ({} .. {}){}", point.name, significant(point.error, 3),
                        duration(point.ms), duration(point.lowerMs), duration(point.upperMs),
                        colorHelp(accuracy, hovered)));
    if (ImGui::IsItemClicked()) {
      ui.send(ApplyPoint{hovered});
    }
  }
  dimmedText(
      "A click picks a point: its settings, as one picture. Orange: none is more accurate in its time. Bars: the "
      "middle half of the times; if they overlap, points count as equally fast.");
  tip("Both axes are logarithmic.\nMean FLIP: mean perceived difference from the reference, 0 (none) to 1.\n"
      "One picture: in full quality, as measured. While something moves, settings may be lowered to keep the pace; a "
      "still window shows the mean of several, with less error, unless a point was picked.");
}

// Says whether the settings are others than the user's own, from before a point was picked.
bool differsFromOwn(const PanelContext& ui) {
  return ui.input.accuracy.own && ui.input.accuracy.own != ui.settings;
}

void frontSlider(PanelContext& ui) {
  const ShownAccuracy& accuracy = ui.input.accuracy;
  const int last = static_cast<int>(accuracy.front.size()) - 1;
  const auto current = std::ranges::find(accuracy.front, accuracy.current);
  const bool onFront = current != accuracy.front.end();
  int index = onFront ? static_cast<int>(current - accuracy.front.begin()) : 0;
  const std::string place = onFront ? fmt::format("{} of {}", index + 1, last + 1) : std::string("off the front");
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Fast");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-5.5f * ImGui::GetFontSize());
  if (ImGui::SliderInt("Accurate", &index, 0, std::max(last, 0), place.c_str()) && last >= 0) {
    ui.send(ApplyPoint{accuracy.front[index]});
  }
  recordWidget(ui, "accuracy.slider");
  // Below the slider, which is too narrow for most names.
  commandButton(ui, "Back", "accuracy.back", "Returns to your settings, from before a point was picked.",
                SetSettings{accuracy.own.value_or(ui.settings)}, differsFromOwn(ui));
  nextButton(ui, "Compare", "accuracy.compare", "A | B: shows your settings on the left, and the point on the right.",
             ToggleSplit{SplitStart::point}, comparesPoint(ui));
  ImGui::SameLine();
  wrappedText(accuracy.current >= 0 ? accuracy.points[accuracy.current].name : "Other settings");
  dimmedText(accuracy.alone ? "Shown as measured, as one picture: mean FLIP " +
                                  significant(accuracy.points[accuracy.current].error, 3)
                            : "Not a picked point: a still view shows the mean of several pictures.");
}

// Returns the bound that is set when the user switches one on: what the settings in use were measured to take, or else
// the fastest of the front, rounded up to two digits.
double firstBound(const ShownAccuracy& accuracy, double PointRow::*figure) {
  if (accuracy.front.empty()) {
    return 0.0;
  }
  const int point = accuracy.current >= 0 ? accuracy.current : accuracy.front.front();
  const double value = accuracy.points[point].*figure;
  const double step = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-6))) - 1.0);
  return step * std::ceil(value / step);
}

void budget(PanelContext& ui) {
  QualitySettings& quality = ui.settings.quality;
  const ShownAccuracy& accuracy = ui.input.accuracy;
  const auto bound = [&](double& value, double usual, const char* format, const char* key) {
    bool active = value > 0.0;
    // Without points a bound would be a guess, which chooses later, when nobody expects it.
    ImGui::BeginDisabled(!active && accuracy.points.empty());
    if (ImGui::Checkbox(findSettingField(key)->label, &active)) {
      value = active ? usual : 0.0;
    }
    ImGui::EndDisabled();
    recordWidget(ui, key, settingHelp(key));
    if (active) {
      const float width = 8.0f * ImGui::GetFontSize();
      continueRow("", width);
      ImGui::SetNextItemWidth(width);
      double edited = value;
      if (ImGui::InputDouble((std::string("##") + key).c_str(), &edited, 0.0, 0.0, format,
                             ImGuiInputTextFlags_EnterReturnsTrue) &&
          edited > 0.0) {
        value = edited;
      }
    }
  };
  bound(quality.budgetMs, firstBound(accuracy, &PointRow::ms), "%.2f", "quality.budget_ms");
  bound(quality.maxError, firstBound(accuracy, &PointRow::error), "%.4f", "quality.max_error");
  if (accuracy.choiceMisses) {
    coloredText(warningColor, accuracy.choice);
  } else if (!accuracy.choice.empty()) {
    wrappedText(accuracy.choice);
  } else if (accuracy.points.empty()) {
    dimmedText(accuracy.measuring ? "Being measured: bounds choose among the first points."
                                  : "Bounds choose among measured points. Measure this view first.");
  }
}

void differenceMap(PanelContext& ui) {
  const ShownAccuracy& accuracy = ui.input.accuracy;
  ImGui::Checkbox("Show the error of this picture", &ui.state.showDifference);
  recordWidget(ui, "accuracy.difference");
  if (!ui.state.showDifference) {
    return;
  }
  wrappedText(accuracy.difference);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float height = 0.6f * ImGui::GetFontSize();
  const float step =
      ImGui::GetContentRegionAvail().x / static_cast<float>(std::max<size_t>(accuracy.heatBar.size(), 1));
  for (size_t i = 0; i < accuracy.heatBar.size(); ++i) {
    const glm::vec3& c = accuracy.heatBar[i];
    const float x = corner.x + step * static_cast<float>(i);
    ImGui::GetWindowDrawList()->AddRectFilled({x, corner.y}, {x + step, corner.y + height},
                                              ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, 1.0f}));
  }
  ImGui::Dummy({1.0f, height});
  const float gain = ui.state.errorGain;
  dimmedText(fmt::format("FLIP from 0, left, to {}{} (gain {})", significant(1.0 / gain, 3),
                         gain > 1.0f ? " and more" : "", significant(gain, 3)));
  ImGui::SliderFloat(labelFor("Gain", 8.0f * ImGui::GetFontSize()).c_str(), &ui.state.errorGain, 1.0f, 100.0f, "%.1f",
                     ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  recordWidget(ui, "accuracy.gain", "Multiplies the errors that the map shows, so that small ones are seen.");
}

std::string timeLeft(double seconds) {
  if (seconds <= 0.0) {
    return "Time left: not known yet";
  }
  const bool inMinutes = seconds >= 99.5;
  return fmt::format("About {:.0f} {} left of this step", inMinutes ? seconds / 60.0 : seconds,
                     inMinutes ? "min" : "s");
}

}  // namespace

bool comparesPoint(const PanelContext& ui) {
  return !ui.input.split.on && ui.input.accuracy.current >= 0 && differsFromOwn(ui);
}

void accuracy(PanelContext& ui) {
  const ShownAccuracy& accuracy = ui.input.accuracy;
  if (!accuracy.measuring) {
    commandButton(ui, "Measure this view", "accuracy.measure", "Runs in the background while you go on.",
                  MeasureAccuracy{});
  } else {
    commandButton(ui, "Cancel", "accuracy.cancel", "", CancelMeasurement{});
    continueRow(accuracy.stage.c_str());
    ImGui::ProgressBar(static_cast<float>(accuracy.progress), ImVec2(-1.0f, 0.0f), accuracy.stage.c_str());
  }
  if (accuracy.measuring) {
    // Always a line, so that the widgets below stay in their places when a step begins.
    dimmedText(timeLeft(accuracy.secondsLeft));
  }
  if (accuracy.points.empty() && accuracy.about.empty()) {
    wrappedText(
        "Finds the settings that are the most accurate within a time: traces how this view should look, draws it with "
        "each configuration and compares, and measures the times. Of its 7 steps the first 4 give rough figures.");
  }
  if (!accuracy.about.empty()) {
    wrappedText(accuracy.about);
  }
  if (accuracy.otherView) {
    coloredText(warningColor, "The view has changed since. Measure again for figures of this one.");
  }
  if (!accuracy.points.empty()) {
    plot(ui);
    frontSlider(ui);
  }
  ImGui::Separator();
  budget(ui);
  ImGui::Separator();
  differenceMap(ui);
}

}  // namespace speculum::panels
