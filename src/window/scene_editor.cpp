#include "window/scene_editor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "edit/picture_view.hpp"
#include "platform/files.hpp"
#include "platform/text.hpp"
#include "scene/input_error.hpp"
#include "scene/model_files.hpp"

namespace speculum {

namespace {

constexpr double armPixels = 92.0;     // length of the handles
constexpr double handleReach = 7.0;    // pixels within which a handle is gripped
constexpr double sameSpot = 4.0;       // pixels within which a click repeats the last one
constexpr double objectAhead = 2.5;    // least distance of an added object in half box diagonals: the eye is outside
constexpr double farthestAhead = 4.0;  // metres from the eye to where nodes are added

// Gives copies that would all stand in one place a step beside each other.
SceneNode withCopiesApart(const Scene& scene, const Selection& target, SceneNode node) {
  auto* object = std::get_if<Object>(&node);
  const bool first = object && object->copies.count > 1 && object->copies.step == glm::dvec3(0.0) &&
                     scene.objects.at(static_cast<size_t>(target.index)).copies.count <= 1;
  if (first) {
    object->copies.step = glm::round(stepBeside(scene, std::span(&target, 1)) * 1000.0) / 1000.0;
  }
  return node;
}

}  // namespace

SceneEditor::SceneEditor(SceneDocument& document, std::span<const std::filesystem::path> shipped,
                         std::function<void()> beforeChange)
    : document_(document),
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

std::vector<Selection> SceneEditor::selected() const {
  std::vector<Selection> nodes;
  if (document_.selection()) {
    nodes.push_back(document_.selection());
    nodes.insert(nodes.end(), others_.begin(), others_.end());
  }
  return nodes;
}

void SceneEditor::forgetPath() {
  path_.clear();
  clicked_.reset();
}

void SceneEditor::select(const Selection& node) {
  release();
  document_.endGesture();
  forgetPath();
  others_.clear();
  document_.select(node);
}

void SceneEditor::selectNext(int step) {
  const std::vector<Selection> nodes = allNodes(document_.scene());
  if (nodes.empty()) {
    return;
  }
  const auto now =
      std::ranges::find_if(nodes, [&](const Selection& node) { return sameNode(node, document_.selection()); });
  const auto count = static_cast<int>(nodes.size());
  const int start = now != nodes.end() ? static_cast<int>(now - nodes.begin()) : step > 0 ? -1 : 0;
  select(nodes[static_cast<size_t>((start + step + count) % count)]);
}

void SceneEditor::toggle(const Selection& node) {
  release();
  document_.endGesture();
  forgetPath();
  const Selection first = document_.selection();
  const auto other = std::ranges::find_if(others_, [&](const Selection& other) { return sameNode(other, node); });
  if (!first) {
    document_.select(node);
  } else if (other != others_.end()) {
    others_.erase(other);
  } else if (!sameNode(first, node)) {
    others_.push_back({.kind = node.kind, .index = node.index});
  } else {
    document_.select(others_.empty() ? Selection() : others_.front());
    others_.erase(others_.begin(), others_.begin() + (others_.empty() ? 0 : 1));
  }
}

void SceneEditor::click(const PointedScene& view, const glm::dvec2& pixel) {
  Clicked next{.found = picker().at(view.state, view.picture, pixel, view.limits), .pixel = pixel};
  if (next.found.empty()) {
    return select({});
  }
  const auto same = [](const Picked& a, const Picked& b) { return a.what == b.what && a.path == b.path; };
  if (clicked_ && glm::distance(clicked_->pixel, pixel) <= sameSpot &&
      std::ranges::equal(next.found, clicked_->found, same)) {
    next.chosen = (clicked_->chosen + 1) % next.found.size();
  }
  const Picked picked = next.found[next.chosen];
  select(picked.what);
  path_ = picked.path;
  clicked_ = std::move(next);
}

void SceneEditor::clickAlso(const PointedScene& view, const glm::dvec2& pixel) {
  const std::vector<Picked> found = picker().at(view.state, view.picture, pixel, view.limits);
  if (!found.empty()) {
    toggle(found.back().what);
  }
}

// Returns the view of the mirror image in which the node was clicked, as long as the node is seen there, else the view
// of the picture itself.
PictureView SceneEditor::clickedImage(const PointedScene& view) const {
  const auto image = view.picture.through(document_.scene(), view.state, path_);
  const Selection& selected = document_.selection();
  // A node that is dragged out of the mirror image stays gripped.
  const bool seen = image && (drag_ || image->sees(pivotOf(document_.scene(), view.state, selected),
                                                   reachOf(document_.scene(), view.state, selected)));
  return seen ? *image : view.picture;
}

Gizmo SceneEditor::gizmo(const PointedScene& view) const {
  const Selection& selected = document_.selection();
  const bool turns = selected.kind != Selection::Kind::light || !others_.empty();
  const GizmoMode mode = mode_ == GizmoMode::turn && !turns ? GizmoMode::move : mode_;
  return {mode, pivotOf(document_.scene(), view.state, selected), armPixels * view.scale,
          scaleAxesOf(document_.scene(), view.state, selected)};
}

bool SceneEditor::press(const PointedScene& view, const glm::dvec2& pixel) {
  if (!document_.selection()) {
    return false;
  }
  const PictureView picture = clickedImage(view);
  const Gizmo handles = gizmo(view);
  const Grip handle = handles.at(picture, pixel, handleReach * view.scale);
  if (handle == Grip::none) {
    return false;
  }
  document_.endGesture();
  document_.beginGesture();
  drag_.emplace(GizmoDrag(picture, handles, handle, pixel), document_.scene(), view.state, selected(), pixel);
  return true;
}

void SceneEditor::drag(const glm::dvec2& pixel, bool snap) {
  if (drag_) {
    constexpr std::array verbs{"move", "rotate", "scale"};
    replace(verbs[static_cast<size_t>(modeOf(drag_->handle()))], drag_->to(pixel, snap));
  }
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
    if (document_.gestureChanges()) {
      beforeChange_();
    }
    drag_.reset();
    document_.cancelGesture();
  }
}

