#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <tuple>
#include <utility>

#include "image/image.hpp"
#include "ui/gizmo_overlay.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr double farthest = 1e15;  // metres and degrees; docs/scene_format.md, Limits
constexpr double anyColor = 1e6;

// Widgets that edit one thing; each notes its place as "edit.KEY", explains itself, and tells the model of edits.
class Fields {
 public:
  explicit Fields(UiModel& model) : model_(model) {}

  bool vec(const char* key, const char* label, glm::dvec3& v, double speed, const char* tip) {
    const double low = -farthest;
    const double high = farthest;
    number_ = true;
    return done(ImGui::DragScalarN(label, ImGuiDataType_Double, &v.x, 3, static_cast<float>(speed), &low, &high, "%.3f",
                                   ImGuiSliderFlags_AlwaysClamp),
                key, tip);
  }
  bool number(const char* key, const char* label, double& v, double speed, double low, double high, const char* format,
              const char* tip, ImGuiSliderFlags flags = 0) {
    number_ = true;
    return done(ImGui::DragScalar(label, ImGuiDataType_Double, &v, static_cast<float>(speed), &low, &high, format,
                                  flags | ImGuiSliderFlags_AlwaysClamp),
                key, tip);
  }
  bool count(const char* key, const char* label, int& v, int low, int high, const char* tip) {
    number_ = true;
    return done(ImGui::DragInt(label, &v, 0.1f, low, high, "%d", ImGuiSliderFlags_AlwaysClamp), key, tip);
  }
  bool check(const char* key, const char* label, bool& v, const char* tip) {
    return done(ImGui::Checkbox(label, &v), key, tip);
  }
  // Linear in the file, sRGB in the widget; what is brighter than 1 is shown as numbers.
  bool color(const char* key, const char* label, glm::dvec3& v, const char* tip) {
    if (std::max({v.r, v.g, v.b}) > 1.0) {
      const double low = 0.0;
      return done(ImGui::DragScalarN(label, ImGuiDataType_Double, &v.x, 3, 0.01f, &low, &anyColor, "%.3f",
                                     ImGuiSliderFlags_AlwaysClamp),
                  key, tip);
    }
    std::array<float, 3> encoded{};
    for (int i = 0; i < 3; ++i) {
      encoded[i] = static_cast<float>(srgbEncode(std::clamp(v[i], 0.0, 1.0)));
    }
    const bool changed = ImGui::ColorEdit3(label, encoded.data(), ImGuiColorEditFlags_Float);
    for (int i = 0; changed && i < 3; ++i) {
      v[i] = std::round(srgbDecode(encoded[i]) * 1e6) / 1e6;
    }
    return done(changed, key, tip);
  }
  bool text(const char* key, const char* label, std::string& v, const char* tip) {
    return done(ImGui::InputText(label, &v), key, tip);
  }
  bool fresnel(Fresnel& v) {
    bool schlick = v == Fresnel::schlick;
    const bool changed =
        check("fresnel", "fresnel", schlick, "Schlick: reflects more at grazing angles, all at 90 degrees");
    v = schlick ? Fresnel::schlick : Fresnel::none;
    return changed;
  }
  // A value that may be left to the default: a box that switches it on, then its own widget.
  template <typename Value, typename Widget>
  void optional(const char* key, const char* label, std::optional<Value>& v, const Value& start, const char* tip,
                const Widget& widget) {
    bool on = v.has_value();
    if (check(key, (std::string(on ? "##" : "") + label).c_str(), on, tip)) {
      v = on ? std::optional(start) : std::nullopt;
    }
    if (v) {
      ImGui::SameLine();
      widget(*v);
    }
  }

 private:
  bool done(bool changed, const char* key, const char* tip) {
    notePlace(model_, std::string("edit.") + key);
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) {
      ImGui::SetTooltip("%s%s", tip, std::exchange(number_, false) ? "\ndrag, or click to type" : "");
    }
    number_ = false;
    model_.edit.edited = model_.edit.edited || changed;
    return changed;
  }

  UiModel& model_;
  bool number_ = false;  // the widget is a number
};

