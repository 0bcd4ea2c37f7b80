#include "session/session.hpp"

#include <spdlog/fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <map>

#include "accuracy/sweep_json.hpp"
#include "platform/process.hpp"
#include "platform/text.hpp"
#include "scene/input_error.hpp"
#include "session/output_files.hpp"
#include "settings/setting_fields.hpp"

namespace speculum {

namespace {

using Clock = std::chrono::steady_clock;

// Says whether a sweep measures the setting. The others choose what is shown, or change no radiance.
bool isQuality(const std::string& key) {
  const SettingField* field = findSettingField(key);
  return !field || (field->changes < FramePart::display && !field->subject && !key.starts_with("debug."));
}

void warnOfDifferences(const SweepResults& results, const Options& options, const std::filesystem::path& scene) {
  if (results.scene != scene.filename()) {
    spdlog::warn("the sweep is of {}: its figures need not hold for {}", results.scene, scene.filename().string());
  }
  if (results.width != options.size.width || results.height != options.size.height) {
    spdlog::warn("the sweep is of {}x{} pixels: its milliseconds are not those of {}x{}", results.width, results.height,
                 options.size.width, options.size.height);
  }
}

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

const Bookmark& bookmarkOf(const Options& options, const Scene& scene) {
  const std::string& name = options.bookmark;
  std::vector<std::string_view> names;
  for (const Bookmark& bookmark : scene.bookmarks) {
    if (bookmark.name == name) {
      return bookmark;
    }
    names.push_back(bookmark.name);
  }
  throw UsageError(oneLine(
      options.cameraPlace + ": the scene has no bookmark '" + name + "' (" +
      (names.empty() ? "it has none; position:target, such as 0,1,4:0,1,0, is needed" : nearestKeyAdvice(name, names)) +
      ")"));
}

// Chooses a point from the file of --sweep-results by quality.budget_ms and quality.max_error, sets `settings` to it,
// except for keys of --set, and prints the choice on stderr. Warns if the sweep is of another scene or size. Returns
// nothing without bounds, or without a sweep after a warning. Throws UsageError for bounds of --set without a sweep
// (the command demo only warns), InputError for a file that is not a sweep's.
std::optional<QualityChoice> chooseQuality(const Options& options, const std::filesystem::path& scene,
                                           Settings& settings) {
  if (!budgetOf(settings).bounds()) {
    if (!options.sweepResults.empty() && options.command != "demo") {
      throw UsageError(
          "--sweep-results: chooses nothing without a bound (--set quality.budget_ms=MS or quality.max_error=FLIP)");
    }
    return std::nullopt;
  }
  std::set<std::string> kept;
  for (const auto& setting : options.settings) {
    kept.insert(setting.first);
  }
  if (options.sweepResults.empty()) {
    const bool byHand = kept.contains("quality.budget_ms") || kept.contains("quality.max_error");
    if (byHand && options.command != "demo") {
      throw UsageError(
          "quality.budget_ms and quality.max_error choose from a sweep "
          "(--sweep-results F, the results.json of speculum accuracy)");
    }
    const char* bounds = settings.quality.maxError <= 0.0   ? "GPU budget waits"
                         : settings.quality.budgetMs <= 0.0 ? "Max. mean FLIP waits"
                                                            : "GPU budget and Max. mean FLIP wait";
    spdlog::warn("{} for a measurement ({})", bounds,
                 options.command == "demo" ? "Accuracy > Measure this view"
                                           : "render and bench take --sweep-results F, the results.json of accuracy");
    return std::nullopt;
  }
  const SweepResults results = readStillSweep(options.sweepResults);
  const std::optional<BudgetChoice> choice = chooseForBudget(results, budgetOf(settings));
  if (!choice) {
    throw InputError(options.sweepResults.string() + ": points: none (a sweep with at least one point is needed)");
  }
  warnOfDifferences(results, options, scene);
  applyPoint(results, choice->point, kept, settings);
  printLine(fmt::format("quality: {} (measured on {}, {} at {}x{})", choice->why, results.device, results.scene,
                        results.width, results.height),
            stderr);
  return QualityChoice{results.points[choice->point], choice->met, choice->why};
}

}  // namespace

std::vector<SettingChange> settingsOfPoint(const SweepResults& results, int point) {
  std::map<std::string, std::string> values;
  for (const std::vector<SettingChange>& changes : {results.base, results.points[point].changes}) {
    for (const SettingChange& change : changes) {
      values[change.key] = change.value;
    }
  }
  std::vector<SettingChange> settings;
  for (const auto& [key, value] : values) {
    if (isQuality(key)) {
      settings.push_back({key, value});
    }
  }
  return settings;
}

bool isAtPoint(const Settings& settings, const std::vector<SettingChange>& point) {
  return std::ranges::all_of(
      point, [&](const SettingChange& change) { return settingValue(settings, change.key) == change.value; });
}

void applyPoint(const SweepResults& results, int point, const std::set<std::string>& kept, Settings& settings) {
  for (const SettingChange& change : settingsOfPoint(results, point)) {
    if (kept.contains(change.key)) {
      if (settingValue(settings, change.key) != change.value) {
        spdlog::warn("{} is set by hand: the sweep's figures do not hold for it", change.key);
      }
    } else if (const auto problem = setSetting(settings, change.key, change.value)) {
      throw InputError("--sweep-results: " + results.points[point].name + ": " + *problem);
    }
  }
}

SweepResults readStillSweep(const std::filesystem::path& file) {
  SweepResults results = readSweepResults(file);
  if (results.motion) {
    throw InputError(file.string() + ": motion: measured in motion (results of accuracy without --motion are needed)");
  }
  return results;
}

std::filesystem::path findScene(const std::string& wanted) {
  namespace fs = std::filesystem;
  const fs::path path = wanted.empty() ? "gallery.toml" : fs::path(wanted);
  // A folder with the scene's name, for example of its pictures, must not hide the scene. Loading says why a path
  // cannot be followed.
  std::error_code none;
  const fs::file_type type = fs::status(path, none).type();
  if (!wanted.empty() && type != fs::file_type::not_found && type != fs::file_type::directory) {
    return path;
  }
  if (const std::optional<fs::path> shipped = shippedScene(path)) {
    return *shipped;
  }
  const bool folder = type == fs::file_type::directory;
  const std::vector<std::string> shipped = shippedSceneNames();
  throw UsageError(fmt::format(
      "--scene: {}'{}'{} ({})", folder ? "" : "there is no file ", wanted, folder ? " is a folder" : "",
      nearestKeyAdvice(path.extension() == ".toml" ? fs::path(path).replace_extension().generic_string() : wanted,
                       std::vector<std::string_view>(shipped.begin(), shipped.end()),
                       "a scene file, a model, or a name from speculum scenes")));
}

Settings settingsOf(const Scene& scene, const Options& options) {
  Settings settings = settingsOf(scene);
  for (const auto& [key, value] : options.settings) {
    if (const auto problem = setSetting(settings, key, value)) {
      throw UsageError("--set: " + *problem);
    }
  }
  return settings;
}

LoadedScene loadSceneWithSettings(const Options& options) {
  LoadedScene loaded = loadSceneWithSettings(findScene(options.scene), options);
  // Loading a large model frees about as much memory as the scene takes. Small scenes leave the freed pages to what is
  // allocated next: giving them back and filling new ones takes longer than loading.
  size_t vertices = 0;
  for (const Mesh& mesh : loaded.scene.meshes) {
    vertices += mesh.vertices.size();
  }
  if (vertices > 100'000) {
    releaseFreedMemory();
  }
  requireFilesOfTheirOwn(options, loaded.scene);
  return loaded;
}

LoadedScene loadSceneWithSettings(const std::filesystem::path& file, const Options& options,
                                  const LoadProgress& progress) {
  LoadedScene loaded{.scene = loadScene(file, progress)};
  if (options.strict) {
    requireNoDefects(loaded.scene);
  }
  loaded.settings = settingsOf(loaded.scene, options);
  loaded.quality = chooseQuality(options, file, loaded.settings);
  return loaded;
}

void requireNoDefects(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    if (!mesh.defects.empty()) {
      throw InputError(mesh.defects[0] + " (strict: a model without defects is needed)");
    }
  }
}

