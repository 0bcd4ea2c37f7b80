#pragma once

#include <string>

namespace speculum {

// A thing of a scene as people see it: "mirror 'floor'", or "mirror 2" for one without a name.
std::string nameOf(const std::string& kind, const std::string& name, int index);

}  // namespace speculum
