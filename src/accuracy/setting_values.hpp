#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/table_reader.hpp"

namespace speculum {

// Returns the values of a key of `table` as --set takes them; a plain value counts as a list of one. Throws InputError.
std::vector<std::string> valueTexts(const TableReader& table, std::string_view key, const toml::node& node);

}  // namespace speculum
