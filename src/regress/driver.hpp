#pragma once

#include <string>

namespace speculum {

// Says whether a driver, such as "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)", is of a family: its text holds that word, in any
// case. "lavapipe" means llvmpipe.
bool isOfFamily(const std::string& driver, const std::string& family);

// Says whether the first dotted number of the driver's text is in a range: comparisons separated by commas, each one of
// >=, >, <=, <, = before a version. Parts that the range does not name are not compared: 25.0.7 is "=25" and "<=25".
// Throws std::invalid_argument for a range that cannot be read.
bool isInVersions(const std::string& driver, const std::string& range);

}  // namespace speculum
