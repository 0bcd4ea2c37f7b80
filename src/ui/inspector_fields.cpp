// The fields of the selected node.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "image/color.hpp"
#include "scene/scene_loader.hpp"
#include "ui/inspector_parts.hpp"

namespace speculum::panels {

namespace {

constexpr double farthest = 1e15;  // metres and degrees; docs/scene_format.md, Limits
constexpr double anyColor = 1e6;

// Widgets that edit one node. Each notes its place as "edit.KEY" and explains itself.
class Fields {
 public:
  explicit Fields(PanelContext& ui) : ui_(ui) {}

  bool edited() const { return edited_; }
  void setEdited() { edited_ = true; }

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
  // Of a number of its own format; tells nobody.
  bool vertex(const char* key, const char* label, glm::dvec3& v) {
    const double low = -farthest;
    const double high = farthest;
    const bool changed = ImGui::DragScalarN(label, ImGuiDataType_Double, &v.x, 3, 0.01f, &low, &high, "%.6g",
                                            ImGuiSliderFlags_AlwaysClamp);
    number_ = true;
    explain(key, "metres; the polygon must stay planar and convex");
    return changed;
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
  void explain(const char* key, const char* tip) {
    notePlace(ui_, std::string("edit.") + key);
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) {
      ImGui::SetTooltip("%s%s", tip, number_ ? "\ndrag, or click to type" : "");
    }
    number_ = false;
  }
  bool done(bool changed, const char* key, const char* tip) {
    explain(key, tip);
    edited_ = edited_ || changed;
    return changed;
  }

  PanelContext& ui_;
  bool edited_ = false;
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

// The button between a vertex's numbers and its label.
bool vertexButton(PanelContext& ui, const char* label, const std::string& key, bool enabled, const char* about) {
  ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::Button(label, {ImGui::GetFrameHeight(), 0.0f});
  ImGui::EndDisabled();
  notePlace(ui, "edit." + key);
  tip(about);
  return pressed;
}

// One row; true if anything was changed.
bool polygonVertex(PanelContext& ui, Fields& fields, std::vector<glm::dvec3>& vertices, size_t i) {
  const std::string key = "polygon." + std::to_string(i);
  ImGui::PushID(static_cast<int>(i));
  bool changed = fields.vertex(key.c_str(), "##vertex", vertices[i]);
  const glm::dvec3 middle = 0.5 * (vertices[i] + vertices[(i + 1) % vertices.size()]);
  if (vertexButton(ui, "+", key + ".add", true, "another vertex, halfway to the next one")) {
    vertices.insert(vertices.begin() + static_cast<std::ptrdiff_t>(i) + 1, middle);
    changed = true;
  } else if (vertexButton(ui, "-", key + ".remove", vertices.size() > 3, "without this vertex")) {
    vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(i));
    changed = true;
  }
  ImGui::PopID();
  return changed;
}

// What is typed becomes the mirror's as soon as a scene file could say it.
void polygonFields(PanelContext& ui, Fields& fields, Mirror& mirror) {
  PanelState::Polygon& polygon = ui.state.polygon;
  const int selected = ui.view.edit.selected.index;
  if (polygon.mirror != selected || polygon.taken != mirror.polygon) {
    polygon = {.vertices = mirror.polygon, .taken = mirror.polygon, .mirror = selected};
  }
  ImGui::TextDisabled("vertices, m, counter-clockwise in front");
  bool changed = false;
  for (size_t i = 0; i < polygon.vertices.size(); ++i) {
    changed = polygonVertex(ui, fields, polygon.vertices, i) || changed;
  }
  if (changed) {
    polygon.problem = mirrorPolygonProblem(polygon.vertices);
    if (!polygon.problem) {
      mirror.polygon = polygon.taken = polygon.vertices;
      fields.setEdited();
    }
  }
  if (polygon.problem) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.92f, 0.38f, 0.28f, 1.0f));
    ImGui::TextWrapped("Not applied: %s", polygon.problem->c_str());
    ImGui::PopStyleColor();
    if (button(ui, "Revert", "edit.polygon.reset", "Back to the mirror's vertices")) {
      polygon = {};
    }
  }
}

