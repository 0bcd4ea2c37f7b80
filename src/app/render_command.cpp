#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/bench_against.hpp"
#include "app/commands.hpp"
#include "app/effect_prices.hpp"
#include "app/progress.hpp"
#include "app/session.hpp"
#include "app/stats.hpp"
#include "image/exr.hpp"
#include "image/picture_files.hpp"
#include "platform/process.hpp"
#include "platform/renderdoc_capture.hpp"
#include "reference/throughput.hpp"

namespace speculum {

namespace {

using Clock = std::chrono::steady_clock;

void savePicture(Session& session, const std::filesystem::path& file) {
  if (file.extension() == ".exr") {
    writeExr(file, session.radiance());
  } else {
    writePng(file, session.picture());
  }
}

}  // namespace

int runRender(const Options& options) {
  const int count = std::max(1, options.frames);
  const PictureFiles files(options.out, options.frames > 0 ? count : 0);
  Session session(options);
  session.renderer().setTimerDetail(options.stats.empty() ? TimerDetail::frame : TimerDetail::passes);
  installInterruptHandler();
  Progress progress("render", count * session.settings().view.accumulate);
  const auto advance = [&] {
    progress.advance();
    return !interruptRequested();
  };
  for (int i = 0; i < count; ++i) {
    const auto draw = [&] {
      session.draw(options.time + i / options.fps, true, advance);
      session.finish();
    };
    if (options.capture && i == 0) {
      captureWithRenderDoc(*options.capture, draw);
    } else {
      draw();
    }
    if (session.lastFrame().pictures < session.settings().view.accumulate) {
      return 1;  // interrupted
    }
    savePicture(session, files.at(i));
    if (interruptRequested()) {
      return 1;
    }
  }
  if (!options.stats.empty()) {
    writeJson(options.stats, frameStats(session));
  }
  return session.exitCode();
}

namespace {

// Measures rays per second and core of the double-precision tracer.
int benchReference(const Options& options) {
  constexpr int64_t triangles = 100000;
  constexpr int64_t rays = 1000000;
  const RayThroughput result = measureRayThroughput(triangles, rays);
  std::printf(
      "%lld triangles, %lld random rays, %.1f %% hit, one core: %.3f million rays per second (hierarchy: %.2f s)\n",
      static_cast<long long>(result.triangles), static_cast<long long>(result.rays), 100.0 * result.hitFraction,
      1e-6 * result.raysPerSecond(), result.buildSeconds);
  if (!options.json.empty()) {
    writeJson(options.json, {{"triangles", result.triangles},
                             {"rays", result.rays},
                             {"hit_fraction", result.hitFraction},
                             {"seconds", result.seconds},
                             {"build_seconds", result.buildSeconds},
                             {"rays_per_second", result.raysPerSecond()}});
  }
  return 0;
}

bool isSet(const Options& options, std::string_view key) {
  return std::any_of(options.settings.begin(), options.settings.end(), [&](const auto& s) { return s.first == key; });
}

void addPrices(nlohmann::ordered_json& merged, const std::vector<EffectPrice>& prices) {
  for (size_t i = 0; i < prices.size(); ++i) {
    if (!prices[i].empty()) {
      merged["effects"][i]["gpu_ms"] = summary(prices[i]);
    }
  }
}

void printEffects(const nlohmann::ordered_json& effects) {
  std::printf("%-40s %6s %10s %10s %8s %10s %10s\n", "effect", "", "median ms", "p95 ms", "draws", "bytes",
              "pipelines");
  for (const auto& effect : effects) {
    if (effect["called_for"].get<bool>()) {
      const auto ms = [&](const char* key) {
        return effect["gpu_ms"].is_null() ? std::string("-")
                                          : fmt::format("{:.3f}", effect["gpu_ms"][key].get<double>());
      };
      std::printf("%-40s %6s %10s %10s %8s %10s %10s\n", effect["name"].get<std::string>().c_str(), "",
                  ms("median").c_str(), ms("p95").c_str(), effect["draws"].dump().c_str(),
                  effect["bytes"].dump().c_str(), effect["pipelines"].dump().c_str());
    }
  }
}

// Draws one frame at a time, so that times of frames do not mix. Returns nothing if interrupted.
std::optional<nlohmann::ordered_json> measureFrames(Session& session, const Options& options, int measured,
                                                    Progress& progress) {
  std::vector<nlohmann::ordered_json> frames;
  std::vector<std::vector<PassId>> passes;
  for (int i = 0; i < options.warmup + measured; ++i) {
    session.draw(options.time, false, [] { return !interruptRequested(); });
    session.finish();
    if (i >= options.warmup) {
      frames.push_back(frameStats(session));
      passes.push_back(passIds(session));
    }
    progress.advance();
    if (interruptRequested()) {
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
    session.draw(time, false, [] { return !interruptRequested(); });
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
  session.renderer().setTimerDetail(TimerDetail::passes);
  return summary(std::move(intervals));
}

void printBench(const nlohmann::ordered_json& merged, int measured) {
  std::printf("%-40s %6s %10s %10s %8s %10s %10s\n", "pass", "frames", "median ms", "p95 ms", "draws", "triangles",
              "fragments");
  const auto figure = [](const nlohmann::ordered_json& value) {
    return value.is_null() ? std::string("-") : value.dump();
  };
  for (const auto& pass : merged["passes"]) {
    std::printf("%-40s %6d %10.3f %10.3f %8s %10s %10s\n", pass["name"].get<std::string>().c_str(),
                pass.value("frames", measured), pass["gpu_ms"]["median"].get<double>(),
                pass["gpu_ms"]["p95"].get<double>(), figure(pass["draws"]).c_str(), figure(pass["triangles"]).c_str(),
                figure(pass["fragments"]).c_str());
  }
  printEffects(merged["effects"]);
  for (const char* key : {"cpu_ms", "gpu_ms", "frame_ms", "interval_ms"}) {
    const auto& total = merged["totals"][key];
    std::printf("%-40s %6d %10.3f %10.3f\n", key, measured, total["median"].get<double>(), total["p95"].get<double>());
  }
}

}  // namespace

int runBench(const Options& options) {
  if (!options.againstBinary.empty() || !options.againstSettings.empty()) {
    return benchAgainst(options);
  }
  if (options.benchReference) {
    return benchReference(options);
  }
  const int measured = options.frames > 0 ? options.frames : 60;
  Session session(options);
  if (!isSet(options, "reflection.skip_unchanged")) {
    // All frames have the same time, so with reuse only the first would render mirror images.
    Settings settings = session.settings();
    settings.reflection.skipUnchanged = false;
    session.setSettings(settings);
  }
  installInterruptHandler();
  Progress progress("bench", options.warmup + 2 * measured);
  std::optional<nlohmann::ordered_json> merged = measureFrames(session, options, measured, progress);
  const auto intervals = merged ? measureIntervals(session, options.time, measured, progress) : std::nullopt;
  if (!intervals) {
    return 1;
  }
  (*merged)["totals"]["interval_ms"] = *intervals;
  if (options.benchPrices) {
    addPrices(*merged, effectPrices(session, options.time, std::max(5, measured / 4)));
    if (interruptRequested()) {
      return 1;
    }
  }
  printBench(*merged, measured);
  if (!options.json.empty()) {
    writeJson(options.json, *merged);
  }
  return session.exitCode();
}

}  // namespace speculum
