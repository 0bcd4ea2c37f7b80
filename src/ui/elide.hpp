#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace speculum {

// Returns `text` (UTF-8) or, if it is wider than `room`, as much of its start and end as fits with "..." between.
// `widthOf` is in the units of `room`.
std::string endsThatFit(const std::string& text, float room, const std::function<float(std::string_view)>& widthOf);

// Returns `text` with line breaks in place of spaces, so that no line is wider than `room` unless one word is. A number
// and its % are one word.
std::string brokenAtSpaces(std::string text, float room, const std::function<float(std::string_view)>& widthOf);

}  // namespace speculum