void mirrorShape(PanelContext& ui, Fields& fields, Mirror& mirror) {
  if (mirror.polygon.empty()) {
    fields.vec("position", "position, m", mirror.position, 0.01, "of the middle, metres");
    fields.vec("rotation", "rotation, deg", mirror.rotation, 0.5, rotationTip);
    fields.number("width", "width, m", mirror.size.x, 0.01, 0.001, 1e6, "%.3f", "metres");
    fields.number("height", "height, m", mirror.size.y, 0.01, 0.001, 1e6, "%.3f", "metres");
    fields.vec("spin", "spin, deg/s", mirror.spin, 0.5, "degrees per second added to the rotation");
    return;
  }
  polygonFields(ui, fields, mirror);
}

void mirrorFields(PanelContext& ui, Fields& fields, Mirror& mirror) {
  fields.text("name", "name", mirror.name, "what lists, passes and statistics call the mirror");
  mirrorShape(ui, fields, mirror);
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

// The mirrors that the node was picked through; a click selects one.
void throughButtons(PanelContext& ui) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("seen in:");
  for (size_t i = 0; i < ui.view.edit.through.size(); ++i) {
    const Selection mirror{Selection::Kind::mirror, ui.view.edit.through[i]};
    ImGui::SameLine();
    ImGui::PushID(static_cast<int>(i));  // a mirror may come twice
    if (ImGui::SmallButton(speculum::describe(*ui.view.edit.scene, mirror).c_str())) {
      ui.send(SelectNode{mirror});
    }
    notePlace(ui, "edit.through." + std::to_string(i));
    ImGui::PopID();
    tip("Select it");
  }
}

void gizmoMode(PanelContext& ui) {
  for (const auto& [label, key, mode] :
       {std::tuple("Move", "edit.move", GizmoMode::move), std::tuple("Rotate", "edit.rotate", GizmoMode::turn)}) {
    if (ImGui::RadioButton(label, ui.view.edit.mode == mode)) {
      ui.send(SetGizmoMode{mode});
    }
    notePlace(ui, key);
    ImGui::SameLine();
  }
  ImGui::TextDisabled("  G: switch   Ctrl: snap");
}

}  // namespace

void selectedNode(PanelContext& ui) {
  const EditView& edit = ui.view.edit;
  if (!edit.selected) {
    ImGui::TextWrapped("Click an object, light or mirror in the picture, or choose it from the list.");
    return;
  }
  if (!edit.others.empty()) {
    ImGui::TextWrapped("%d more are selected; the fields show the first", static_cast<int>(edit.others.size()));
  }
  if (!edit.through.empty()) {
    throughButtons(ui);
  }
  if (edit.selected.kind == Selection::Kind::mirror) {
    if (button(ui, "Look out of it", "edit.look_out", "Shift+B: the view that the mirror has")) {
      ui.send(LookFromMirror{MirrorSide::front});
    }
    ImGui::SameLine();
    if (button(ui, "Look from behind", "edit.look_behind", "B: what the mirror shows, seen through it")) {
      ui.send(LookFromMirror{MirrorSide::back});
    }
  }
  gizmoMode(ui);
  ImGui::PushItemWidth(-8.0f * ImGui::GetFontSize());
  Fields fields(ui);
  Thing node = thingOf(*edit.scene, edit.selected);
  if (auto* object = std::get_if<Object>(&node)) {
    objectFields(fields, *object);
  } else if (auto* light = std::get_if<PointLight>(&node)) {
    lightFields(fields, *light);
  } else if (auto* mirror = std::get_if<Mirror>(&node)) {
    mirrorFields(ui, fields, *mirror);
  }
  ImGui::PopItemWidth();
  if (fields.edited()) {
    ui.state.editing = ImGui::IsAnyItemActive();
    ui.send(EditNode{std::move(node), ui.state.editing});
  }
}

}  // namespace speculum::panels
