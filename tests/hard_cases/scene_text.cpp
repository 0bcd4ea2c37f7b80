#include "scene_text.hpp"

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

void writeModel(const std::string& file, const std::string& obj) {
  const std::filesystem::path folder = testing_support::writeScene("folder", "").parent_path();
  std::ofstream(folder / file) << obj;
}

void writeQuad() {
  writeModel("quad.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
}

}  // namespace speculum::hard_cases
