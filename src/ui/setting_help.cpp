#include "ui/setting_help.hpp"

#include "frame/setting_fields.hpp"

namespace speculum {

std::string settingHelp(std::string_view key) {
  const SettingField* field = findSettingField(key);
  if (!field) {
    return "";
  }
  return std::string(key) + "\n" + std::string(field->text) + " (" + settingRangeWithUnit(*field) + ")\n\n" +
         std::string(field->cost);
}

bool differs(const Settings& a, const Settings& b, std::string_view key) {
  return !sameSetting(*findSettingField(key), a, b);
}

void resetSetting(Settings& settings, const Settings& from, std::string_view key) {
  copySetting(*findSettingField(key), from, settings);
}

}  // namespace speculum
