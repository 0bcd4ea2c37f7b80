#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "scene/scene_fields.hpp"
#include "scene/scene_loader.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr double farthest = 1e15;  // metres and degrees; docs/scene_format.md, Limits

// Makes a label from a key unless the field has one: "casts_light" becomes "Casts light", and "orbit.speed" with its
// unit "Orbit speed (deg/s)".
template <typename Field>
std::string labelOf(const Field& field, std::string path) {
  std::ranges::replace_if(
      path, [](char c) { return c == '_' || c == '.'; }, ' ');
  path[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(path[0])));
  const std::string label = field.label.empty() ? path : std::string(field.label);
  return field.unit.empty() ? label : label + " (" + std::string(field.unit) + ")";
}

// Returns a format whose decimals show a drag by one pixel.
const char* formatOf(double step) {
  return step >= 1.0 ? "%.0f" : step >= 0.1 ? "%.2f" : step >= 0.001 ? "%.3f" : "%.4f";
}

template <typename Field>
bool dragNumbers(const Field& field, const char* label, double* values, int count) {
  const double low = std::max({field.range.low, field.floor, -farthest}) + (field.range.aboveLow ? field.step / 10 : 0);
  const double high = std::min({field.range.high, field.ceiling, farthest});
  const std::string shown =
      labelFor(label, (count > 1 ? 4.3f * static_cast<float>(count) : 5.0f) * ImGui::GetFontSize());
  return ImGui::DragScalarN(shown.c_str(), ImGuiDataType_Double, values, count, static_cast<float>(field.step), &low,
                            &high, formatOf(field.step), ImGuiSliderFlags_AlwaysClamp);
}

// Edits a scale but never sets it to zero, which the loader refuses.
template <typename Field>
bool scaleWidget(const Field& field, const char* label, glm::dvec3& scale) {
  glm::dvec3 edited = scale;
  const bool changed = dragNumbers(field, label, &edited.x, 3);
  for (int i = 0; i < 3; ++i) {
    scale[i] = std::abs(edited[i]) >= 1e-6 ? edited[i] : scale[i];
  }
  return changed;
}

template <typename Enum>
bool choiceWidget(const char* label, Enum& value) {
  const auto known = choicesOf(value);
  int index = static_cast<int>(value);
  const bool changed = choice(label, index, std::vector<std::string>(known.begin(), known.end()));
  value = static_cast<Enum>(index);
  return changed;
}

template <typename Field, typename Value>
bool valueWidget(const Field& field, const char* label, Value& value) {
  if constexpr (std::is_same_v<Value, bool>) {
    return ImGui::Checkbox(label, &value);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return ImGui::InputText(labelFor(label, 5.0f * ImGui::GetFontSize()).c_str(), &value);
  } else if constexpr (std::is_same_v<Value, int>) {
    return ImGui::DragInt(labelFor(label, 5.0f * ImGui::GetFontSize()).c_str(), &value, static_cast<float>(field.step),
                          static_cast<int>(field.range.low), static_cast<int>(std::min(field.range.high, 1e4)), "%d",
                          ImGuiSliderFlags_AlwaysClamp);
  } else if constexpr (std::is_same_v<Value, double>) {
    return dragNumbers(field, label, &value, 1);
  } else if constexpr (std::is_same_v<Value, glm::dvec2>) {
    return dragNumbers(field, label, &value.x, 2);
  } else if constexpr (std::is_same_v<Value, glm::dvec3>) {
    return field.color     ? colorEdit(label, value, std::min(field.range.high, farthest))
           : field.uniform ? scaleWidget(field, label, value)
                           : dragNumbers(field, label, &value.x, 3);
  } else {
    return choiceWidget(label, value);
  }
}

template <typename Value>
constexpr bool isNumbers = std::is_same_v<Value, double> || std::is_same_v<Value, int> ||
                           std::is_same_v<Value, glm::dvec2> || std::is_same_v<Value, glm::dvec3>;

// Draws a button between a vertex's numbers and its label.
bool vertexButton(PanelContext& ui, const char* label, const std::string& key, bool enabled, const char* about) {
  ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::Button(label, {ImGui::GetFrameHeight(), 0.0f});
  ImGui::EndDisabled();
  recordWidget(ui, "edit." + key, about);
  return pressed;
}

// Draws the row of vertex `i`. Returns true if the user changed anything.
bool polygonVertex(PanelContext& ui, std::vector<glm::dvec3>& vertices, size_t i) {
  const std::string key = "polygon." + std::to_string(i);
  ImGui::PushID(static_cast<int>(i));
  const double low = -farthest;
  const double high = farthest;
  ImGui::SetNextItemWidth(-2.0f * (ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x));
  bool changed = ImGui::DragScalarN("##vertex", ImGuiDataType_Double, &vertices[i].x, 3, 0.01f, &low, &high, "%.6g",
                                    ImGuiSliderFlags_AlwaysClamp);
  recordWidget(ui, "edit." + key, "Metres. The polygon must stay planar and convex.");
  const glm::dvec3 middle = 0.5 * (vertices[i] + vertices[(i + 1) % vertices.size()]);
  if (vertexButton(ui, "+", key + ".add", true, "Adds a vertex halfway to the next one.")) {
    vertices.insert(vertices.begin() + static_cast<std::ptrdiff_t>(i) + 1, middle);
    changed = true;
  } else if (vertexButton(ui, "-", key + ".remove", vertices.size() > 3, "Removes this vertex.")) {
    vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(i));
    changed = true;
  }
  ImGui::PopID();
  return changed;
}

