#include "session/session_subject.hpp"

#include <spdlog/fmt/chrono.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <ctime>

#include "plan/traced_effects.hpp"
#include "platform/files.hpp"
#include "platform/process.hpp"
#include "scene/fingerprint.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_loader.hpp"
#include "scene/table_reader.hpp"
#include "scene/toml_file.hpp"
#include "session/frame_cost.hpp"
#include "session/version.hpp"
#include "settings/setting_fields.hpp"

namespace speculum {

namespace {

namespace fs = std::filesystem;

void addFile(Fingerprint& fingerprint, const fs::path& file) {
  if (const std::optional<std::vector<uint8_t>> bytes = readFileIfAny(file)) {
    fingerprint.add(std::as_bytes(std::span(*bytes)));
  }
}

void addFolder(Fingerprint& fingerprint, const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    addFile(fingerprint, file);
  }
}

// Returns a text that describes the work for the session's last frame.
std::string workOf(Session& session) {
  const DrawnFrame& frame = session.lastFrame();
  FrameWork work = workOf(frame.plan, session.scene(), frame.state, frame.settings);
  work.mirrorSamples *= work.mirrorPasses > 0.0;
  Fingerprint fingerprint;
  fingerprint.add(std::as_bytes(std::span(&work, 1)));
  fingerprint.add(frame.pictures);
  return fingerprint.hex();
}

void addTo(FrameCost& cost, const DrawnFrame& frame, double share) {
  cost.gpuMs += share * frame.gpuMs;
  cost.cpuMs += share * frame.cpuMs;
  cost.frameMs += share * frame.frameMs;
}

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

void SessionSubject::drawFrame(int frame, bool capture, bool whole) {
  if (!path_.cameras.empty()) {
    session_.setCamera(path_.cameras[std::max(0, frame)]);
  }
  session_.draw(path_.timeOf(frame), capture, [&] { return whole; });
  session_.finish();
}

void SessionSubject::follow(const Settings& settings, bool capture, const std::function<void()>& drawn) {
  session_.setSettings(settings);
  session_.restart();
  const int interval = mostAsked(session_.scene(), settings).updateInterval;
  // Without pictures, one frame before the first makes the targets and maps that later frames use.
  const int before = interval > 1 ? interval : capture ? 0 : 1;
  for (int frame = -before; frame < path_.frames; ++frame) {
    drawFrame(frame, capture && frame >= 0, true);
    if (interruptRequested()) {
      throw SweepCancelled();
    }
    if (drawn && frame >= 0) {
      drawn();
    }
  }
}

std::vector<Image8> SessionSubject::pictures(const Settings& settings) {
  if (path_.frames == 1) {
    std::vector<Image8> pictures = stillPictures(settings);
    work_ = workOf(session_);
    return pictures;
  }
  std::vector<Image8> pictures;
  Fingerprint work;
  follow(settings, true, [&] {
    pictures.push_back(session_.picture());
    work.add(workOf(session_));
  });
  work_ = work.hex();
  return pictures;
}

std::vector<Image8> SessionSubject::stillPictures(const Settings& settings) {
  session_.setSettings(settings);
  const int interval = mostAsked(session_.scene(), settings).updateInterval;
  std::vector<Image8> pictures;
  // After one interval mirrors become due in turn, so n frames in a row show each mirror at every age.
  for (int last = interval > 1 ? interval : 0; last < (interval > 1 ? 2 * interval : 1); ++last) {
    session_.restart();
    for (int frame = 0; frame <= last; ++frame) {
      drawFrame(frame - last, frame == last, true);
    }
    pictures.push_back(session_.picture());
  }
  return pictures;
}

FrameCost SessionSubject::cost(const Settings& settings) {
  session_.renderer().setTimerDetail(TimerDetail::frame);
  FrameCost cost;
  if (path_.frames > 1) {
    follow(settings, false, [&] { addTo(cost, session_.lastFrame(), 1.0 / path_.frames); });
    return cost;
  }
  Settings measured = settings;
  measured.reflection.skipUnchanged = false;
  session_.setSettings(measured);
  session_.restart();
  const int counted = mostAsked(session_.scene(), settings).updateInterval;
  for (int frame = 2 * counted - 1; frame >= 0; --frame) {
    const bool counts = frame < counted;
    drawFrame(counted == 1 ? 0 : -frame, false, counts);
    if (counts) {
      addTo(cost, session_.lastFrame(), 1.0 / counted);
    }
  }
  return cost;
}

std::vector<int> sampleCountsOf(const Device& device) {
  std::vector<int> counts;
  for (const int count : {1, 2, 4, 8}) {
    if ((device.caps().sampleCounts & static_cast<VkSampleCountFlags>(count)) != 0) {
      counts.push_back(count);
    }
  }
  return counts;
}

std::string utcNow() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

SweepContext sweepContext(Session& session) {
  const AskedEffects asked = askedEffects(session.scene());
  SweepContext context{.base = session.settings(),
                       .sampleCounts = sampleCountsOf(session.device()),
                       .mirrors = session.scene().mirrorCount() > 0,
                       .animated = moves(session.scene()),
                       .rough = asked.rough,
                       .interval = mostAsked(session.scene(), session.settings()).updateInterval};
  for (const auto& [key, wanted] :
       {std::pair("effects.shadows", asked.shadows), std::pair("effects.roughness", asked.rough),
        std::pair("effects.ripple", asked.ripple), std::pair("effects.casts_light", asked.castsLight),
        std::pair("effects.curved", asked.curved),
        std::pair("effects.transparency", std::ranges::any_of(session.scene().meshes, &Mesh::isTransparent))}) {
    if (wanted) {
      context.effects.emplace_back(key);
    }
  }
  return context;
}

// The text changes with build, shaders, driver and what is measured, so that old figures are not reused.
std::string sweepIdentity(Session& session, const Options& options) {
  Fingerprint fingerprint;
  addFile(fingerprint, executablePath());
  addFolder(fingerprint, dataDirectory("shaders"));
  if (!options.shaderDir.empty()) {
    addFolder(fingerprint, options.shaderDir);
  }
  fingerprint.add(options.validation);
  addScene(fingerprint, session.scene());
  const Device& device = session.device();
  for (const std::string& text : {device.info().name, device.info().driver, machineDescription(),
                                  std::string(renderPathName(device.renderPath()))}) {
    fingerprint.add(text);
  }
  fingerprint.add(session.size().width);
  fingerprint.add(session.size().height);
  fingerprint.add(options.time);
  if (!options.motion.empty()) {
    fingerprint.add(options.motion);
    addFile(fingerprint, options.motion);
    fingerprint.add(options.frames);
    fingerprint.add(options.fps);
  }
  return fingerprint.hex();
}

SweepResults describeSweep(Session& session, const SweepPlan& plan, double time) {
  const Device& device = session.device();
  SweepResults results{.scene = session.scene().file.filename().string(),
                       .title = session.scene().title,
                       .sweep = plan.name,
                       .time = time,
                       .device = device.info().name,
                       .driver = device.info().driver,
                       .renderPath = std::string(renderPathName(device.renderPath())),
                       .machine = machineDescription(),
                       .version = versionString,
                       .date = utcNow()};
  for (const SettingField& field : settingFields()) {
    const std::string value = settingValue(session.settings(), field.key);
    if (!value.empty()) {
      results.base.push_back({std::string(field.key), value});
    }
  }
  return results;
}

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
