// Where the camera goes at a key or a click: to the scene, to mirrors, to bookmarks.
#include <algorithm>

#include "app/demo.hpp"

namespace speculum {

double Demo::aspect() const {
  const VkExtent2D extent = renderer_.displayExtent();
  return extent.height > 0 ? static_cast<double>(extent.width) / extent.height : 1.0;
}

// The selected one; else the one that fills most of the picture; the one before if none shows its front.
int Demo::mirrorOfInterest() const {
  const Selection& selection = editor_->document().selection();
  if (selection.kind == Selection::Kind::mirror) {
    return selection.index;
  }
  int mirror = lookedFrom_;
  double area = 0.0;
  for (const UiPass& pass : model_.passes) {
    if (pass.path.size() == 1 && pass.areaPx > area) {
      mirror = pass.path[0];
      area = pass.areaPx;
    }
  }
  // One that is there no more may have been the last.
  const int count = static_cast<int>(loaded_->scene.mirrors.size());
  return mirror >= 0 && mirror < count ? mirror : count > 0 ? 0 : -1;
}

void Demo::lookFromMirror(CameraController::MirrorSide side) {
  lookedFrom_ = mirrorOfInterest();
  if (lookedFrom_ >= 0) {
    camera_.lookFrom(evaluate(loaded_->scene, time_).mirrors[lookedFrom_], side, aspect());
  }
}

void Demo::frameScene() {
  const Sphere bounds = boundsOf(loaded_->scene, evaluate(loaded_->scene, time_), editor_->document().selection());
  if (bounds.radius > 0.0) {
    camera_.frame(bounds, aspect());
  }
}

void Demo::goToBookmark(int index) {
  const Bookmark& bookmark = loaded_->scene.bookmarks[static_cast<size_t>(index)];
  model_.bookmark = index;
  camera_.stand(cameraOf(bookmark, loaded_->scene.camera));
}

void Demo::bookmarkView() {
  const CameraPose pose = camera();
  const glm::dvec3 ahead = pose.eye - glm::dvec3(glm::transpose(pose.worldToView)[2]);
  const auto place = camera_.place();
  editor_->bookmark({.name = "view", .position = pose.eye, .target = place ? place->target : ahead});
  model_.bookmark = static_cast<int>(loaded_->scene.bookmarks.size()) - 1;
  listBookmarks();
}

void Demo::nextBookmark() {
  const int count = static_cast<int>(loaded_->scene.bookmarks.size());
  if (count > 0) {
    goToBookmark((model_.bookmark + 1) % count);
  }
}

void Demo::applyBookmarks() {
  const std::vector<Bookmark>& bookmarks = loaded_->scene.bookmarks;
  if (model_.bookmarkView) {
    bookmarkView();
  }
  if (model_.goToBookmark && *model_.goToBookmark < static_cast<int>(bookmarks.size())) {
    goToBookmark(*model_.goToBookmark);
  }
  if (model_.removeBookmark && model_.bookmark >= 0 && model_.bookmark < static_cast<int>(bookmarks.size())) {
    editor_->removeBookmark(static_cast<size_t>(model_.bookmark));
  }
  listBookmarks();
}

// A key may come between two looks of the panel at the list.
void Demo::listBookmarks() {
  model_.bookmarks.clear();
  for (const Bookmark& bookmark : loaded_->scene.bookmarks) {
    model_.bookmarks.push_back(bookmark.name);
  }
  model_.bookmark = std::min(model_.bookmark, static_cast<int>(model_.bookmarks.size()) - 1);
}

}  // namespace speculum
