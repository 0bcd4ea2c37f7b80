#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

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

// Return values as TOML. Numbers are the shortest text without an exponent that reads back to the same double (within
// 1e-5 .. 1e15; beyond, the shortest one with an exponent), written as integers where that loses nothing.
std::string tomlText(double value);
std::string tomlText(int value);
std::string tomlText(const glm::dvec2& value);
std::string tomlText(const glm::dvec3& value);
std::string tomlText(const std::vector<glm::dvec3>& values);
std::string tomlText(bool value);
std::string tomlText(std::string_view value);  // in quotation marks and UTF-8

// Returns the key bare where TOML allows that, else in quotation marks.
std::string tomlKey(std::string_view key);

}  // namespace speculum
