#pragma once

#include <cstddef>
#include <string_view>

namespace speculum {

// The place after the string that starts at `start` with a quotation mark, or after what an unfinished one spans.
size_t endOfTomlString(std::string_view toml, size_t start);

// The line of the first dotted key or table header with more than 32 parts, or 0. The TOML library limits the nesting
// of values but not the parts of a key, makes a table of each, and takes one of them apart inside the other: a hundred
// thousand parts overflow the stack.
int lineOfTooDeepKey(std::string_view toml);

// The line of the first character beyond ASCII outside strings and comments, where TOML has none, or 0. The TOML
// library (3.3) decides whether such a character is blank with a table that has no entry for most of them, which leaves
// what it does undefined.
int lineOfStrayCharacter(std::string_view toml);

}  // namespace speculum
