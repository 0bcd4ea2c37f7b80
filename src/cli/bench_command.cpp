#include <spdlog/fmt/fmt.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <random>

#include "accuracy/sweep_planner.hpp"
#include "cli/commands.hpp"
#include "cli/stats.hpp"
#include "geometry/triangle_mesh.hpp"
#include "platform/files.hpp"
#include "platform/process.hpp"
#include "platform/text.hpp"
#include "session/options.hpp"
#include "session/session.hpp"

namespace speculum {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto untilInterrupted = [] { return !interruptRequested(); };
constexpr std::array totals = {"cpu_ms", "plan_ms", "gpu_ms", "frame_ms", "interval_ms"};

// Returns the processor time of this thread, which other load does not change.
double threadSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Mesh bumpySphere(int64_t triangles) {
  const auto rings = static_cast<uint32_t>(std::max(4.0, std::sqrt(static_cast<double>(triangles) / 4.0)));
  const uint32_t columns = 2 * rings;
  Mesh mesh;
  for (uint32_t i = 0; i <= rings; ++i) {
    for (uint32_t j = 0; j <= columns; ++j) {
      const double theta = std::numbers::pi * i / rings;
      const double phi = 2.0 * std::numbers::pi * j / columns;
      const glm::dvec3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
      const double bump = 1.0 + 0.2 * std::sin(7.0 * n.x) * std::sin(5.0 * n.y) + 0.1 * std::sin(11.0 * n.z);
      mesh.vertices.push_back({bump * n, n, glm::dvec2(0.0)});
    }
  }
  for (uint32_t i = 0; i < rings; ++i) {
    for (uint32_t j = 0; j < columns; ++j) {
      const uint32_t a = i * (columns + 1) + j;
      const uint32_t b = a + columns + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  }
  mesh.parts = {{0, static_cast<uint32_t>(mesh.indices.size()), {}}};
  return mesh;
}

std::vector<Ray> randomRays(int64_t count) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto direction = [&] { return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))); };
  std::vector<Ray> rays(static_cast<size_t>(count));
  for (Ray& ray : rays) {
    ray.origin = 3.0 * direction();
    ray.direction = direction() - ray.origin;
  }
  return rays;
}

