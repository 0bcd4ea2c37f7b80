#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace speculum {

// `text`, or where that is wider than `room` as much of its start and end as fits with "..." between. `widthOf` is in
// the units of `room`. UTF-8.
std::string endsThatFit(const std::string& text, float room, const std::function<float(std::string_view)>& widthOf);

// `text` with line breaks in place of spaces, so that no line is wider than `room` unless one word is.
std::string brokenAtSpaces(std::string text, float room, const std::function<float(std::string_view)>& widthOf);

}  // namespace speculum
