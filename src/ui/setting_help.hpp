#pragma once

#include <string>
#include <string_view>

#include "frame/settings.hpp"

namespace speculum {

// Tooltip of a setting: key, what it does, its range, what it costs; empty for an unknown key.
std::string settingHelp(std::string_view key);

// The next two take keys of settingFields() only.
bool differs(const Settings& a, const Settings& b, std::string_view key);
// Gives the setting the value that it has in `from`.
void resetSetting(Settings& settings, const Settings& from, std::string_view key);

}  // namespace speculum