// Measures rays per second and core of the double-precision tracer: its queries for the closest hit on a bumpy sphere,
// with rays from random origins around the sphere to random points near the sphere, in no order that would help a
// cache. The rays are the same in every run.
int benchReference(const Options& options) {
  const Mesh mesh = bumpySphere(100'000);
  const std::vector<Ray> rays = randomRays(1'000'000);
  const size_t triangles = mesh.indices.size() / 3;
  const double buildStart = threadSeconds();
  const TriangleMesh tree(mesh);
  const double start = threadSeconds();
  const auto hits = std::ranges::count_if(rays, [&](const Ray& ray) { return tree.closest(ray).has_value(); });
  const double seconds = threadSeconds() - start;
  const double buildSeconds = start - buildStart;
  const double hitFraction = static_cast<double>(hits) / static_cast<double>(rays.size());
  const double raysPerSecond = static_cast<double>(rays.size()) / seconds;
  printLine(
      fmt::format(
          "{} triangles, {} random rays, {:.1f} % hit, one core: {:.3f} million rays per second (hierarchy: {:.2f} s)",
          triangles, rays.size(), 100.0 * hitFraction, 1e-6 * raysPerSecond, buildSeconds),
      besideOutput(options.json));
  if (!options.json.empty()) {
    writeJson(options.json, {{"triangles", triangles},
                             {"rays", rays.size()},
                             {"hit_fraction", hitFraction},
                             {"seconds", seconds},
                             {"build_seconds", buildSeconds},
                             {"rays_per_second", raysPerSecond}});
  }
  return 0;
}

double gpuMs(Session& session, const Settings& settings, double time) {
  session.setSettings(settings);
  session.draw(time, false, untilInterrupted);
  session.finish();
  return session.lastFrame().gpuMs;
}

// Adds the GPU milliseconds of each effect that the frame drawn last calls for. Draws frames with and without the
// effect in turn: `pairs` pairs, after a first pair that is not counted. Returns false if interrupted.
bool addPrices(nlohmann::ordered_json& merged, Session& session, double time, int pairs) {
  const Settings all = session.settings();
  session.renderer().setTimerDetail(TimerDetail::frame);
  const DrawnFrame& frame = session.lastFrame();
  const std::vector<Effect> effects = effectsOf(session.scene(), frame.state, frame.settings, frame.plan);
  for (size_t i = 0; i < effects.size(); ++i) {
    const Settings without = settingsWith(all, settingsWithout(effects[i]));
    std::vector<double> price;
    for (int pair = 0; effects[i].calledFor && pair <= pairs && !interruptRequested(); ++pair) {
      const double with = gpuMs(session, all, time);
      const double rest = gpuMs(session, without, time);
      if (pair > 0) {
        price.push_back(with - rest);
      }
    }
    if (!price.empty()) {
      merged["effects"][i]["gpu_ms"] = summary(std::move(price));
    }
  }
  return !interruptRequested();
}

// Measures frames that are drawn one at a time, so that times of frames do not mix. Returns nothing if interrupted.
std::optional<nlohmann::ordered_json> measureFrames(Session& session, const Options& options, int measured,
                                                    Progress& progress) {
  std::vector<nlohmann::ordered_json> frames;
  std::vector<std::vector<PassId>> passes;
  for (int i = 0; i < options.bench.warmup + measured; ++i) {
    session.draw(options.time, false, untilInterrupted);
    session.finish();
    if (i >= options.bench.warmup) {
      if (!frames.empty()) {
        frames.back()["skipped"].clear();  // only the last list is merged, and each may be long
      }
      frames.push_back(frameStats(session));
      passes.push_back(passIds(session));
    }
    if (!progress.advance()) {
      return std::nullopt;
    }
  }
  return mergeStats(frames, passes);
}

// Measures milliseconds from one frame to the next as in a window without panels and vertical sync: the CPU records a
// frame while the device draws the last one, and passes are not timed. Returns nothing if interrupted.
std::optional<nlohmann::ordered_json> measureIntervals(Session& session, double time, int measured,
                                                       Progress& progress) {
  constexpr int untilTheyOverlap = static_cast<int>(framesInFlight) + 1;
  std::vector<double> intervals;
  Clock::time_point last{};
  session.renderer().setTimerDetail(TimerDetail::frame);
  for (int i = 0; i < untilTheyOverlap + measured; ++i) {
    session.draw(time, false, untilInterrupted);
    const Clock::time_point now = Clock::now();
    if (i >= untilTheyOverlap) {
      intervals.push_back(std::chrono::duration<double, std::milli>(now - last).count());
      progress.advance();
    }
    last = now;
    if (interruptRequested()) {
      return std::nullopt;
    }
  }
  session.finish();
  session.renderer().setTimerDetail(TimerDetail::samples);
  return summary(std::move(intervals));
}

constexpr const char* benchRow = "{:<40} {:>6} {:>10} {:>10} {:>8} {:>10} {:>10}";

// Prints a row of the merged stats; a dash stands for figures that the device does not count.
void printRow(std::FILE* to, const nlohmann::ordered_json& row, const std::string& frames,
              const std::array<const char*, 3>& figures) {
  const nlohmann::ordered_json& gpu = row["gpu_ms"];
  const auto ms = [&](const char* key) { return gpu.is_null() ? "-" : fmt::format("{:.3f}", gpu[key].get<double>()); };
  const auto figure = [&](size_t i) { return row[figures[i]].is_null() ? "-" : row[figures[i]].dump(); };
  printLine(fmt::format(benchRow, row["name"].get<std::string>(), frames, ms("median"), ms("p95"), figure(0), figure(1),
                        figure(2)),
            to);
}

void printBench(std::FILE* to, const nlohmann::ordered_json& merged, int measured) {
  printLine(fmt::format(benchRow, "pass", "frames", "median ms", "p95 ms", "draws", "triangles", "fragments"), to);
  for (const auto& pass : merged["passes"]) {
    printRow(to, pass, std::to_string(pass.value("frames", measured)), {"draws", "triangles", "fragments"});
  }
  printLine(fmt::format(benchRow, "effect", "", "median ms", "p95 ms", "draws", "bytes", "pipelines"), to);
  for (const auto& effect : merged["effects"]) {
    if (effect["called_for"].get<bool>()) {
      printRow(to, effect, "", {"draws", "bytes", "pipelines"});
    }
  }
  for (const char* key : totals) {
    const auto& total = merged["totals"][key];
    printLine(fmt::format("{:<40} {:>6} {:>10.3f} {:>10.3f}", key, measured, total["median"].get<double>(),
                          total["p95"].get<double>()),
              to);
  }
}

}  // namespace

int runBench(const Options& options) {
  if (options.bench.tracer) {
    return benchReference(options);
  }
  const int measured = options.frames > 0 ? options.frames : 60;
  Session session(options);
  session.showOnly();
  const auto asked = &std::pair<std::string, std::string>::first;
  if (std::ranges::count(options.settings, "reflection.skip_unchanged", asked) == 0) {
    // All frames have the same time, so with reuse only the first would render mirror images.
    Settings settings = session.settings();
    settings.reflection.skipUnchanged = false;
    session.setSettings(settings);
  }
  installInterruptHandler();
  Progress progress("bench", options.bench.warmup + 2 * measured);
  std::optional<nlohmann::ordered_json> merged = measureFrames(session, options, measured, progress);
  const auto intervals = merged ? measureIntervals(session, options.time, measured, progress) : std::nullopt;
  if (!intervals) {
    return 1;
  }
  (*merged)["totals"]["interval_ms"] = *intervals;
  if (options.bench.prices && !addPrices(*merged, session, options.time, std::max(5, measured / 4))) {
    return 1;
  }
  printBench(besideOutput(options.json), *merged, measured);
  if (!options.json.empty()) {
    writeJson(options.json, *merged);
  }
  return session.exitCode();
}

}  // namespace speculum