std::optional<CameraPose> cameraOf(const Options& options, const Scene& scene) {
  if (options.bookmark.empty() && !options.camera) {
    return std::nullopt;
  }
  const CameraSpec camera = cameraOf(options.camera ? *options.camera : bookmarkOf(options, scene), scene.camera);
  try {
    return lookAt(camera.position, camera.target, camera.up, camera.verticalFov, camera.near);
  } catch (const std::invalid_argument& error) {
    throw UsageError(options.cameraPlace + ": " + error.what() + " (position:target:up, of which the three differ)");
  }
}

Image8 pictureOf(Pixels pixels) {
  Image8 image;
  image.width = static_cast<int>(pixels.extent.width);
  image.height = static_cast<int>(pixels.extent.height);
  image.rgba = std::move(pixels.rgba);
  for (size_t i = 3; i < image.rgba.size(); i += 4) {
    image.rgba[i] = 255;
  }
  return image;
}

DeviceOptions deviceOptions(const Options& options, Window* window) {
  return {.gpu = options.gpu, .validation = options.validation, .window = window, .renderPath = options.renderPath};
}

RendererOptions rendererOptions(const Options& options, Window* window) {
  return {.window = window,
          .extent = extentOf(options.size.width, options.size.height),
          .presentMode = options.window.presentMode,
          .shaderDir = options.shaderDir};
}

void applyDebugSettings(const Settings& settings, Device& device) {
  const std::string& name = settings.debug.omitBarrier;
  const std::optional<BarrierKind> kind = barrierFromName(name);
  if (!name.empty() && !kind) {
    std::vector<std::string_view> names;
    std::ranges::transform(allBarrierKinds(), std::back_inserter(names), barrierName);
    throw UsageError(fmt::format("debug.omit_barrier: there is no barrier '{}' ({})", name, fmt::join(names, ", ")));
  }
  device.barriers().omit(kind);
}

