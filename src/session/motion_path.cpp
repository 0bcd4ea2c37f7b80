#include "session/motion_path.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>

#include "scene/input_error.hpp"
#include "scene/scene_loader.hpp"
#include "scene/table_reader.hpp"
#include "scene/toml_file.hpp"

namespace speculum {

namespace {

constexpr int usualFrames = 24;
constexpr int64_t mostPixels = int64_t{1} << 25;  // of all frames: half a gigabyte of references
constexpr size_t mostViews = 10'000;

struct TimedView {
  double time = 0.0;  // seconds after the first frame
  CameraSpec camera;
  int line = 0;  // in its file
};

void requireCamera(const CameraSpec& camera, const std::filesystem::path& file, int line, const std::string& where) {
  if (const std::optional<std::string> problem = cameraProblem(camera)) {
    throw InputError(fmt::format("{}:{}: {}{}", file.string(), line, where, *problem));
  }
}

std::vector<TimedView> readViews(const std::filesystem::path& file, const CameraSpec& usual) {
  static constexpr std::array<std::string_view, 1> keys{"view"};
  static constexpr std::array<std::string_view, 5> viewKeys{"time", "position", "target", "up", "vertical_fov"};
  const toml::table root = readToml(file, "camera path");
  const TableReader reader(file, "", root, 1, keys);
  std::vector<TimedView> views;
  for (const TableReader& table : reader.tables("view", viewKeys)) {
    TimedView view{.time = table.number("time", timeRange), .camera = usual, .line = table.line()};
    view.camera.position = table.vec3("position", coordinateRange);
    view.camera.target = table.vec3("target", coordinateRange);
    view.camera.up = table.has("up") ? table.vec3("up", coordinateRange) : usual.up;
    view.camera.verticalFov = table.number("vertical_fov", usual.verticalFov, fieldOfViewRange);
    requireCamera(view.camera, file, view.line, "view: ");
    if (!views.empty() && view.time <= views.back().time) {
      table.fail("time", "is not after the time of the view before", "ascending seconds are needed");
    }
    views.push_back(view);
  }
  if (views.size() < 2 || views.size() > mostViews) {
    throwInputError(file, 1, "view", fmt::format("stands {} times", views.size()),
                    fmt::format("2 to {} [[view]] with time, position and target are needed", mostViews));
  }
  return views;
}

// Returns the view at a time, straight between two views; before the first and after the last it stands still. Its line
// is that of the view before.
TimedView viewAt(const std::vector<TimedView>& views, double time) {
  const auto next = std::ranges::upper_bound(views, time, {}, &TimedView::time);
  if (next == views.begin() || next == views.end()) {
    return next == views.begin() ? views.front() : views.back();
  }
  TimedView view = *(next - 1);
  const double share = (time - view.time) / (next->time - view.time);
  CameraSpec& camera = view.camera;
  camera.position = glm::mix(camera.position, next->camera.position, share);
  camera.target = glm::mix(camera.target, next->camera.target, share);
  camera.up = glm::mix(camera.up, next->camera.up, share);
  camera.verticalFov = glm::mix(camera.verticalFov, next->camera.verticalFov, share);
  return view;
}

}  // namespace

MotionPath motionPath(const Options& options, const Scene& scene) {
  MotionPath path{.start = options.time, .fps = options.fps};
  path.frames = options.frames > 0 ? options.frames : usualFrames;
  const int64_t most = mostPixels / (int64_t{options.size.width} * options.size.height);
  if (path.frames > most) {
    throw UsageError(fmt::format("--frames: {} of {}x{} are too many (at most {} of this size)", path.frames,
                                 options.size.width, options.size.height, most));
  }
  if (!timeRange.contains(path.timeOf(path.frames - 1))) {
    throw UsageError(
        fmt::format("--fps: the last frame's time is out of range ({}; an earlier --time, or more frames per "
                    "second, such as 30)",
                    timeRange.shortText()));
  }
  if (options.motion == "scene") {
    if (!moves(scene)) {
      throw UsageError("--motion: nothing in the scene moves (a file of a camera path is needed)");
    }
    return path;
  }
  CameraSpec usual = scene.camera;
  usual.orbitSpeed = 0.0;
  const std::vector<TimedView> views = readViews(options.motion, usual);
  for (int frame = 0; frame < path.frames; ++frame) {
    const double time = frame / path.fps;
    const TimedView view = viewAt(views, time);
    const CameraSpec& camera = view.camera;
    requireCamera(camera, options.motion, view.line, fmt::format("after {} s, between two views, ", time));
    path.cameras.push_back(lookAt(camera.position, camera.target, camera.up, camera.verticalFov, camera.near));
  }
  return path;
}

SceneState stateOf(const Scene& scene, const MotionPath& path, int frame) {
  SceneState state = evaluate(scene, path.timeOf(frame));
  if (!path.cameras.empty()) {
    state.camera = path.cameras[frame];
  }
  return state;
}

}  // namespace speculum
