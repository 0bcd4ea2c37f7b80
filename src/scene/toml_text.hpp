#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

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
