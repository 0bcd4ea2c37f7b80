#include "app/scene_editor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "edit/outline.hpp"
#include "scene/input_error.hpp"

namespace speculum {

namespace {

constexpr double armPixels = 92.0;     // of the handles
constexpr double handleReach = 7.0;    // pixels within which one is taken hold of
constexpr double sameSpot = 4.0;       // pixels within which a click repeats the last one
constexpr double objectAhead = 2.5;    // half diagonals of a model, to stand before it and not in it
constexpr double farthestAhead = 4.0;  // metres from the eye to where things are added

std::vector<Selection> allThings(const Scene& scene) {
  std::vector<Selection> things;
  const auto add = [&](Selection::Kind kind, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      things.push_back({kind, static_cast<int>(i)});
    }
  };
  add(Selection::Kind::mirror, scene.mirrors.size());
  add(Selection::Kind::light, scene.lights.size());
  add(Selection::Kind::object, scene.objects.size());
  return things;
}

template <typename Item>
void replace(std::vector<Item>& items, int index, const Thing& thing) {
  if (const Item* item = std::get_if<Item>(&thing)) {
    items.at(static_cast<size_t>(index)) = *item;
  }
}

std::string text(const char* format, double a, double b = 0.0, double c = 0.0) {
  std::array<char, 96> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, a, b, c);
  return buffer.data();
}

}  // namespace

SceneEditor::SceneEditor(Scene& scene, std::span<const std::filesystem::path> shipped,
                         std::function<void()> beforeChange)
    : document_(scene),
      shipped_(shipped),
      beforeChange_(std::move(beforeChange)),
      shownRevision_(document_.revision()) {
  modelsChanged();
}

Picker& SceneEditor::picker() {
  if (!picker_) {
    picker_ = std::make_unique<Picker>(document_.scene());
  }
  return *picker_;
}

void SceneEditor::put(const std::string& verb, std::span<const Placed> things) {
  beforeChange_();
  const std::string what =
      things.size() == 1 ? describe(document_.scene(), things[0].first) : std::to_string(things.size()) + " things";
  document_.change(verb + " " + what, things[0].first, [&](Scene& scene) {
    for (const auto& [selection, thing] : things) {
      replace(scene.objects, selection.index, thing);
      replace(scene.lights, selection.index, thing);
      replace(scene.mirrors, selection.index, thing);
    }
  });
}

void SceneEditor::forgetPath() {
  path_.clear();
  clicked_.reset();
}

void SceneEditor::select(const Selection& selection) {
  forgetPath();
  others_.clear();
  document_.select(selection);
}

void SceneEditor::selectNext(int step) {
  const std::vector<Selection> things = allThings(document_.scene());
  if (things.empty()) {
    return;
  }
  const auto now = std::find_if(things.begin(), things.end(),
                                [&](const Selection& thing) { return sameThing(thing, document_.selection()); });
  const auto count = static_cast<int>(things.size());
  const int start = now != things.end() ? static_cast<int>(now - things.begin()) : step > 0 ? -1 : 0;
  select(things[static_cast<size_t>((start + step + count) % count)]);
}

void SceneEditor::click(const Look& look, const glm::dvec2& pixel) {
  Clicked next{.found = picker().at(look.state, look.picture, pixel, look.limits), .pixel = pixel};
  if (next.found.empty()) {
    return select({});
  }
  const auto same = [](const Picked& a, const Picked& b) { return a.what == b.what && a.path == b.path; };
  if (clicked_ && glm::distance(clicked_->pixel, pixel) <= sameSpot &&
      std::equal(next.found.begin(), next.found.end(), clicked_->found.begin(), clicked_->found.end(), same)) {
    next.chosen = (clicked_->chosen + 1) % next.found.size();
  }
  const Picked picked = next.found[next.chosen];
  select(picked.what);
  path_ = picked.path;
  clicked_ = std::move(next);
}

// The image that was clicked, as long as any of it can be seen; otherwise the picture itself.
PictureView SceneEditor::clickedImage(const Look& look) const {
  const auto image = look.picture.through(document_.scene(), look.state, path_);
  const Selection& selected = document_.selection();
  // A thing that is dragged out of the mirror is held on to.
  const bool seen = image && (drag_ || image->sees(pivotOf(document_.scene(), look.state, selected),
                                                   reachOf(document_.scene(), look.state, selected)));
  return seen ? *image : look.picture;
}

