#pragma once

#include <nlohmann/json.hpp>

#include "platform/process.hpp"
#include "test_headers.hpp"
#include "test_paths.hpp"

// The program called as scripts call it.
namespace speculum::testing_support {

inline const std::string program = binaryDir().string() + "/speculum";

// Runs the program; commands that draw do so with debug.check_finite.
inline ProcessResult speculum(std::vector<std::string> arguments) {
  if (arguments.front() == "render" || arguments.front() == "bench") {
    arguments.insert(arguments.begin() + 1, {"--set", "debug.check_finite=true"});
  }
  arguments.insert(arguments.begin(), program);
  return runProcess(arguments);
}

// Runs the program, expects success and returns its output.
inline std::string succeed(std::vector<std::string> arguments) {
  const ProcessResult result = speculum(std::move(arguments));
  EXPECT_EQ(result.exitCode, 0) << result.output;
  return result.output;
}

// Runs the program, expects exit code 2 and one line that can be read, and returns that.
inline std::string mistake(std::vector<std::string> arguments) {
  const ProcessResult result = speculum(std::move(arguments));
  EXPECT_EQ(result.exitCode, 2) << result.output;
  EXPECT_EQ(std::ranges::count_if(result.output, [](unsigned char c) { return c < 0x20 || c == 0x7f; }), 1)
      << result.output;
  EXPECT_LT(result.output.size(), 4100u);
  return result.output;
}

inline nlohmann::json readJson(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return nlohmann::json::parse(stream);
}

}  // namespace speculum::testing_support
