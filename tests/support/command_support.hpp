#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/process.hpp"
#include "test_paths.hpp"

// The program called as scripts call it.
namespace speculum::testing_support {

// What draws, draws with debug.check_finite.
inline ProcessResult speculum(std::vector<std::string> arguments) {
  if (arguments.front() == "render" || arguments.front() == "bench") {
    arguments.insert(arguments.begin() + 1, {"--set", "debug.check_finite=true"});
  }
  arguments.insert(arguments.begin(), binaryDir().string() + "/speculum");
  return runProcess(arguments);
}

inline nlohmann::json readJson(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return nlohmann::json::parse(stream);
}

}  // namespace speculum::testing_support