void SceneEditor::replace(const std::string& verb, std::span<const PlacedNode> nodes) {
  beforeChange_();
  std::vector<Selection> selections;
  for (const PlacedNode& node : nodes) {
    selections.push_back(node.first);
  }
  document_.change(verb + " " + describe(document_.scene(), selections), selections.front(), [&](Scene& scene) {
    for (const PlacedNode& placed : nodes) {
      withNodes(scene, placed.first.kind, [&](auto& nodes, const auto&) {
        nodes.at(placed.first.index) = std::get<typename std::decay_t<decltype(nodes)>::value_type>(placed.second);
      });
    }
  });
}

void SceneEditor::edit(const Selection& target, const SceneNode& node, bool continued) {
  if (continued && !document_.inGesture()) {
    document_.beginGesture();
  }
  const auto* light = std::get_if<PointLight>(&node);
  const bool refused = light && light->orbit && !hasDirection(light->orbit->axis);  // the loader would refuse it
  if (!refused) {
    replace("edit", std::array{PlacedNode(target, withCopiesApart(document_.scene(), target, node))});
  }
  if (!continued) {
    endEdit();
  }
}

void SceneEditor::editCamera(const CameraSpec& camera, bool continued) {
  if (continued && !document_.inGesture()) {
    document_.beginGesture();
  }
  beforeChange_();
  document_.change("edit the camera", document_.selection(), [&](Scene& scene) { scene.camera = camera; });
  if (!continued) {
    endEdit();
  }
}

void SceneEditor::endEdit() {
  if (!drag_ && document_.inGesture()) {
    document_.endGesture();
  }
}

void SceneEditor::beginChange() {
  release();
  beforeChange_();
}

// Returns a point (world) straight ahead: at `part` of the depth of what the middle of the picture shows, and at least
// `least` metres away.
glm::dvec3 SceneEditor::pointAhead(const PointedScene& view, double part, double least) {
  const glm::dvec2 middle = 0.5 * view.picture.view().pictureSize;
  const std::vector<Picked> found = picker().at(view.state, view.picture, middle, {.maxDepth = 0});
  const double far = found.empty() ? farthestAhead : view.picture.depth(found[0].point);
  const double ahead = std::max(std::min(part * far, farthestAhead), least);
  const double perMetre = std::pow(10.0, std::ceil(2.0 - std::log10(ahead)));  // hundredths, for short numbers
  return glm::round((view.picture.eye() + view.picture.forward() * ahead) * perMetre) / perMetre;
}

