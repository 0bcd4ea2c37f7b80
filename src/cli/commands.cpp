#include "cli/commands.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <iostream>
#include <map>

#include "platform/folders.hpp"
#include "platform/machine.hpp"
#include "platform/process.hpp"
#include "platform/text.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_loader.hpp"
#include "window/demo.hpp"

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
  std::map<std::string, std::string> titles;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(dataDirectory("scenes"))) {
    if (entry.path().extension() == ".toml") {
      titles[entry.path().string()] = loadScene(entry.path()).title;
    }
  }
  for (const auto& [file, title] : titles) {
    // Names scenes as --scene takes them: hard/corner for a scene in a folder.
    const std::filesystem::path name = std::filesystem::path(file).lexically_relative(dataDirectory("scenes"));
    printLine(fmt::format("{:<24} {}", std::filesystem::path(name).replace_extension().generic_string(), title));
    printLine(fmt::format("{:25}{}", "", file));
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

}  // namespace speculum
