#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace speculum {

// `text`, or where that is wider than `room` "..." with as much of its end as fits: names of passes differ there.
// `widthOf` is in the units of `room`. UTF-8.
std::string endThatFits(const std::string& text, float room, const std::function<float(std::string_view)>& widthOf);

}  // namespace speculum
