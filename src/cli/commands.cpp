#include "cli/commands.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <iostream>
#include <map>

#include "core/device.hpp"
#include "platform/files.hpp"
#include "platform/process.hpp"
#include "platform/text.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_loader.hpp"

namespace speculum {

namespace {

// Formats a log message, which keeps the line breaks of compilers and validation layers.
class LogText : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& text) override {
    const std::string lines = indentedLines({message.payload.data(), message.payload.size()});
    text.append(lines.data(), lines.data() + lines.size());
  }
  std::unique_ptr<spdlog::custom_flag_formatter> clone() const override { return std::make_unique<LogText>(); }
};

// Sends log lines to stderr, because stdout is for pictures and figures.
void setUpLog(const std::string& level) {
  const auto logger = std::make_shared<spdlog::logger>("speculum", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<LogText>('*').set_pattern("%l: %*");
  logger->set_formatter(std::move(formatter));
  logger->set_level(spdlog::level::from_str(level == "warn" ? "warning" : level));
  spdlog::set_default_logger(logger);
}

int runInfo(const Options& options) {
  std::vector<DeviceInfo> devices = Device::list();
  std::erase_if(devices, [&](const DeviceInfo& info) {
    return options.gpu != std::to_string(info.index) &&
           lowerCase(info.name).find(lowerCase(options.gpu)) == std::string::npos;
  });
  if (devices.empty() && !options.gpu.empty()) {
    throw UsageError("--gpu: no GPU '" + options.gpu + "' (without --gpu, info lists all)");
  }
  for (const DeviceInfo& info : devices) {
    printLine(fmt::format("{}: {}", info.index, info.name));
    printLine(fmt::format("   driver {}, Vulkan {}, {:.0f} MiB, {}{}", info.driver, info.vulkanVersion(),
                          static_cast<double>(info.memoryBytes) / (1024.0 * 1024.0),
                          info.missing            ? "not usable: " + *info.missing
                          : info.dynamicRendering ? "dynamic rendering"
                                                  : "render passes only",
                          info.rayQueries ? ", ray queries" : ""));
  }
  return 0;
}

int runScenes(const Options&) {
  for (const std::string& name : shippedSceneNames()) {
    const std::filesystem::path file = dataDirectory("scenes") / (name + ".toml");
    printLine(fmt::format("{:<24} {}", name, loadScene(file).title));
    printLine(fmt::format("{:25}{}", "", file.string()));
  }
  return 0;
}

// Runs the command, once more if the device is lost.
int runCommand(const Options& options) {
  static const std::map<std::string, int (*)(const Options&)> commands = {
      {"demo", runDemo},           {"render", runRender},   {"bench", runBench},
      {"reference", runReference}, {"compare", runCompare}, {"accuracy", runAccuracy},
      {"regress", runRegress},     {"info", runInfo},       {"scenes", runScenes},
  };
  const auto command = commands.at(options.command);
  try {
    return command(options);
  } catch (const DeviceLostError& error) {
    spdlog::warn("{}; starting again", error.what());
  }
  return command(options);
}

int fail(const std::string& message) {
  printLine(message, stderr);
  showFailure(oneLine(message));
  return 2;
}

constexpr double quietSeconds = 1.0;
constexpr double atOnce = 0.2;  // seconds; work reported so soon is not part of the pace
constexpr double plainInterval = 5.0;
constexpr double barInterval = 0.1;

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

int speculumMain(int argc, const char* const* argv) {
  keepFreedMemory();
  explainLackOfMemory();
  letLargeWritesFail();
  try {
    int result = 0;
    if (const std::optional<Options> options = parseOptions(argc, argv)) {
      setUpLog(options->logLevel);
      result = runCommand(*options);
      if (result == 1 && interruptRequested()) {
        printLine("interrupted", stderr);
      }
    }
    std::cout.flush();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout) {
      throw std::runtime_error("standard output: cannot be written (check the disk that it goes to)");
    }
    return result;
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(error.path1().string() + ": " + error.code().message() + " (check the path)");
  } catch (const std::exception& error) {
    // Bad usage, bad input and a missing GPU end here: nothing was done, and the message says what would help.
    return fail(error.what());
  }
}

Progress::Progress(std::string_view what, double total)
    : what_(oneLine(what)),
      total_(total),
      terminal_(isTerminal(2)),
      created_(Clock::now()),
      start_(created_),
      last_(start_) {}

Progress::~Progress() {
  if (shown_ && terminal_) {
    std::fprintf(stderr, "\n");
  }
}

bool Progress::set(double done) {
  done_ = done;
  const Clock::time_point now = Clock::now();
  // An earlier run did the work that is reported at once, so this work is not part of the pace.
  if (seconds(now - created_) < atOnce) {
    before_ = done;
    start_ = now;
  }
  const double elapsed = seconds(now - start_);
  const bool due = seconds(now - last_) >= (terminal_ ? barInterval : plainInterval) || (shown_ && done >= total_);
  if (elapsed >= quietSeconds && due && done > before_) {
    last_ = now;
    shown_ = true;
    print(elapsed / (done - before_) * (total_ - done));
  }
  return !interruptRequested();
}

void Progress::print(double secondsLeft) {
  const double part = total_ > 0.0 ? done_ / total_ : 1.0;
  if (!terminal_) {
    std::fprintf(stderr, "%s: %.0f %%, %.0f s left\n", what_.c_str(), 100.0 * part, secondsLeft);
    return;
  }
  constexpr int width = 40;
  const int filled = static_cast<int>(part * width);
  std::fprintf(stderr, "\r%s [%s%s] %3.0f %%, %.0f s left  ", what_.c_str(), std::string(filled, '#').c_str(),
               std::string(width - filled, '.').c_str(), 100.0 * part, secondsLeft);
  std::fflush(stderr);
}

}  // namespace speculum