int exitCodeOfChecks(int validationMessages, uint64_t nonFinite) {
  if (validationMessages > 0) {
    printLine(fmt::format("{} validation messages", validationMessages), stderr);
  }
  if (nonFinite > 0) {
    printLine(fmt::format("{} samples of radiance that are not finite or not within 0 .. 65504", nonFinite), stderr);
  }
  return validationMessages > 0 || nonFinite > 0 ? 1 : 0;
}

Session::Session(const Options& options, Device* device)
    : size_(options.size),
      loaded_(loadSceneWithSettings(options)),
      camera_(cameraOf(options, loaded_.scene)),
      ownDevice_(device ? nullptr : std::make_unique<Device>(deviceOptions(options, nullptr))),
      device_(device ? *device : *ownDevice_),
      renderer_(device_, rendererOptions(options, nullptr)),
      sceneRenderer_(renderer_, loaded_.scene),
      planner_(device_) {
  applyDebugSettings(loaded_.settings, device_);
  const auto largest = static_cast<int>(device_.limits().maxImageDimension2D);
  for (const Texture& texture : loaded_.scene.textures) {
    if (options.strict && std::max(texture.width, texture.height) > largest) {
      throw InputError(oneLine(
          fmt::format("{}: has {}x{} texels, the device's largest side is {} (strict: a picture that fits is needed)",
                      texture.source.string(), texture.width, texture.height, largest)));
    }
  }
}

const DrawnFrame& Session::draw(double time, bool capture, const std::function<bool()>& afterPicture) {
  start_ = Clock::now();
  renderer_.reloadShaders();
  frame_ = {.state = evaluate(loaded_.scene, time)};
  frame_.state.camera = camera_.value_or(frame_.state.camera);
  unfinished_.clear();
  while (!frame_.complete) {
    drawPicture(capture);
    if (afterPicture && !afterPicture()) {
      break;
    }
  }
  return frame_;
}

void Session::drawPicture(bool capture) {
  Frame frame = renderer_.beginFrame().value();
  collectFinished();
  const Clock::time_point recording = Clock::now();
  FrameCache cache = sceneRenderer_.cache(frame_.state);
  frame.waitedMs += cache.waitedMs;
  const int all = loaded_.settings.view.accumulate;
  const bool converged = frame_.pictures > 0 && cache.refined && cache.refined->none();
  const int picture = converged ? all : frame_.pictures;  // `all` shows the mean again
  cache.main = nullptr;  // the main view is drawn in every frame, so that its pass is reported
  const FrameRequest asked{.scene = loaded_.scene,
                           .state = frame_.state,
                           .settings = loaded_.settings,
                           .size = {size_.width, size_.height},
                           .cache = cache,
                           .picture = picture,
                           .shownOnly = shownOnly_};
  FittedPlan fitted = planning_ ? planning_(asked, planner_) : planner_.plan(asked);
  frame_.planMs += millisecondsSince(recording) - frame.waitedMs;
  const bool last = picture + 1 >= all;
  frame_.plan = std::move(fitted.plan);
  frame_.settings = fitted.settings;
  frame.capture = capture && last;
  sceneRenderer_.record(frame, frame_.state, frame_.settings, frame_.plan, std::nullopt, last);
  frame_.cpuMs += millisecondsSince(recording) - frame.waitedMs;
  unfinished_.push_back(frame.number);
  renderer_.endFrame(frame);
  // After an error the last good shader stays in use. The window shows the error; a command would write a wrong picture
  // and exit with 0.
  if (const std::string& errors = renderer_.pipelines().errors(); !errors.empty()) {
    const size_t found = errors.find("ERROR:");
    const size_t begin = found == std::string::npos ? 0 : errors.rfind('\n', found) + 1;
    throw std::runtime_error("--shader-dir: " + errors.substr(begin, errors.find('\n', begin) - begin));
  }
  if (!frame_.plan.mainReused()) {  // else the ledger is still that of the picture before
    frame_.ledger.add(sceneRenderer_.ledger());
  }
  frame_.pictures += converged ? 0 : 1;
  frame_.complete = last;
}

void Session::collectFinished() {
  while (!unfinished_.empty()) {
    const FrameTimings* timings = renderer_.timingsOf(unfinished_.front());
    if (!timings) {
      return;
    }
    frame_.sums.beginPicture();
    frame_.sums.add(sceneRenderer_.passesOf(timings->frame), *timings);
    frame_.number = timings->frame;
    frame_.gpuMs += timings->gpuMs;
    unfinished_.pop_front();
  }
}

void Session::resize(PictureSize size) {
  size_ = size;
  renderer_.resizeHeadless(extentOf(size.width, size.height));
}

void Session::setSettings(const Settings& settings) {
  applyDebugSettings(settings, device_);
  loaded_.settings = settings;
}

void Session::finish() {
  renderer_.waitIdle();
  collectFinished();
  frame_.frameMs = millisecondsSince(start_);
}

}  // namespace speculum
