#include "app/bench_against.hpp"

#include <array>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "accuracy/statistics.hpp"
#include "app/progress.hpp"
#include "app/stats.hpp"
#include "platform/folders.hpp"
#include "platform/process.hpp"

namespace speculum {

namespace {

constexpr std::array keys = {"cpu_ms", "gpu_ms", "frame_ms", "interval_ms"};

std::string lastLine(std::string text) {
  while (!text.empty() && text.back() == '\n') {
    text.pop_back();
  }
  return text.substr(text.rfind('\n') + 1);
}

// Runs the command and returns its median milliseconds, by key; nothing after Ctrl-C.
std::optional<std::map<std::string, double>> measured(const std::vector<std::string>& command,
                                                      const std::filesystem::path& json) {
  const ProcessResult result = runProcess(command);
  if (interruptRequested()) {
    return std::nullopt;
  }
  if (result.exitCode != 0) {
    throw UsageError(command.front() + ": bench ended with exit code " + std::to_string(result.exitCode) + ": " +
                     lastLine(result.output));
  }
  const auto figures = nlohmann::json::parse(readText(json), nullptr, false);
  std::map<std::string, double> medians;
  for (const char* key : keys) {
    const auto median = nlohmann::json::json_pointer("/totals/" + std::string(key) + "/median");
    if (figures.contains(median) && figures[median].is_number()) {
      medians[key] = figures[median];
    }
  }
  if (medians.empty()) {
    throw UsageError(command.front() + ": bench --json wrote no times");
  }
  return medians;
}

}  // namespace

int benchAgainst(const Options& options) {
  const TemporaryDirectory folder;
  const std::filesystem::path json = folder.path() / "bench.json";
  const auto command = [&](const std::filesystem::path& program) {
    std::vector<std::string> arguments{program.string()};
    arguments.insert(arguments.end(), options.benchArguments.begin(), options.benchArguments.end());
    arguments.insert(arguments.end(), {"--json", json.string()});
    return arguments;
  };
  const std::vector<std::string> own = command(executablePath());
  std::vector<std::string> other =
      command(options.againstBinary.empty() ? executablePath() : std::filesystem::absolute(options.againstBinary));
  for (const auto& [key, value] : options.againstSettings) {
    other.insert(other.end(), {"--set", key + "=" + value});
  }
  const int rounds = options.benchRounds;
  installInterruptHandler();
  std::map<std::string, std::vector<double>> ratios;
  Progress progress("bench", 2 * rounds);
  for (int round = 0; round < rounds; ++round) {
    std::array<std::map<std::string, double>, 2> times;
    // The order changes with each round, because a machine that warms up or slows down would favour one of them. The
    // other program is first at the beginning, because it may not run at all.
    for (const size_t side : round % 2 == 0 ? std::array<size_t, 2>{1, 0} : std::array<size_t, 2>{0, 1}) {
      const auto medians = measured(side == 0 ? own : other, json);
      if (!medians) {
        return 1;
      }
      times[side] = *medians;
      progress.advance();
    }
    for (const auto& [key, ms] : times[0]) {
      if (times[1].contains(key) && times[1][key] > 0.0) {
        ratios[key].push_back(ms / times[1][key]);
      }
    }
  }
  nlohmann::ordered_json written{{"rounds", rounds}, {"ratios", nlohmann::ordered_json::object()}};
  std::printf("%-12s %8s %8s %8s %8s   this over the other, %d rounds\n", "ratio of", "median", "min", "q1", "q3",
              rounds);
  for (const char* key : keys) {
    if (ratios.contains(key)) {
      const Spread spread = spreadOf(ratios[key]);
      std::printf("%-12s %8.3f %8.3f %8.3f %8.3f\n", key, spread.median, spread.minimum, spread.lowerQuartile,
                  spread.upperQuartile);
      written["ratios"][key] = {{"median", spread.median},
                                {"min", spread.minimum},
                                {"q1", spread.lowerQuartile},
                                {"q3", spread.upperQuartile},
                                {"values", ratios[key]}};
    }
  }
  if (!options.json.empty()) {
    writeJson(options.json, written);
  }
  return 0;
}

}  // namespace speculum