constexpr const char* rotationTip = "pitch about X, yaw about Y, roll about Z, degrees; R = Ry Rx Rz";
constexpr const char* colorTip = "linear in the file, sRGB here";

void scaleField(Fields& fields, glm::dvec3& scale) {
  glm::dvec3 edited = scale;
  if (fields.vec("scale", "scale", edited, 0.01, "along the model's own axes; negative mirrors it")) {
    for (int i = 0; i < 3; ++i) {
      scale[i] = std::abs(edited[i]) >= 1e-6 ? edited[i] : scale[i];  // zero would be an error of the file
    }
  }
}

void objectFields(Fields& fields, Object& object) {
  fields.text("name", "name", object.name, "for messages and the panel");
  fields.vec("position", "position, m", object.position, 0.01, "of the model's origin, metres");
  fields.vec("rotation", "rotation, deg", object.rotation, 0.5, rotationTip);
  scaleField(fields, object.scale);
  fields.vec("spin", "spin, deg/s", object.spin, 0.5, "degrees per second added to the rotation");
  fields.optional("color", "own color", object.color, glm::dvec3(0.6), "replaces the model's diffuse color",
                  [&](glm::dvec3& v) { fields.color("color.value", "color", v, colorTip); });
  fields.optional("specular", "own specular", object.specular, glm::dvec3(0.2), "replaces the model's highlights",
                  [&](glm::dvec3& v) { fields.color("specular.value", "specular", v, colorTip); });
  fields.optional("shininess", "own shininess", object.shininess, 50.0, "replaces the model's exponent",
                  [&](double& v) {
                    fields.number("shininess.value", "shininess", v, 1.0, 1.0, 1e4, "%.0f",
                                  "exponent of the highlights: larger is sharper");
                  });
  bool curved = object.mirror.has_value();
  if (fields.check("mirror", "curved mirror", curved, "the object reflects; its rays are traced")) {
    object.mirror = curved ? std::optional(ObjectMirror{}) : std::nullopt;
  }
  if (object.mirror) {
    fields.color("reflectance", "reflectance", object.mirror->reflectance, "share of light reflected, by channel");
    fields.fresnel(object.mirror->fresnel);
    fields.color("base_color", "base color", object.mirror->baseColor, "diffuse layer under the reflection");
  }
  fields.count("copies", "copies", object.copies.count, 1, 10000, "of the object, each moved by the step");
  if (object.copies.count > 1) {
    fields.vec("step", "step, m", object.copies.step, 0.01, "from one copy to the next, metres");
  }
}

void lightFields(Fields& fields, PointLight& light) {
  fields.text("name", "name", light.name, "for messages and the panel");
  fields.vec("position", "position, m", light.position, 0.01, "of the centre, metres");
  fields.color("color", "color", light.color, colorTip);
  fields.number("intensity", "intensity", light.intensity, 0.1, 0.0, anyColor, "%.2f",
                "irradiance at 1 m on a surface that faces the light");
  fields.number("radius", "radius, m", light.radius, 0.002, 1e-4, 1e3, "%.3f",
                "of the visible sphere, metres; nearer than that the light gets no stronger");
  fields.number("glow", "glow", light.glow, 0.01, 0.0, anyColor, "%.2f",
                "radiance of the visible sphere by the color; 0 draws none");
  if (light.orbit) {
    fields.vec("orbit.center", "orbit about, m", light.orbit->center, 0.01, "point on the axis, metres");
    fields.number("orbit.speed", "orbit, deg/s", light.orbit->speed, 0.5, -1e9, 1e9, "%.2f",
                  "degrees a second by the right-hand rule");
  }
  fields.check("casts_shadow", "casts shadow", light.castsShadow, "objects and mirrors hide the light");
}