Gizmo SceneEditor::gizmo(const Look& look) const {
  const Selection& selected = document_.selection();
  const bool turns = selected.kind != Selection::Kind::light || !others_.empty();
  const GizmoMode mode = turns ? mode_ : GizmoMode::move;
  return {mode, pivotOf(document_.scene(), look.state, selected), armPixels * look.scale};
}

bool SceneEditor::press(const Look& look, const glm::dvec2& pixel) {
  const Selection selected = document_.selection();
  if (!selected) {
    return false;
  }
  const PictureView picture = clickedImage(look);
  const Gizmo handles = gizmo(look);
  const Grip handle = handles.at(picture, pixel, handleReach * look.scale);
  if (handle == Grip::none) {
    return false;
  }
  document_.endGesture();
  document_.beginGesture();
  drag_ = Drag{.gizmo = GizmoDrag(picture, handles, handle, pixel), .time = look.state.time, .pixel = pixel};
  const Scene& scene = document_.scene();
  for (const Selection& thing : this->selected()) {
    drag_->held.push_back({thing, thingOf(scene, thing), pivotOf(scene, look.state, thing)});
  }
  return true;
}

void SceneEditor::drag(const glm::dvec2& pixel, bool snap) {
  if (!drag_) {
    return;
  }
  drag_->pixel = pixel;
  drag_->change = drag_->gizmo.to(pixel, snap);
  std::vector<Placed> things;
  for (const Held& held : drag_->held) {
    things.emplace_back(held.what, dragged(held));
  }
  put(drag_->gizmo.handle() >= Grip::turnX ? "turn" : "move", things);
}

void SceneEditor::release() {
  if (drag_) {
    drag_.reset();
    clicked_.reset();
    document_.endGesture();
  }
}

void SceneEditor::cancelDrag() {
  if (drag_) {
    beforeChange_();
    drag_.reset();
    document_.cancelGesture();
  }
}

// On the way to what the middle of the picture shows.
glm::dvec3 SceneEditor::placeAhead(const Look& look, double part, double least) {
  const glm::dvec2 middle = 0.5 * look.picture.view().pictureSize;
  const std::vector<Picked> found = picker().at(look.state, look.picture, middle, {.maxDepth = 0});
  const double far = found.empty() ? farthestAhead : look.picture.depth(found[0].point);
  const double ahead = std::max(std::min(part * far, farthestAhead), least);
  const double perMetre = std::pow(10.0, std::ceil(2.0 - std::log10(ahead)));  // hundredths of it, for short numbers
  return glm::round((look.picture.eye() + look.picture.forward() * ahead) * perMetre) / perMetre;
}

std::filesystem::path SceneEditor::chosenModel(const UiEdit& edit) const {
  const auto chosen = static_cast<size_t>(edit.model);
  if (chosen < models_.size()) {
    return models_[chosen];
  }
  const std::filesystem::path typed = edit.modelFile;
  const std::filesystem::path file = (document_.scene().file.parent_path() / typed).lexically_normal();
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) {
    throw InputError(oneLine(file.string() + ": there is no such file (name a Wavefront OBJ file)"));
  }
  return file;
}

void SceneEditor::modelsChanged() {
  models_.clear();
  for (const Mesh& mesh : document_.scene().meshes) {
    models_.push_back(mesh.source);
  }
  const size_t own = models_.size();
  std::error_code none;
  for (const std::filesystem::path& file : shipped_) {
    if (std::none_of(
            models_.begin(), models_.begin() + static_cast<std::ptrdiff_t>(own),
            [&](const std::filesystem::path& model) { return std::filesystem::equivalent(model, file, none); })) {
      models_.push_back(file);
    }
  }
  picker_.reset();
  outlines_.clear();
}

void SceneEditor::add(const Look& look, EditAction kind, int mesh) {
  release();
  if (kind == EditAction::addObject && mesh < 0) {
    return;
  }
  beforeChange_();
  const glm::dvec3& eye = look.picture.eye();
  if (kind == EditAction::addMirror) {
    select(document_.addMirror(placeAhead(look, 0.6), eye));
  } else if (kind == EditAction::addLight) {
    select(document_.addLight(placeAhead(look, 0.6), eye));
  } else {
    const double size = glm::length(document_.scene().meshes.at(static_cast<size_t>(mesh)).halfExtent);
    select(document_.addObject(mesh, placeAhead(look, 0.9, objectAhead * size)));
  }
}