void SceneEditor::addMirror(const PointedScene& view) {
  beginChange();
  select(document_.addMirror(pointAhead(view, 0.6), view.picture.eye()));
}

void SceneEditor::addLight(const PointedScene& view) {
  beginChange();
  select(document_.addLight(pointAhead(view, 0.6), view.picture.eye()));
}

void SceneEditor::addObject(const PointedScene& view, int mesh) {
  beginChange();
  const Mesh& model = document_.scene().meshes.at(static_cast<size_t>(mesh));
  const double size = model.unit * glm::length(model.halfExtent);
  select(document_.addObject(mesh, pointAhead(view, 0.9, objectAhead * size)));
}

// Returns the side (1 or -1) on which a copy of the first node is in sight; 1 if the copy is in sight on neither.
double SceneEditor::sideInSight(const PointedScene& view, std::span<const Selection> nodes,
                                const PixelRect& free) const {
  const glm::dvec3 pivot = pivotOf(document_.scene(), view.state, nodes.front());
  const glm::dvec3 step = stepBeside(document_.scene(), nodes);
  for (const double side : {1.0, -1.0}) {
    const auto at = view.picture.pixel(pivot + side * step);
    if (at && free.contains(static_cast<int>(at->x), static_cast<int>(at->y))) {
      return side;
    }
  }
  return 1.0;
}

void SceneEditor::duplicate(const PointedScene& view, const PixelRect& free) {
  const std::vector<Selection> nodes = selected();
  if (nodes.empty()) {
    return;
  }
  beginChange();
  const std::vector<Selection> copies = document_.duplicate(nodes, sideInSight(view, nodes, free));
  select(copies.front());
  others_.assign(copies.begin() + 1, copies.end());
}

std::string SceneEditor::remove() {
  const std::vector<Selection> nodes = selected();
  if (nodes.empty()) {
    return "";
  }
  std::string removed = describe(document_.scene(), nodes);
  beginChange();
  others_.clear();
  document_.remove(nodes);
  forgetPath();
  return removed;
}

void SceneEditor::addBookmark(Bookmark bookmark) {
  release();
  document_.addBookmark(std::move(bookmark));
}

void SceneEditor::removeBookmark(size_t index) {
  release();
  if (index < document_.scene().bookmarks.size()) {
    document_.removeBookmark(index);
  }
}

// Nodes stay selected together, and in the mirror image that was clicked, as long as all of them keep their indices.
std::optional<SettingsStep> SceneEditor::step(UndoWay way) {
  release();
  if (document_.changesScene(way)) {
    beforeChange_();
    clicked_.reset();
  }
  const uint64_t structure = document_.structureRevision();
  const Selection first = document_.selection();
  const std::optional<SettingsStep> settings = way == UndoWay::back ? document_.undo() : document_.redo();
  if (document_.structureRevision() != structure || !sameNode(document_.selection(), first)) {
    others_.clear();
    forgetPath();
  }
  return settings;
}

std::filesystem::path SceneEditor::modelFile(const std::filesystem::path& model) const {
  if (std::ranges::find(models_, model) != models_.end()) {
    return model;
  }
  const std::filesystem::path file = (document_.scene().file.parent_path() / typedPath(model)).lexically_normal();
  if (!isFile(file)) {
    throw InputError(oneLine(file.string() + ": there is no such file (name a " + modelFormatNames() + " file)"));
  }
  return file;
}

void SceneEditor::modelsChanged() {
  models_.clear();
  for (const Mesh& mesh : document_.scene().meshes) {
    if (std::ranges::find(models_, mesh.source) == models_.end()) {  // a model may be several meshes
      models_.push_back(mesh.source);
    }
  }
  const std::vector<std::filesystem::path> own = models_;
  std::error_code none;
  std::ranges::copy_if(shipped_, std::back_inserter(models_), [&](const std::filesystem::path& file) {
    return std::ranges::none_of(
        own, [&](const std::filesystem::path& model) { return std::filesystem::equivalent(model, file, none); });
  });
  picker_.reset();
  outlines_.clear();
}