void mirrorShape(Fields& fields, Mirror& mirror) {
  if (mirror.polygon.empty()) {
    fields.vec("position", "position, m", mirror.position, 0.01, "of the middle, metres");
    fields.vec("rotation", "rotation, deg", mirror.rotation, 0.5, rotationTip);
    fields.number("width", "width, m", mirror.size.x, 0.01, 0.001, 1e6, "%.3f", "metres");
    fields.number("height", "height, m", mirror.size.y, 0.01, 0.001, 1e6, "%.3f", "metres");
    fields.vec("spin", "spin, deg/s", mirror.spin, 0.5, "degrees per second added to the rotation");
    return;
  }
  ImGui::TextDisabled("a polygon of %d vertices: move and turn it in the picture",
                      static_cast<int>(mirror.polygon.size()));
}

void mirrorFields(Fields& fields, Mirror& mirror) {
  fields.text("name", "name", mirror.name, "what lists, passes and statistics call the mirror");
  mirrorShape(fields, mirror);
  fields.color("reflectance", "reflectance", mirror.reflectance,
               "share of light reflected, by channel; at normal incidence with Fresnel");
  fields.fresnel(mirror.fresnel);
  fields.color("base_color", "base color", mirror.baseColor, "diffuse layer under the reflection");
  fields.number("roughness", "roughness", mirror.roughness, 0.002, 0.0, 1.0, "%.3f",
                "spread of the reflection: GGX with alpha = roughness squared");
  fields.check("two_sided", "two-sided", mirror.twoSided, "reflects on its back too");
  if (!mirror.twoSided) {
    fields.color("back_color", "back color", mirror.backColor, "diffuse color of the back");
  }
  fields.check("casts_light", "casts light", mirror.castsLight, "light bounced off the mirror reaches the scene");
  bool ripples = mirror.ripple.has_value();
  if (fields.check("ripple", "ripples", ripples, "two trains of waves run over the mirror")) {
    mirror.ripple = ripples ? std::optional(Ripple{.amplitude = 0.002}) : std::nullopt;
  }
  if (mirror.ripple) {
    fields.number("amplitude", "amplitude, m", mirror.ripple->amplitude, 0.0002, 0.0, 10.0, "%.4f", "metres");
    fields.number("wavelength", "wavelength, m", mirror.ripple->wavelength, 0.005, 0.001, 1e3, "%.3f", "metres");
    fields.number("speed", "speed, m/s", mirror.ripple->speed, 0.005, -1e3, 1e3, "%.3f",
                  "of the waves, metres a second");
  }
}

// A button that asks for something; greyed out while there is nothing to do.
void actionButton(UiModel& model, const char* label, const char* key, EditAction action, bool enabled,
                  const std::string& tip) {
  ImGui::BeginDisabled(!enabled);
  if (ImGui::Button(label)) {
    model.edit.action = action;
  }
  ImGui::EndDisabled();
  notePlace(model, std::string("edit.") + key);
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
    ImGui::SetTooltip("%s", tip.c_str());
  }
}

void thingList(UiModel& model) {
  UiEdit& edit = model.edit;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  if (std::exchange(edit.focus, false)) {
    ImGui::SetNextWindowFocus();
  }
  ImGui::BeginChild("things", ImVec2(0.0f, 7.5f * line), true);
  int* shown = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("shown"), -1);  // what was scrolled to
  for (size_t i = 0; i < edit.things.size(); ++i) {
    const auto& [thing, name] = edit.things[i];
    const bool selected = thing.kind == edit.selected.kind && thing.index == edit.selected.index;
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(name.c_str(), selected)) {
      edit.selected = thing;
    }
    if (selected && std::exchange(*shown, static_cast<int>(i)) != static_cast<int>(i)) {
      ImGui::SetScrollHereY();
    }
    notePlace(model, "edit.thing." + std::to_string(i));
    ImGui::PopID();
  }
  ImGui::EndChild();
}

