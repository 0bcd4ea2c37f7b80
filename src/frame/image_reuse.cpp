#include "frame/image_reuse.hpp"

#include <algorithm>

#include "frame/shadow_map.hpp"

namespace speculum {

namespace {

bool canReuse(const CachedImage& image, const ReuseRequest& request) {
  return sameMirrorImages(image.settings, request.settings) && image.samples == request.samples &&
         image.view.pictureSize == request.view.pictureSize &&
         (unmoved(image, request.view, request.projection, request.visible) ||
          covers(image, request.view, request.visible));
}

// Returns the margin, in pixels on each side, that a new image needs to serve until it is due, if the motion since
// `image` goes on.
int marginFor(const CachedImage& image, const ReuseRequest& request, int due) {
  constexpr double reserve = 1.25;  // motion is not quite even
  constexpr double least = 2.0;     // pixels
  if (image.view.pictureSize != request.view.pictureSize) {
    return 0;
  }
  const double most = largestMargin * request.view.pictureSize.y;
  const double perFrame = largestShift(image, request.view, request.projection, request.visible) / image.age;
  // After a cut, or in motion too fast for even the next frame, a margin would be wasted.
  if (due == 1 || perFrame == 0.0 || !(perFrame < most)) {
    return 0;
  }
  return static_cast<int>(std::min(most, reserve * perFrame * (due - 1) + least));
}

auto imageOf(std::span<const CachedImage> images, int mirror) {
  return std::ranges::find(images, mirror, &CachedImage::mirror);
}

// Says whether settings draw the same image bit for bit. debug.* counts too, which sameMirrorImages leaves out.
bool sameDrawing(const Settings& a, const Settings& b) {
  return sameMirrorImages(a, b) && a.debug == b.debug;
}

// Says whether settings make the same environment maps. reflection.* has no part in that: mirrors in maps show the
// background, and the content of a map lists its mesh levels.
bool sameMaps(const Settings& a, Settings b) {
  b.reflection = a.reflection;
  b.view.scale = a.view.scale;
  return sameDrawing(a, b);
}

// Replaces a map by that of the frame before if it can be reused, and says whether it did.
bool reuseMap(EnvironmentMap& map, std::span<const EnvironmentMap> maps, const ImageSurroundings& around,
              const View& main) {
  const int interval = around.settings.effects.environmentInterval;
  if (around.changes) {
    RecycledVector<const PlannedPass*> faces;
    for (const PlannedPass& face : map.faces) {
      faces.push_back(&face);
    }
    map.content = imageContent(around, main, faces);
  }
  const auto before = std::ranges::find_if(
      maps, [&](const EnvironmentMap& other) { return other.object == map.object && other.copy == map.copy; });
  if (before == maps.end() || !sameMaps(before->settings, around.settings)) {
    map.due = interval - map.instance % interval;  // so that maps become due in turn
    return false;
  }
  map.due = interval;
  const bool unchanged = around.changes && before->content == map.content;
  const bool young = before->age < std::min(before->due, interval);
  if (!unchanged && !young) {
    return false;
  }
  map.cacheIndex = static_cast<int>(before - maps.begin());
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

ImageChoice chooseImage(std::span<const CachedImage> images, const ReuseRequest& request) {
  const auto before = imageOf(images, request.view.path.back());
  const bool exists = before != images.end();
  const int left = exists ? std::min(before->due, request.interval) - before->age : 0;  // frames
  if (left > 0 && canReuse(*before, request)) {
    ImageChoice cached{.image = *before};
    ++cached.image.age;
    cached.image.pass = -1;
    cached.image.cacheIndex = static_cast<int>(before - images.begin());
    cached.moved = !unmoved(*before, request.view, request.projection, request.visible);
    return cached;
  }
  // New images, such as all of the first frame, become due in different frames. An image that is rendered before it is
  // due keeps its turn.
  const int due = left > 0 ? left : exists ? request.interval : request.interval - request.order % request.interval;
  ImageChoice fresh{.image = {.mirror = request.view.path.back(),
                              .view = request.view,
                              .projection = request.projection,
                              .visible = {request.visible.begin(), request.visible.end()},
                              .settings = request.settings,
                              .samples = request.samples,
                              .due = due}};
  if (const int pixels = exists ? marginFor(*before, request, due) : 0; pixels > 0) {
    widen(fresh.image.view, request.projection, pixels);
  }
  return fresh;
}

void reuseIfUnchanged(CachedImage& image, std::span<const CachedImage> images, const ImageSurroundings& around,
                      const View& main, std::span<const PlannedPass* const> passes) {
  image.content = imageContent(around, main, passes);
  const auto before = imageOf(images, image.mirror);
  if (before != images.end() && before->content == image.content && sameDrawing(before->settings, around.settings)) {
    constexpr int mostFrames = 1'000'000'000;  // that are counted: days without a change
    image.unchangedFor = std::min(before->unchangedFor + before->age, mostFrames);
    image.cacheIndex = static_cast<int>(before - images.begin());
  }
}

void reuseMaps(RecycledVector<EnvironmentMap>& maps, std::span<const EnvironmentMap> before,
               const ImageSurroundings& around, const View& main) {
  uint64_t serial = 0;
  for (const EnvironmentMap& map : before) {
    serial = std::max(serial, map.serial);
  }
  for (EnvironmentMap& map : maps) {
    if (!reuseMap(map, before, around, main)) {
      map.serial = ++serial;
    }
  }
}

void reuseMain(FramePlan& plan, const MainImage* before, const ImageSurroundings& around) {
  const bool renders = !plan.passes.empty() || rendersShadows(plan.shadowMaps) ||
                       std::ranges::any_of(plan.maps, [](const EnvironmentMap& map) { return map.cacheIndex < 0; });
  const bool reprojects =
      std::ranges::any_of(plan.main.mirrors, [](const MirrorDraw& draw) { return draw.cached && draw.cached->moved; });
  if (renders || reprojects) {
    return;
  }
  const PlannedPass* main = &plan.main;
  plan.mainContent = imageContent(around, plan.main.view, {&main, 1});
  plan.mainReused = before && before->content == plan.mainContent && sameMainView(before->settings, around.settings);
}

}  // namespace speculum