// Edits copies of a polygon mirror's vertices, and hands them to the mirror once they are a valid polygon. Returns true
// if the mirror got them.
bool polygonRows(PanelContext& ui, std::vector<glm::dvec3>& vertices) {
  PanelState::Polygon& polygon = ui.state.polygon;
  const int selected = ui.input.edit.selected.index;
  if (polygon.mirror != selected || polygon.taken != vertices) {
    polygon = {.vertices = vertices, .taken = vertices, .mirror = selected};
  }
  dimmedText("Shape by vertices (m), counter-clockwise from the front");
  recordWidget(ui, "edit.polygon",
               "The file gives this mirror's vertices, so it has no position, rotation and size, as "
               "mirrors have that are added. Its handles move all vertices.");
  bool changed = false;
  for (size_t i = 0; i < polygon.vertices.size(); ++i) {
    changed = polygonVertex(ui, polygon.vertices, i) || changed;
  }
  if (changed) {
    polygon.problem = mirrorPolygonProblem(polygon.vertices);
    if (!polygon.problem) {
      vertices = polygon.taken = polygon.vertices;
    }
  }
  const bool applied = changed && !polygon.problem;
  if (polygon.problem) {
    ui.output.refusedEdit = true;
    coloredText(errorColor, "Not applied: " + *polygon.problem);
    if (button(ui, "Revert", "edit.polygon.reset", "Returns to the mirror's vertices.")) {
      polygon = {};
    }
  }
  return applied;
}

class FieldRows {
 public:
  explicit FieldRows(PanelContext& ui) : ui_(ui) {}

  // Returns true if the user changed a field.
  template <Described Node>
  bool edit(Node& node, const std::string& prefix = {}) {
    bool changed = false;
    forEachField<Node>([&](const auto& field) {
      using Value = typename std::decay_t<decltype(field)>::Value;
      // A field that is set stays visible even if it would not be saved.
      const bool applies = IsOptional<Value>::value || field.appliesTo(node);
      if (applies && (!field.shown || field.shown(node))) {
        changed = row(field, prefix + std::string(field.key), node.*field.member) || changed;
      }
    });
    return changed;
  }

 private:
  template <typename Field, typename Value>
  bool row(const Field& field, const std::string& path, Value& value) {
    if constexpr (Described<Value>) {
      return edit(value, path + ".");
    } else if constexpr (IsOptional<Value>::value) {
      return optionalRow(field, path, value);
    } else if constexpr (std::is_same_v<Value, std::vector<glm::dvec3>>) {
      return polygonRows(ui_, value);
    } else {
      const bool changed = valueWidget(field, labelOf(field, path).c_str(), value);
      explain(path, field.text, isNumbers<Value>);
      return changed;
    }
  }

  // Draws a check box that switches the value on, then its widget or rows.
  template <typename Field, typename Value>
  bool optionalRow(const Field& field, const std::string& path, std::optional<Value>& value) {
    bool on = value.has_value();
    bool changed = false;
    const std::string label = labelOf(field, path);
    if (field.start) {
      const bool inLine = on && !Described<Value>;
      changed = ImGui::Checkbox((inLine ? "##" + label : label).c_str(), &on);
      explain(path, field.text, false);
      value = changed ? (on ? field.start : std::nullopt) : value;
    }
    if constexpr (Described<Value>) {
      return (value && edit(*value, path + ".")) || changed;
    } else if (value) {
      ImGui::SameLine();
      changed = valueWidget(field, label.c_str(), *value) || changed;
      explain(path + ".value", field.text, isNumbers<Value> && !field.color);
    }
    return changed;
  }

  void explain(const std::string& path, std::string_view text, bool number) {
    std::string about = std::string(text) + (number ? ". Drag, or click to type." : ".");
    about[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(about[0])));
    recordWidget(ui_, "edit." + path, ImGui::IsItemActive() ? "" : about);
  }

  PanelContext& ui_;
};

}  // namespace

bool fieldRows(PanelContext& ui, CameraSpec& camera) {
  return FieldRows(ui).edit(camera, "camera.");
}

bool fieldRows(PanelContext& ui, SceneNode& node) {
  return std::visit(
      [&](auto& fields) {
        if constexpr (Described<std::decay_t<decltype(fields)>>) {
          return FieldRows(ui).edit(fields);
        }
        return false;
      },
      node);
}

}  // namespace speculum::panels
