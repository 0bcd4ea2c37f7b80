// Tooltips of settings, and the way back to the scene's values.
#include <gtest/gtest.h>

#include "frame/setting_fields.hpp"

namespace speculum {
namespace {

TEST(SettingHelp, NamesEffectRangeAndCost) {
  EXPECT_EQ(settingHelp("view.samples"),
            "Samples a pixel of the main view. Shading grows with it.\nview.samples: 1 2 4 8");
  EXPECT_EQ(settingHelp("no.such_key"), "");
}

TEST(SettingHelp, NoFigureIsOfAnotherDevice) {
  for (const SettingField& field : settingFields()) {
    EXPECT_EQ(settingHelp(field.key).find("H200"), std::string::npos) << field.key;
    EXPECT_EQ(field.cost.find(" ms"), std::string_view::npos) << field.key;
  }
}

TEST(SettingHelp, ResetChangesOneSettingOnly) {
  Settings scene;
  scene.reflection.maxDepth = 7;
  scene.view.exposure = 0.1;
  Settings changed = scene;
  changed.reflection.maxDepth = 2;
  changed.view.exposure = 0.3;
  changed.view.clearColor = glm::dvec3(0.5);
  changed.effects.roughLookup = ReflectionSource::image;
  for (const char* key : {"reflection.max_depth", "view.exposure", "view.clear_color", "effects.rough_lookup"}) {
    Settings one = changed;
    ASSERT_FALSE(sameSetting(*findSettingField(key), one, scene)) << key;
    copySetting(*findSettingField(key), scene, one);
    for (const SettingField& field : settingFields()) {
      EXPECT_EQ(sameSetting(field, one, scene), field.key == key || sameSetting(field, changed, scene)) << field.key;
    }
  }
}

}  // namespace
}  // namespace speculum
