#include "scene_text.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "picture_support.hpp"

namespace speculum::hard_cases {

std::string text(double value) {
  std::ostringstream out;
  out.precision(17);
  out << std::showpoint << value;
  return out.str();
}

std::string text(const glm::dvec3& v) {
  return "[" + text(v.x) + ", " + text(v.y) + ", " + text(v.z) + "]";
}

std::filesystem::path sceneFile(const std::string& name, const std::string& toml) {
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  std::string prefix = std::string(test->test_suite_name()) + "_" + test->name() + "_";
  std::replace(prefix.begin(), prefix.end(), '/', '_');
  return testing_support::writeScene(prefix + name, toml);
}

void writeModel(const std::string& file, const std::string& obj) {
  const std::filesystem::path folder = sceneFile("folder", "").parent_path();
  const std::filesystem::path own = folder / (file + "." + std::to_string(getpid()));
  std::ofstream(own) << obj;
  std::filesystem::rename(own, folder / file);  // whole or not at all for who reads it meanwhile
}

void writeQuad() {
  writeModel("quad.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
}

}  // namespace speculum::hard_cases
