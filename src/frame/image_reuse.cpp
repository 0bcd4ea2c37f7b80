#include "frame/image_reuse.hpp"

#include <algorithm>

namespace speculum {

namespace {

bool serves(const HeldImage& image, const HeldRequest& request) {
  return sameMirrorImages(image.settings, request.settings) && image.view.pictureSize == request.view.pictureSize &&
         (unmoved(image, request.view, request.projection, request.visible) ||
          covers(image, request.view, request.visible));
}

// Pixels on each side that an image needs to serve until it is due, if things go on moving as they did since `image`.
int marginFor(const HeldImage& image, const HeldRequest& request, int due) {
  constexpr double reserve = 1.25;  // motion is not quite even
  constexpr double least = 2.0;     // pixels
  if (image.view.pictureSize != request.view.pictureSize) {
    return 0;
  }
  const double most = largestMargin * request.view.pictureSize.y;
  const double perFrame = largestShift(image, request.view, request.projection, request.visible) / image.age;
  // A cut, or too fast for the next frame already: a margin would be lost.
  if (due == 1 || perFrame == 0.0 || !(perFrame < most)) {
    return 0;
  }
  return static_cast<int>(std::min(most, reserve * perFrame * (due - 1) + least));
}

auto imageOf(std::span<const HeldImage> images, int mirror) {
  return std::find_if(images.begin(), images.end(), [&](const HeldImage& image) { return image.mirror == mirror; });
}

// debug.* is no part of sameMirrorImages, but what is the same bit for bit was drawn the same way.
bool sameDrawing(const Settings& a, const Settings& b) {
  return sameMirrorImages(a, b) && a.debug == b.debug;
}

// Whether a map of the frame before serves; the map is then that one.
bool keepMap(EnvironmentMap& map, std::span<const EnvironmentMap> maps, const ImageSurroundings& around,
             const View& main) {
  const int interval = around.settings.effects.environmentInterval;
  const bool skipUnchanged = around.settings.reflection.skipUnchanged;
  if (skipUnchanged) {
    std::vector<const PlannedPass*> faces;
    for (const PlannedPass& face : map.faces) {
      faces.push_back(&face);
    }
    map.content = imageContent(around, main, faces);
  }
  const auto before = std::find_if(maps.begin(), maps.end(), [&](const EnvironmentMap& other) {
    return other.object == map.object && other.copy == map.copy;
  });
  if (before == maps.end()) {
    map.due = interval - map.instance % interval;  // they take turns
    return false;
  }
  map.due = interval;
  const bool unchanged = skipUnchanged && before->content == map.content;
  const bool young = before->age < std::min(before->due, interval);
  if (!sameDrawing(before->settings, around.settings) || !(unchanged || young)) {
    return false;
  }
  map.earlier = static_cast<int>(before - maps.begin());
  map.serial = before->serial;
  map.center = before->center;
  if (!unchanged) {
    map.content = before->content;
    map.age = before->age + 1;
    map.due = before->due;
  }
  return true;
}

}  // namespace

HeldChoice chooseHeld(std::span<const HeldImage> images, const HeldRequest& request) {
  const auto before = imageOf(images, request.view.path.back());
  const bool exists = before != images.end();
  const int left = exists ? std::min(before->due, request.interval) - before->age : 0;  // frames
  if (left > 0 && serves(*before, request)) {
    HeldChoice kept{.image = *before};
    ++kept.image.age;
    kept.image.pass = -1;
    kept.image.earlier = static_cast<int>(before - images.begin());
    kept.moved = !unmoved(*before, request.view, request.projection, request.visible);
    return kept;
  }
  // New images, such as all of the first frame, take turns from then on; what is rendered out of turn keeps its own.
  const int due = left > 0 ? left : exists ? request.interval : request.interval - request.order % request.interval;
  HeldChoice fresh{.image = {.mirror = request.view.path.back(),
                             .view = request.view,
                             .projection = request.projection,
                             .visible = {request.visible.begin(), request.visible.end()},
                             .settings = request.settings,
                             .due = due}};
  if (const int pixels = exists ? marginFor(*before, request, due) : 0; pixels > 0) {
    widen(fresh.image.view, request.projection, pixels);
  }
  return fresh;
}

void keepIfUnchanged(HeldImage& image, std::span<const HeldImage> images, const ImageSurroundings& around,
                     const View& main, std::span<const PlannedPass* const> passes) {
  image.content = imageContent(around, main, passes);
  const auto before = imageOf(images, image.mirror);
  if (before != images.end() && before->content == image.content && sameDrawing(before->settings, around.settings)) {
    image.kept = before->kept + before->age;
    image.earlier = static_cast<int>(before - images.begin());
  }
}

void keepMaps(std::vector<EnvironmentMap>& maps, std::span<const EnvironmentMap> before,
              const ImageSurroundings& around, const View& main) {
  int serial = 0;
  for (const EnvironmentMap& map : before) {
    serial = std::max(serial, map.serial);
  }
  for (EnvironmentMap& map : maps) {
    if (!keepMap(map, before, around, main)) {
      map.serial = ++serial;
    }
  }
}

void keepMain(FramePlan& plan, const MainImage* before, const ImageSurroundings& around) {
  const bool renders = !plan.passes.empty() || std::any_of(plan.maps.begin(), plan.maps.end(),
                                                           [](const EnvironmentMap& map) { return map.earlier < 0; });
  const bool reprojects = std::any_of(plan.main.mirrors.begin(), plan.main.mirrors.end(),
                                      [](const MirrorDraw& draw) { return draw.held && draw.held->moved; });
  if (renders || reprojects) {
    return;
  }
  const PlannedPass* main = &plan.main;
  plan.mainContent = imageContent(around, plan.main.view, {&main, 1});
  plan.mainUnchanged = before && before->content == plan.mainContent && sameMainView(before->settings, around.settings);
}

}  // namespace speculum