void SceneEditor::bookmark(Bookmark view) {
  release();
  document_.addBookmark(std::move(view));
}

void SceneEditor::removeBookmark(size_t index) {
  release();
  document_.removeBookmark(index);
}

void SceneEditor::showThings(UiEdit& edit) const {
  const Scene& scene = document_.scene();
  edit.things.clear();
  for (const Selection& thing : allThings(scene)) {
    edit.things.emplace_back(thing, describe(scene, thing));
  }
  edit.models.clear();
  for (const std::filesystem::path& model : models_) {
    edit.models.push_back(model.stem().string());
  }
  edit.model = std::clamp(edit.model, 0, static_cast<int>(edit.models.size()));
  edit.through.clear();
  for (const int mirror : path_) {
    edit.through.push_back(describe(scene, {Selection::Kind::mirror, mirror}));
  }
  edit.throughMirrors = path_;
}

void SceneEditor::show(UiEdit& edit) const {
  const Scene& scene = document_.scene();
  edit.overlay = {};
  edit.selected = document_.selection();
  edit.others = others_;
  edit.thing = thingOf(scene, edit.selected);
  edit.mode = mode_;
  edit.undo = document_.undoLabel();
  edit.redo = document_.redoLabel();
  edit.file = scene.file.string();
  edit.unsaved = document_.modified();
  if (edit.open) {
    showThings(edit);
  }
}

const MeshOutline& SceneEditor::meshOutline(const Selection& thing) {
  static const MeshOutline none;
  if (thing.kind != Selection::Kind::object) {
    return none;
  }
  const Scene& scene = document_.scene();
  const int mesh = scene.objects.at(static_cast<size_t>(thing.index)).mesh;
  const auto known = outlines_.find(mesh);
  return known != outlines_.end()
             ? known->second
             : outlines_.emplace(mesh, speculum::meshOutline(scene.meshes.at(static_cast<size_t>(mesh)))).first->second;
}

UiOverlay SceneEditor::overlay(const Look& look, const std::optional<glm::dvec2>& pointer) {
  const Scene& scene = document_.scene();
  Selection selected = document_.selection();
  if (selected.kind == Selection::Kind::object && !instanceOf(look.state, selected)) {
    selected.copy = 0;  // the object has fewer copies now
    document_.select(selected);
  }
  UiOverlay overlay;
  const MeshOutline& shape = meshOutline(selected);
  const PictureView image = clickedImage(look);
  overlay.outline = outlineOf(scene, look.state, selected, image, shape);
  if (!image.path().empty()) {
    overlay.itself = outlineOf(scene, look.state, selected, look.picture, shape);
  }
  for (const Selection& other : others_) {
    const std::vector<PixelLine> lines = outlineOf(scene, look.state, other, look.picture, meshOutline(other));
    overlay.outline.insert(overlay.outline.end(), lines.begin(), lines.end());
  }
  const Gizmo handles = gizmo(look);
  overlay.gizmo = handles.shapes(image);
  if (drag_) {
    overlay.active = drag_->gizmo.handle();
    overlay.label = dragLabel();
    overlay.labelAt = drag_->pixel;
  } else if (pointer) {
    overlay.active = handles.at(image, *pointer, handleReach * look.scale);
  }
  return overlay;
}

std::string SceneEditor::dragLabel() const {
  const GizmoDrag::Change& change = drag_->change;
  const Grip handle = drag_->gizmo.handle();
  const int axis = axisOf(handle);
  if (handle >= Grip::turnX) {
    return std::string(1, "XYZ"[axis]) + text("  %+.1f deg", change.degrees);
  }
  if (handle <= Grip::moveZ) {
    return std::string(1, "XYZ"[axis]) + text("  %+.3f m", change.translation[axis]);
  }
  return text("%+.3f  %+.3f  %+.3f m", change.translation.x, change.translation.y, change.translation.z);
}

void SceneEditor::apply(const UiEdit& edit) {
  mode_ = edit.mode;
  if (edit.toggled) {
    return toggle(*edit.toggled);
  }
  if (!sameThing(edit.selected, document_.selection())) {
    release();
    document_.endGesture();
    return select(edit.selected);
  }
  if (edit.edited && edit.selected) {
    if (edit.held && !document_.inGesture()) {
      document_.beginGesture();
    }
    put("edit", std::array{Placed(edit.selected, edit.thing)});
  }
  if (!edit.held && !drag_ && document_.inGesture()) {
    document_.endGesture();
  }
}

}  // namespace speculum
