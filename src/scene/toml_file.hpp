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

}  // namespace speculum
