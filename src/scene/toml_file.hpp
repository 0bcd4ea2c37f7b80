#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string_view>

namespace speculum {

// Reads the text of a file of at most 16 MiB; `kind` names it in messages, such as "scene file". Throws InputError.
std::string readTomlText(const std::filesystem::path& file, std::string_view kind);

// Parses `text` as the content of `file`. Throws InputError.
toml::table parseToml(const std::filesystem::path& file, std::string_view text, std::string_view kind);

// Reads a TOML file of at most 16 MiB; `kind` names it in messages, such as "scene file". Throws InputError.
toml::table readToml(const std::filesystem::path& file, std::string_view kind);

// Returns the line of the first dotted key or table header with more than 32 parts, or 0. The TOML library limits the
// nesting of values but not the parts of a key: it nests a table for each, and destroying a hundred thousand overflows
// the stack.
int lineOfTooDeepKey(std::string_view toml);

// Returns the line of the first character beyond ASCII outside strings and comments, where TOML has none, or 0. The
// TOML library (3.3) looks such characters up in a table that lacks most of them, which is undefined behaviour.
int lineOfStrayCharacter(std::string_view toml);

}  // namespace speculum
