#include "app/commands.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <iostream>
#include <map>

#include "app/demo.hpp"
#include "app/device_view.hpp"
#include "platform/folders.hpp"
#include "platform/machine.hpp"
#include "platform/window.hpp"
#include "scene/scene_loader.hpp"

namespace speculum {

namespace {

// Sends log lines to stderr, because stdout is for pictures and figures.
void setUpLog(const std::string& level) {
  const auto logger = std::make_shared<spdlog::logger>("speculum", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%l: %v");
  logger->set_level(spdlog::level::from_str(level == "warn" ? "warning" : level));
  spdlog::set_default_logger(logger);
}

int runInfo() {
  for (const DeviceInfo& info : Device::list()) {
    std::printf("%d: %s\n   driver %s, Vulkan %s, %.0f MiB, %s%s\n", info.index, info.name.c_str(), info.driver.c_str(),
                vulkanVersion(info.apiVersion).c_str(), static_cast<double>(info.memoryBytes) / (1024.0 * 1024.0),
                info.missing            ? ("not usable: " + *info.missing).c_str()
                : info.dynamicRendering ? "dynamic rendering"
                                        : "render passes only",
                info.rayQueries ? ", ray queries" : "");
  }
  return 0;
}

int runScenes() {
  std::map<std::string, std::string> titles;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(dataDirectory("scenes"))) {
    if (entry.path().extension() == ".toml") {
      titles[entry.path().string()] = loadScene(entry.path()).title;
    }
  }
  for (const auto& [file, title] : titles) {
    // Names scenes as --scene takes them: hard/corner for a scene in a folder.
    const std::filesystem::path name = std::filesystem::path(file).lexically_relative(dataDirectory("scenes"));
    std::printf("%-24s %s\n%25s%s\n", std::filesystem::path(name).replace_extension().c_str(), title.c_str(), "",
                file.c_str());
  }
  return 0;
}

// Runs the command, once more if the device is lost.
int runCommand(const Options& options) {
  static const std::map<std::string, int (*)(const Options&)> commands = {
      {"demo",
       [](const Options& wanted) {
         chooseWindowPlatform(wanted.platform);
         return runDemo(wanted);
       }},
      {"render", runRender},
      {"bench", runBench},
      {"reference", runReference},
      {"compare", runCompare},
      {"accuracy", runAccuracy},
      {"regress", runRegress},
      {"info", [](const Options&) { return runInfo(); }},
      {"scenes", [](const Options&) { return runScenes(); }},
  };
  const auto command = commands.at(options.command);
  try {
    return command(options);
  } catch (const DeviceLostError& error) {
    spdlog::warn("{}; starting again", error.what());
  }
  return command(options);
}

}  // namespace

int speculumMain(int argc, const char* const* argv) {
  keepFreedMemory();
  try {
    int result = 0;
    if (const std::optional<Options> options = parseOptions(argc, argv)) {
      setUpLog(options->logLevel);
      result = runCommand(*options);
    }
    std::cout.flush();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout) {
      throw std::runtime_error("standard output: cannot be written (check the disk that it goes to)");
    }
    return result;
  } catch (const std::filesystem::filesystem_error& error) {
    std::fprintf(stderr, "%s: %s (check the path)\n", error.path1().c_str(), error.code().message().c_str());
    return 2;
  } catch (const std::exception& error) {
    // Bad usage, bad input and a missing GPU end here: nothing was done, and the message says what would help.
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}

}  // namespace speculum
