#pragma once

#include <string>
#include <string_view>

#include "frame/settings.hpp"

namespace speculum {

// What a setting costs or saves, in the figures of docs/measurements.md where there are any; empty for an unknown key.
std::string_view settingCost(std::string_view key);

// What people are told of a setting: key, what it does, its range, what it costs.
std::string settingHelp(std::string_view key);

bool differs(const Settings& a, const Settings& b, std::string_view key);
// Gives the setting the value that it has in `from`.
void resetSetting(Settings& settings, const Settings& from, std::string_view key);

}  // namespace speculum
