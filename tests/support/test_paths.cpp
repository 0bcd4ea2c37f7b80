#include "test_paths.hpp"

namespace speculum {

std::filesystem::path sourceDir() {
  return SPECULUM_SOURCE_DIR;
}

std::filesystem::path binaryDir() {
  return SPECULUM_BINARY_DIR;
}

}  // namespace speculum