void addButtons(UiModel& model) {
  UiEdit& edit = model.edit;
  actionButton(model, "add mirror", "add_mirror", EditAction::addMirror, true, "where the view looks, facing it");
  ImGui::SameLine();
  actionButton(model, "add light", "add_light", EditAction::addLight, true, "where the view looks");
  actionButton(model, "add object", "add_object", EditAction::addObject, !edit.models.empty(), "where the view looks");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::BeginCombo("##model", edit.models.empty() ? "" : edit.models[static_cast<size_t>(edit.model)].c_str())) {
    for (size_t i = 0; i < edit.models.size(); ++i) {
      ImGui::PushID(static_cast<int>(i));  // names may repeat
      if (ImGui::Selectable(edit.models[i].c_str(), static_cast<int>(i) == edit.model)) {
        edit.model = static_cast<int>(i);
      }
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  notePlace(model, "edit.model");
}

constexpr const char* undoneIs = "\n(things and bookmarks; settings go back by the arrows at their lines' ends)";

void historyButtons(UiModel& model) {
  const UiEdit& edit = model.edit;
  const bool any = static_cast<bool>(edit.selected);
  actionButton(model, "duplicate", "duplicate", EditAction::duplicate, any, "Ctrl+D");
  ImGui::SameLine();
  actionButton(model, "delete", "delete", EditAction::remove, any, "Del");
  ImGui::SameLine();
  actionButton(model, "undo", "undo", EditAction::undo, !edit.undo.empty(), "Ctrl+Z   " + edit.undo + undoneIs);
  ImGui::SameLine();
  actionButton(model, "redo", "redo", EditAction::redo, !edit.redo.empty(), "Ctrl+Shift+Z   " + edit.redo + undoneIs);
  actionButton(model, "save", "save", EditAction::save, edit.unsaved || edit.unsavedSettings, "Ctrl+S   " + edit.file);
  ImGui::SameLine();
  actionButton(model, "save as ...", "save_as", EditAction::askWhere, true, "Ctrl+Shift+S");
  ImGui::SameLine();
  ImGui::TextDisabled("%s", edit.unsaved ? "unsaved changes" : edit.unsavedSettings ? "unsaved settings" : "saved");
}

// Each selects the mirror.
void throughButtons(UiModel& model) {
  UiEdit& edit = model.edit;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("seen through:");
  for (size_t i = 0; i < edit.through.size(); ++i) {
    ImGui::SameLine();
    ImGui::PushID(static_cast<int>(i));  // a mirror may come twice
    if (ImGui::SmallButton(edit.through[i].c_str())) {
      edit.selected = {Selection::Kind::mirror, edit.throughMirrors[i]};
    }
    notePlace(model, "edit.through." + std::to_string(i));
    ImGui::PopID();
    tip("select it");
  }
}

void selectedThing(UiModel& model) {
  UiEdit& edit = model.edit;
  if (!edit.selected) {
    ImGui::TextWrapped("Click something in the picture, also in a mirror, or choose it from the list.");
    return;
  }
  if (!edit.through.empty()) {
    throughButtons(model);
  }
  if (edit.selected.kind == Selection::Kind::mirror) {
    actionButton(model, "look out of it", "look_out", EditAction::lookOut, true,
                 "Shift+B: the view that the mirror has");
    ImGui::SameLine();
    actionButton(model, "look from behind", "look_behind", EditAction::lookBehind, true,
                 "B: what the mirror shows, seen through it");
  }
  int mode = static_cast<int>(edit.mode);
  for (const auto& [label, key, value] :
       {std::tuple("move", "edit.move", GizmoMode::move), std::tuple("turn", "edit.turn", GizmoMode::turn)}) {
    ImGui::RadioButton(label, &mode, static_cast<int>(value));
    notePlace(model, key);
    ImGui::SameLine();
  }
  ImGui::TextDisabled("  G: the other   Ctrl: steps");
  edit.mode = static_cast<GizmoMode>(mode);
  ImGui::PushItemWidth(-8.0f * ImGui::GetFontSize());
  Fields fields(model);
  if (auto* object = std::get_if<Object>(&edit.thing)) {
    objectFields(fields, *object);
  } else if (auto* light = std::get_if<PointLight>(&edit.thing)) {
    lightFields(fields, *light);
  } else if (auto* mirror = std::get_if<Mirror>(&edit.thing)) {
    mirrorFields(fields, *mirror);
  }
  ImGui::PopItemWidth();
}

void centerNext() {
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
}

void answerButton(UiModel& model, const char* label, const char* key, EditAction action) {
  // Dear ImGui presses what has the keyboard with the space bar only.
  const bool pressed = ImGui::Button(label);
  if (pressed || (ImGui::IsItemFocused() && model.edit.enter)) {
    model.edit.action = action;
    ImGui::CloseCurrentPopup();
  }
  notePlace(model, std::string("edit.") + key);
}

void inspector(UiModel& model, PanelDock& dock) {
  if (model.edit.focus) {
    ImGui::SetNextWindowFocus();
  }
  ImGui::SetNextWindowBgAlpha(1.0f);
  if (dock.begin(inspectorTitle, &model.edit.open, PanelDock::Edge::right, {25.0f, 46.0f})) {
    thingList(model);
    addButtons(model);
    historyButtons(model);
    ImGui::Separator();
    selectedThing(model);
  }
  ImGui::End();
}

void questions(UiModel& model) {
  UiEdit& edit = model.edit;
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings;
  if (edit.asksSave && !ImGui::IsPopupOpen("Unsaved changes")) {
    ImGui::OpenPopup("Unsaved changes");
  }
  centerNext();
  if (ImGui::BeginPopupModal("Unsaved changes", nullptr, flags)) {
    ImGui::Text("The scene has changes that are not saved.");
    ImGui::TextDisabled("%s", edit.file.c_str());
    ImGui::Spacing();
    answerButton(model, "Save", "ask.save", EditAction::save);
    ImGui::SetItemDefaultFocus();
    ImGui::SameLine();
    answerButton(model, "Save as ...", "ask.save_as", EditAction::askWhere);
    ImGui::SameLine();
    answerButton(model, "Discard", "ask.discard", EditAction::discard);
    ImGui::SameLine();
    answerButton(model, "Cancel", "ask.cancel", EditAction::stay);
    if (!edit.asksSave) {
      ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
  }
  if (edit.asksWhere && !ImGui::IsPopupOpen("Save scene as")) {
    ImGui::OpenPopup("Save scene as");
  }
  centerNext();
  if (ImGui::BeginPopupModal("Save scene as", nullptr, flags)) {
    ImGui::SetNextItemWidth(34.0f * ImGui::GetFontSize());
    if (ImGui::IsWindowAppearing()) {
      ImGui::SetKeyboardFocusHere();
    }
    ImGui::InputText("##file", &edit.saveAs, ImGuiInputTextFlags_AutoSelectAll);
    notePlace(model, "edit.file");
    if (!edit.note.empty()) {
      ImGui::TextWrapped("%s", edit.note.c_str());
    }
    answerButton(model, "Save", "where.save", EditAction::saveAs);
    ImGui::SameLine();
    answerButton(model, "Cancel", "where.cancel", EditAction::stay);
    if (edit.action == EditAction::none && edit.enter) {
      edit.action = EditAction::saveAs;
    }
    if (!edit.asksWhere) {
      ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
  }
}

}  // namespace

void inspectorButton(UiModel& model) {
  if (ImGui::Button("inspector")) {
    model.edit.open = !model.edit.open;
  }
  notePlace(model, "edit.open");
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("F2: select, move, turn, add and delete what the scene is made of");
  }
}

void edit(UiModel& model, PanelDock* dock) {
  model.edit.edited = false;
  model.edit.action = EditAction::none;
  drawOverlay(model.edit.overlay);
  if (model.edit.open && dock) {
    inspector(model, *dock);
  }
  questions(model);
  model.edit.enter = false;
  model.edit.held = model.edit.selected && ImGui::IsAnyItemActive();
}

}  // namespace speculum::panels
