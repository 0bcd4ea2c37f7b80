#include "frame/scene_names.hpp"

namespace speculum {

std::string nameOf(const std::string& kind, const std::string& name, int index) {
  return kind + " " + (name.empty() ? std::to_string(index) : "'" + name + "'");
}

}  // namespace speculum
