#pragma once

#include <string>

#include "scene/scene.hpp"

namespace speculum {

// Says whether a text that chooses a camera is for parseCamera(): it begins like a number. Any other text is the name
// of a bookmark.
bool meansPoints(const std::string& text);

// Parses position:target[:up[:FOV]], such as "0,1,4:0,1,0", into a bookmark without a name. Throws
// std::invalid_argument for any other text.
Bookmark parseCamera(const std::string& text);

}  // namespace speculum
