// What people are told of settings, and the way back to the scene's values.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "test_paths.hpp"
#include "ui/setting_help.hpp"

namespace speculum {
namespace {

TEST(SettingHelp, SaysOfEverySettingWhatItCosts) {
  for (const SettingInfo& info : settingInfos()) {
    if (info.key != "debug.omit_barrier") {
      EXPECT_FALSE(settingCost(info.key).empty()) << info.key;
      EXPECT_NE(settingHelp(info.key).find(info.help), std::string::npos) << info.key;
    }
  }
  EXPECT_EQ(settingHelp("no.such_key"), "");
}

TEST(SettingHelp, FiguresAreThoseThatWereMeasured) {
  std::ifstream file(sourceDir() / "docs/measurements.md");
  std::stringstream measurements;
  measurements << file.rdbuf();
  const std::regex figure("[0-9]+\\.[0-9]+");
  int figures = 0;
  for (const SettingInfo& info : settingInfos()) {
    const std::string text(settingCost(info.key));
    for (std::sregex_iterator it(text.begin(), text.end(), figure), end; it != end; ++it, ++figures) {
      EXPECT_NE(measurements.str().find(it->str()), std::string::npos) << info.key << ": " << it->str();
    }
  }
  EXPECT_GT(figures, 20);
}

TEST(SettingHelp, ResetsOneSettingAndNoOther) {
  Settings scene;
  scene.reflection.maxDepth = 7;
  scene.view.exposure = 0.1;
  Settings changed = scene;
  changed.reflection.maxDepth = 2;
  changed.view.exposure = 0.3;
  changed.view.clearColor = glm::dvec3(0.5);
  changed.effects.roughLookup = RoughLookup::image;
  for (const char* key : {"reflection.max_depth", "view.exposure", "view.clear_color", "effects.rough_lookup"}) {
    Settings one = changed;
    ASSERT_TRUE(differs(one, scene, key)) << key;
    resetSetting(one, scene, key);
    for (const SettingInfo& info : settingInfos()) {
      EXPECT_EQ(differs(one, scene, info.key), info.key != key && differs(changed, scene, info.key)) << info.key;
    }
  }
}

}  // namespace
}  // namespace speculum
