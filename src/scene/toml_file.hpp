#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string_view>

namespace speculum {

// The content of a TOML file of at most 16 MiB; `kind` says what it is to people, such as "scene file". Throws
// InputError.
toml::table readToml(const std::filesystem::path& file, std::string_view kind);

}  // namespace speculum
