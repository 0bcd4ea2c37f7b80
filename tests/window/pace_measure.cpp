// Measures the window's pace: pace_measure SCENE... prints a line of a table for each scene and camera path. See
// scripts/pace.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "compare/image_metrics.hpp"
#include "platform/process.hpp"
#include "virtual_display.hpp"
#include "window/demo.hpp"

namespace speculum {
namespace {

constexpr double warmup = 2.0;  // seconds
constexpr double pathSeconds = 8.0;
// Pictures of each path that are drawn once more in full quality, which takes long in scenes with traced effects.
const int comparedPictures = std::getenv("PACE_PICTURES") ? std::max(1, std::atoi(std::getenv("PACE_PICTURES"))) : 6;

// Gamepad state that drives the camera at a time.
using Path = GamepadState (*)(double seconds);
constexpr std::pair<const char*, Path> paths[] = {
    {"orbit", [](double t) { return GamepadState{.rightX = static_cast<float>(0.5 * std::cos(0.8 * t))}; }},
    {"walk",
     [](double t) {
       return GamepadState{.leftX = static_cast<float>(0.15 * std::sin(1.3 * t)),
                           .leftY = static_cast<float>(-0.2 * std::cos(0.5 * t)),
                           .rightX = static_cast<float>(0.3 * std::sin(0.7 * t))};
     }},
    {"rise",
     [](double t) {
       return GamepadState{.rightX = 0.15f,
                           .rightY = static_cast<float>(0.2 * std::sin(t)),
                           .rightTrigger = static_cast<float>(0.1 + 0.1 * std::sin(0.9 * t))};
     }},
};

struct Shown {
  double time = 0.0;
  CameraPose camera;
  Settings settings;
};

struct Measured {
  std::vector<double> frameMs;
  std::vector<Shown> shown;
  size_t images = 0;  // mirror images that were drawn, the most along one path

  void add(const Measured& other) {
    frameMs.insert(frameMs.end(), other.frameMs.begin(), other.frameMs.end());
    shown.insert(shown.end(), other.shown.begin(), other.shown.end());
    images = std::max(images, other.images);
  }
};

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Without a path the animation is paused, and the picture converges.
Measured follow(const Options& options, Path path) {
  Demo demo(options);
  const bool still = path == nullptr;
  if (still) {
    demo.apply(SetPaused{true});
    path = [](double) { return GamepadState(); };
  }
  const auto start = std::chrono::steady_clock::now();
  demo.setGamepadSource([&] { return std::optional(path(secondsSince(start))); });
  Measured measured;
  for (double last = 0.0; last < warmup + pathSeconds;) {
    demo.step();
    if (last < warmup && !still) {
      demo.apply(SetPaused{false});  // a slow scene opens still
    }
    const double now = secondsSince(start);
    if (last > warmup) {
      measured.frameMs.push_back(1000.0 * (now - last));
      const auto shown = static_cast<int>(measured.shown.size());
      if (shown < comparedPictures && last > warmup + pathSeconds * shown / comparedPictures) {
        measured.shown.push_back({demo.shown().playback.time, demo.camera(), demo.frameSettings()});
      }
    }
    last = now;
  }
  const FrameHistory& history = demo.shown().frame.history;
  measured.images =
      std::ranges::count_if(history.passNames(), [](const std::string& pass) { return pass.starts_with("mirror "); });
  if (std::getenv("PACE_PASSES")) {
    for (const std::string& name : history.passNames()) {
      std::fprintf(stderr, "%s %.1f  ", name.c_str(), percentile(history.passSeries(name), 0.5));
    }
    std::fprintf(stderr, "gpu %.1f cpu %.1f\n", percentile(history.series(FrameHistory::Figure::gpu), 0.5),
                 percentile(history.series(FrameHistory::Figure::cpu), 0.5));
  }
  return measured;
}

// Mean FLIP of what was shown against the same views in full quality.
double meanError(const Options& options, const std::vector<Shown>& shown) {
  Session session(options);
  const Settings full = session.settings();
  const auto draw = [&](const Shown& at, const Settings& settings) {
    session.setCamera(at.camera);
    session.setSettings(settings);
    session.restart();
    session.draw(at.time, true);
    session.finish();
    return session.picture();
  };
  double sum = 0.0;
  for (const Shown& at : shown) {
    const double flip = compareImages(comparedImage(draw(at, full)), comparedImage(draw(at, at.settings))).whole.flip;
    const Settings& s = at.settings;
    std::fprintf(stderr, "%.1f s: scale %.2f, %d passes, FLIP %.4f\n", at.time, s.view.scale, s.reflection.maxPasses,
                 flip);
    sum += flip;
  }
  return sum / static_cast<double>(shown.size());
}

// Frame times in ms.
struct Summary {
  explicit Summary(std::vector<double> ms)
      : mean(std::accumulate(ms.begin(), ms.end(), 0.0) / static_cast<double>(ms.size())) {
    std::ranges::sort(ms);
    median = ms[ms.size() / 2];
    p95 = ms[ms.size() * 95 / 100];
    longest = ms.back();
  }

