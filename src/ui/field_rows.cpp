#include "ui/field_rows.hpp"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "scene/scene_fields.hpp"
#include "ui/panels.hpp"
#include "ui/setting_widgets.hpp"

namespace speculum::panels {

namespace {

constexpr double farthest = 1e15;  // metres and degrees; docs/scene_format.md, Limits

// Makes a label of a key: "casts_light" becomes "Casts light", "orbit.speed" in degrees per second "Orbit speed
// (deg/s)".
std::string labelOf(std::string path, std::string_view unit) {
  std::ranges::replace_if(
      path, [](char c) { return c == '_' || c == '.'; }, ' ');
  path[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(path[0])));
  return unit.empty() ? path : path + " (" + std::string(unit) + ")";
}

// Returns a format with the decimals that a drag by a pixel changes.
const char* formatOf(double step) {
  return step >= 1.0 ? "%.0f" : step >= 0.1 ? "%.2f" : step >= 0.001 ? "%.3f" : "%.4f";
}

template <typename Field>
bool dragNumbers(const Field& field, const char* label, double* values, int count) {
  const double low = std::max({field.range.low, field.floor, -farthest}) + (field.range.aboveLow ? field.step / 10 : 0);
  const double high = std::min({field.range.high, field.ceiling, farthest});
  return ImGui::DragScalarN(label, ImGuiDataType_Double, values, count, static_cast<float>(field.step), &low, &high,
                            formatOf(field.step), ImGuiSliderFlags_AlwaysClamp);
}

// Keeps scales from zero, which the loader refuses.
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
    return ImGui::InputText(label, &value);
  } else if constexpr (std::is_same_v<Value, int>) {
    return ImGui::DragInt(label, &value, static_cast<float>(field.step), static_cast<int>(field.range.low),
                          static_cast<int>(std::min(field.range.high, 1e4)), "%d", ImGuiSliderFlags_AlwaysClamp);
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

class FieldRows {
 public:
  explicit FieldRows(const RecordWidget& record, std::function<bool()> polygon = {})
      : record_(record), polygon_(std::move(polygon)) {}

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
      return polygon_();
    } else {
      const bool changed = valueWidget(field, labelOf(path, field.unit).c_str(), value);
      explain(path, field.text, isNumbers<Value>);
      return changed;
    }
  }

  // Draws a check box that switches the value on, then its widget or rows.
  template <typename Field, typename Value>
  bool optionalRow(const Field& field, const std::string& path, std::optional<Value>& value) {
    bool on = value.has_value();
    bool changed = false;
    const std::string label = labelOf(path, field.unit);
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
    record_("edit." + path);
    if (!ImGui::IsItemActive()) {
      std::string about = std::string(text) + (number ? ". Drag, or click to type." : ".");
      about[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(about[0])));
      tip(about.c_str());
    }
  }

  const RecordWidget& record_;
  std::function<bool()> polygon_;
};

}  // namespace

bool fieldRows(Object& object, const RecordWidget& record) {
  return FieldRows(record).edit(object);
}

bool fieldRows(PointLight& light, const RecordWidget& record) {
  return FieldRows(record).edit(light);
}

bool fieldRows(Mirror& mirror, const RecordWidget& record, const std::function<bool()>& polygon) {
  return FieldRows(record, polygon).edit(mirror);
}

}  // namespace speculum::panels
