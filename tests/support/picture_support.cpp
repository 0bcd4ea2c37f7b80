#include "picture_support.hpp"

#include "driver.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"
#include "scene_text.hpp"
#include "studio.hpp"
#include "test_headers.hpp"
#include "test_paths.hpp"

namespace speculum::testing_support {

void writeEvidence(const Image8& actual, const Image8& expected, const std::string& name) {
  const std::filesystem::path directory = binaryDir() / "tests" / "failed";
  std::filesystem::create_directories(directory);
  writePng(directory / (name + "-actual.png"), actual);
  writePng(directory / (name + "-expected.png"), expected);
  writePng(directory / (name + "-difference.png"),
           differencePicture(actual, expected, difference(actual, expected, 2), 20.0));
  std::printf("see %s/%s-{actual,expected,difference}.png\n", directory.c_str(), name.c_str());
}

void expectAlike(const Image8& actual, const Image8& expected, int tolerance, const std::string& name,
                 const std::vector<bool>& counts) {
  const PictureAgreement d = difference(actual, expected, tolerance, counts);
  EXPECT_LE(d.share(), 0.001) << name << ": largest difference " << d.largest << "/255";
  EXPECT_FALSE(d.block) << name << ": wholly over " << tolerance << "/255 at " << d.block->x << ", " << d.block->y;
  if (!d.holds()) {
    writeEvidence(actual, expected, name);
  }
}

std::filesystem::path sourceFile(const std::string& relative) {
  return sourceDir() / relative;
}

std::filesystem::path sceneFile(const std::string& name) {
  return sourceFile("scenes/" + name + ".toml");
}

std::vector<std::string> sceneNames(const std::string& prefix) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(sourceFile("scenes/" + prefix))) {
    if (entry.path().extension() == ".toml") {
      names.push_back(prefix + entry.path().stem().string());
    }
  }
  std::ranges::sort(names);
  return names;
}

Options headless(const std::filesystem::path& scene, PictureSize size, const SettingList& settings) {
  keepDriverLoaded();
  Options options;
  options.scene = scene.string();
  options.size = size;
  options.validation = true;
  options.settings = {{"debug.check_finite", "true"}};
  // The same tests run with each way to trace rays.
  if (const char* rays = std::getenv("SPECULUM_RAYS")) {
    set(options, {{"effects.rays", rays}});
  }
  set(options, settings);
  return options;
}

void set(Options& options, const SettingList& settings) {
  options.settings.insert(options.settings.end(), settings.begin(), settings.end());
}

void set(Session& session, const SettingList& settings) {
  Settings changed = session.settings();
  for (const auto& [key, value] : settings) {
    EXPECT_EQ(setSetting(changed, key, value), std::nullopt);
  }
  session.setSettings(changed);
}

void runFrames(Session& session, int frames, double time) {
  for (int i = 0; i < frames; ++i) {
    session.draw(time, false);
    session.finish();
  }
}

void expectQuiet(Session& session) {
  session.finish();
  EXPECT_EQ(session.device().validationMessages(), 0) << session.scene().file;
  const FiniteWatch& watch = session.sceneRenderer().finiteWatch();
  EXPECT_EQ(watch.count(), 0u) << session.scene().file << ": " << describe(watch.findings().front());
}

Device& sharedDevice(RenderPath path) {
  static std::map<RenderPath, Device*> devices;
  Device*& device = devices[path];
  if (!device) {
    Options options = headless("");
    options.renderPath = path;
    device = new Device(deviceOptions(options, nullptr));
    device->sparePipelines().keepAtMost(512);
  }
  return *device;
}

namespace {

Device* deviceFor(const Options& options) {
  const bool leavesOutBarriers =
      std::ranges::any_of(options.settings, [](const auto& setting) { return setting.first == "debug.omit_barrier"; });
  return options.validation && options.gpu.empty() && !leavesOutBarriers ? &sharedDevice(options.renderPath) : nullptr;
}

}  // namespace

QuietSession::QuietSession(const Options& options, Device* device)
    : Session(options, device ? device : deviceFor(options)) {}

Image8 draw(const Options& options, double time) {
  if (options.validation && options.renderPath == RenderPath::automatic && options.shaderDir.empty()) {
    Studio studio(options);
    studio.time = time;
    return studio.draw();
  }
  QuietSession session(options);
  session.draw(time, true);
  return session.picture();
}

Image8 draw(Session& session, double time) {
  session.draw(time, true);
  session.finish();
  return session.picture();
}

LinearImage drawRadiance(Session& session, double time) {
  runFrames(session, 1, time);
  return session.radiance();
}

void recordFrame(Session& session, const SceneState& state, const Settings& settings, const FramePlan& plan,
                 const std::optional<TargetDisplay>& debug) {
  Frame frame = session.renderer().beginFrame().value();
  frame.capture = true;
  session.sceneRenderer().record(frame, state, settings, plan, debug);
  session.renderer().endFrame(frame);
}

double rootMeanSquare(const LinearImage& a, const LinearImage& b, const std::vector<bool>& counts) {
  double sum = 0.0;
  double count = 0.0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    if (counts.empty() || counts[i]) {
      const glm::dvec3 off = glm::dvec3(a.pixels[i]) - glm::dvec3(b.pixels[i]);
      sum += glm::dot(off, off);
      count += 1.0;
    }
  }
  return std::sqrt(sum / count);
}

std::vector<bool> blackPixels(const Image8& image) {
  std::vector<bool> mask;
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    mask.push_back(image.rgba[i] == 0 && image.rgba[i + 1] == 0 && image.rgba[i + 2] == 0);
  }
  return mask;
}

// Empties the folder at a test's first call, so that nothing is left of an earlier run. Its name is not `scenes`,
// because the programs beside it would take it for their own folder of scenes.
std::filesystem::path sceneDirectory() {
  static std::filesystem::path made;
  std::filesystem::path directory = binaryDir() / "tests" / "written";
  if (const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info()) {
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    std::ranges::replace(name, '/', '_');
    directory /= name;
    if (std::exchange(made, directory) != directory) {
      std::filesystem::remove_all(directory);
    }
  }
  std::filesystem::create_directories(directory);
  return directory;
}

std::filesystem::path writeScene(const std::string& name, const std::string& toml) {
  const std::filesystem::path file = sceneDirectory() / (name + ".toml");
  std::ofstream(file) << tomlOf(toml);
  return file;
}

void writeShaders(const std::filesystem::path& directory, const std::string& shader, const std::string& code) {
  std::map<std::string, std::string> sources;
  for (const auto& entry : std::filesystem::directory_iterator(sourceFile("shaders"))) {
    sources[entry.path().filename()] = readText(entry.path());
  }
  const std::function<bool(const std::string&)> uses = [&](const std::string& name) {
    return name == shader || std::ranges::any_of(sources, [&](const auto& other) {
             return sources[name].find("#include \"" + other.first + "\"") != std::string::npos && uses(other.first);
           });
  };
  for (const auto& [name, text] : sources) {
    const std::string ending = std::filesystem::path(name).extension();
    if (ending == ".glsl" || ending == ".h" || uses(name)) {
      std::ofstream(directory / name) << text;
    }
  }
  std::string text = sources.at(shader);
  text.insert(text.rfind('}'), code);
  std::ofstream(directory / shader) << text;
}

}  // namespace speculum::testing_support