  double mean = 0.0;
  double median = 0.0;
  double p95 = 0.0;
  double longest = 0.0;
};

// Settings that do not follow the movement, each at the largest of the scales below that keeps the budget.
using Setting = std::pair<std::string, std::string>;
const std::vector<std::vector<Setting>> fixedSettings = {
    {},
    {{"view.samples", "4"}},
    {{"reflection.method", "auto"}},
    {{"reflection.max_passes", "32"}},
    {{"reflection.max_passes", "16"}},
    {{"reflection.max_passes", "8"}},
};
constexpr std::array fixedScales = {"0.125", "0.18", "0.25", "0.35", "0.5", "0.7", "1"};

// Follows all paths with the settings at the largest of the scales that keeps a budget of 50 ms in the mean and 70 ms
// at the 95th percentile of all frames; nothing if none does.
std::optional<std::pair<Measured, std::string>> fastEnough(const Options& options,
                                                           const std::vector<Setting>& settings) {
  std::optional<std::pair<Measured, std::string>> kept;
  for (auto [low, high] = std::pair<size_t, size_t>(0, fixedScales.size()); low < high;) {
    const size_t middle = (low + high) / 2;
    Options fixed = options;
    fixed.settings = {{"quality.motion_ms", "0"}, {"view.samples", "1"}, {"reflection.samples", "1"}};
    fixed.settings.emplace_back("view.scale", fixedScales[middle]);
    fixed.settings.insert(fixed.settings.end(), settings.begin(), settings.end());
    Measured measured;
    for (const auto& [name, path] : paths) {
      measured.add(follow(fixed, path));
    }
    const Summary ms(measured.frameMs);
    const bool fits = ms.mean <= 50.0 && ms.p95 <= 70.0;
    (fits ? low : high) = fits ? middle + 1 : middle;
    if (fits) {
      kept.emplace(std::move(measured), std::string("scale ") + fixedScales[middle]);
    }
  }
  return kept;
}

// Prints the smallest error of fixed settings that keep the budget along all paths, and the settings. Compares the
// views that were `shown` when settings followed the movement.
void measureFixed(const Options& options, std::vector<Shown> shown) {
  double best = INFINITY;
  size_t images = SIZE_MAX;  // that are drawn without a limit
  std::string about = "none";
  for (const std::vector<Setting>& settings : fixedSettings) {
    if (settings.size() == 1 && settings[0].first == "reflection.max_passes" &&
        std::stoul(settings[0].second) >= images) {
      continue;
    }
    const auto kept = fastEnough(options, settings);
    if (!kept) {
      continue;
    }
    if (settings.empty()) {
      images = kept->first.images;
    }
    std::string text = kept->second;
    for (const auto& [key, value] : settings) {
      text += ", " + key + " " + value;
    }
    for (Shown& at : shown) {
      at.settings = kept->first.shown.front().settings;
    }
    const double error = meanError(options, shown);
    std::fprintf(stderr, "%s: FLIP %.4f\n", text.c_str(), error);
    if (error < best) {
      best = error;
      about = text;
    }
  }
  std::printf("| %s | all | best fixed: %s | | | | %.4f |\n", options.scene.c_str(), about.c_str(), best);
  std::fflush(stdout);
}

// The frames of a still picture, which must let the panels answer.
void measureStill(const Options& options) {
  const Summary ms(follow(options, nullptr).frameMs);
  std::printf("| %s | still | | %.0f | %.0f, longest %.0f | | |\n", options.scene.c_str(), ms.median, ms.p95,
              ms.longest);
  std::fflush(stdout);
}

// Prints the row of one path, or of all; `error` is the mean of what was shown.
void print(const Options& options, const char* path, const Measured& measured, double error) {
  const Summary ms(measured.frameMs);
  double scale = 0.0;
  for (const Shown& at : measured.shown) {
    scale += at.settings.view.scale / static_cast<double>(measured.shown.size());
  }
  std::printf("| %s | %s | %.1f | %.0f | %.0f | %.2f | %.4f |\n", options.scene.c_str(), path, 1000.0 / ms.mean,
              ms.median, ms.p95, scale, error);
  std::fflush(stdout);
}

void measure(const std::string& scene) {
  Options options;
  options.scene = scene;
  options.window.presentMode = PresentMode::immediate;
  if (!std::getenv("PACE_STILL")) {
    Measured all;
    double sum = 0.0;  // of the paths' errors, which are of equally many pictures
    for (const auto& [name, path] : paths) {
      const Measured measured = follow(options, path);
      const double error = meanError(options, measured.shown);
      print(options, name, measured, error);
      sum += error;
      all.add(measured);
    }
    if (std::getenv("PACE_FIXED")) {
      print(options, "all", all, sum / static_cast<double>(std::size(paths)));
      measureFixed(options, all.shown);
    }
  }
  measureStill(options);
}

}  // namespace
}  // namespace speculum

int main(int argc, char** argv) {
  speculum::keepFreedMemory();  // as the program does
  const speculum::test::VirtualDisplay display;
  for (int i = 1; i < argc; ++i) {
    speculum::measure(argv[i]);
  }
  return EXIT_SUCCESS;
}