void SceneEditor::fill(ShownEdit& view) const {
  view.scene = &document_.scene();
  view.selected = document_.selection();
  view.others = others_;
  view.through = path_;
  view.mode = mode_;
  view.models = models_;
  view.undo = document_.undoLabel();
  view.redo = document_.redoLabel();
}

const MeshOutline& SceneEditor::meshOutline(const Selection& node) {
  static const MeshOutline none;
  if (node.kind != Selection::Kind::object) {
    return none;
  }
  const Scene& scene = document_.scene();
  const int mesh = scene.objects.at(static_cast<size_t>(node.index)).mesh;
  const auto known = outlines_.find(mesh);
  return known != outlines_.end()
             ? known->second
             : outlines_.emplace(mesh, speculum::meshOutline(scene.meshes.at(static_cast<size_t>(mesh)))).first->second;
}

ShownOverlay SceneEditor::overlay(const PointedScene& view, const std::optional<glm::dvec2>& pointer) {
  const Scene& scene = document_.scene();
  Selection selected = document_.selection();
  if (selected.kind == Selection::Kind::object && !instanceOf(view.state, selected)) {
    selected.copy = 0;  // the object has fewer copies now
    document_.select(selected);
  }
  ShownOverlay overlay;
  const MeshOutline& shape = meshOutline(selected);
  const PictureView image = clickedImage(view);
  overlay.outline = outlineOf(scene, view.state, selected, image, shape);
  if (!image.path().empty()) {
    overlay.itself = outlineOf(scene, view.state, selected, view.picture, shape);
  }
  for (const Selection& other : others_) {
    const std::vector<PixelLine> lines = outlineOf(scene, view.state, other, view.picture, meshOutline(other));
    overlay.outline.insert(overlay.outline.end(), lines.begin(), lines.end());
  }
  const Gizmo handles = gizmo(view);
  overlay.gizmo = handles.shapes(image);
  if (drag_) {
    overlay.active = drag_->handle();
    overlay.label = drag_->label();
    overlay.labelAt = drag_->pixel();
  } else if (pointer) {
    overlay.active = handles.at(image, *pointer, handleReach * view.scale);
  }
  return overlay;
}

constexpr double clickReach = 4.0;  // screen coordinates that the pointer may move by between press and release

void PointerController::cancel() {
  pressed_.reset();
  dragging_ = false;
}

bool PointerController::button(const MouseButtonEvent& event, bool overPanels, SceneEditor& editor,
                               const std::optional<PointedScene>& view) {
  // Ignores another button while one is held.
  if (pressed_ ? event.button != button_ : !event.pressed) {
    return false;
  }
  const bool left = event.button == MouseButton::left;
  if (event.pressed) {
    holdsHandle_ = holdsHandle_ && editor.dragging();
    if (!overPanels && !editor.dragging()) {
      pressed_ = position_;
      button_ = event.button;
      shift_ = event.shift;
      holdsHandle_ = left && view && editor.press(*view, pixel_);
    }
    return false;
  }
  bool clicked = false;
  if (left && editor.dragging() && dragging_) {
    editor.release();
  } else if (left && pressed_ && !dragging_ && view) {
    editor.cancelDrag();
    shift_ ? editor.clickAlso(*view, pixel_) : editor.click(*view, pixel_);
    clicked = true;
  }
  cancel();
  return clicked;
}

void PointerController::move(const glm::dvec2& position, const glm::dvec2& pixelsPerUnit, double height, bool snap,
                             SceneEditor& editor, CameraController& camera) {
  const glm::dvec2 by = position - (pressed_ && !dragging_ ? *pressed_ : position_);
  position_ = position;
  pixel_ = position * pixelsPerUnit;
  dragging_ = dragging_ || (pressed_ && glm::distance(*pressed_, position) > clickReach);
  if (!dragging_) {
    return;
  }
  if (holdsHandle_) {
    editor.drag(pixel_, snap);
  } else if (button_ == MouseButton::left) {
    camera.drag(by.x, by.y);
  } else {
    camera.pan(by.x, by.y, height);
  }
}

}  // namespace speculum
