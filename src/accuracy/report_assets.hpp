#pragma once

#include <string_view>

namespace speculum {

// Style sheet and script of the report, whole, without the tags around them.
std::string_view reportStyle();
std::string_view reportScript();

}  // namespace speculum
