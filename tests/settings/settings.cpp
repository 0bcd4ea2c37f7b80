#include <nlohmann/json.hpp>

#include "error_message.hpp"
#include "scene/scene_loader.hpp"
#include "settings/setting_fields.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

TEST(Settings, EveryDescriptionIsWhole) {
  for (const SettingField& field : settingFields()) {
    EXPECT_FALSE(field.text.empty() || field.cost.empty() || std::string(field.label).empty()) << field.key;
    const std::string words = std::string(field.label) + std::string(field.text) + std::string(field.cost);
    EXPECT_FALSE(contains(words, "olour")) << "keys say color";
    EXPECT_FALSE(contains(field.text, ". ") || contains(field.cost, ". ")) << field.key << ": one sentence each";
    EXPECT_EQ(std::ranges::count(settingFields(), field.key, &SettingField::key), 1) << field.key;
    const auto* integer = std::get_if<IntegerSetting>(&field.kind);
    EXPECT_TRUE(!integer || integer->powersOfTwo || field.slider) << field.key << ": the panel has no widget for it";
    EXPECT_TRUE(!field.needs || !settingValue(Settings(), field.needs->key).empty()) << field.key;
  }
}

// Returns settings in which one has another value: the next of a list, or a number a little above.
Settings changed(const SettingField& field) {
  Settings settings;
  for (const char* value : {"true", "false", "2", "0.5", "1", "32", "oblique", "aces", "trilinear", "image",
                            "environment", "map", "256", "software", "0.1,0.2,0.3", "queue", "rays"}) {
    if (!setSetting(settings, field.key, value) && !sameSetting(field, settings, Settings())) {
      return settings;
    }
  }
  ADD_FAILURE() << field.key << ": add a value that it takes";
  return settings;
}

TEST(Settings, EachValueStandsInItsOwnMember) {
  Settings all;
  for (const SettingField& field : settingFields()) {
    const Settings settings = changed(field);
    const Settings before = all;
    copySetting(field, settings, all);
    for (const SettingField& other : settingFields()) {
      EXPECT_EQ(sameSetting(other, settings, Settings()), other.key != field.key) << field.key << " and " << other.key;
      EXPECT_EQ(sameSetting(other, all, before), other.key != field.key) << field.key << " and " << other.key;
    }
    EXPECT_TRUE(sameSetting(field, all, settings)) << field.key;
    EXPECT_NE(settingsKey(settings), settingsKey(Settings())) << field.key;
  }
}

TEST(Settings, PicturesFollowFromWhatChangesThem) {
  const std::set<std::string_view> othersThanImages{"reflection.update_interval",
                                                    "reflection.skip_unchanged",
                                                    "view.samples",
                                                    "view.accumulate_error",
                                                    "view.exposure",
                                                    "view.tone_map",
                                                    "view.continuous"};
  const std::set<std::string_view> othersThanMainView{"view.accumulate_error", "view.exposure", "view.tone_map"};
  for (const SettingField& field : settingFields()) {
    const Settings settings = changed(field);
    const bool quality = field.key.starts_with("quality.") || field.key.starts_with("ui.");
    EXPECT_EQ(sameMirrorImages(settings, Settings()),
              quality || othersThanImages.contains(field.key) || field.key.starts_with("debug."))
        << field.key;
    EXPECT_EQ(sameMainView(settings, Settings()), quality || othersThanMainView.contains(field.key)) << field.key;
  }
}

struct BadValue {
  const char* key;
  const char* value;
  const char* message;
};

class BadSettings : public testing::TestWithParam<BadValue> {};

TEST_P(BadSettings, NameTheRemedy) {
  Settings settings;
  const auto problem = setSetting(settings, GetParam().key, GetParam().value);
  ASSERT_TRUE(problem);
  EXPECT_EQ(*problem, GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    All, BadSettings,
    testing::Values(
        BadValue{"reflection.scale", "5", "reflection.scale: '5' is not a number in range (0.125 .. 4)"},
        BadValue{"reflection.scale", "nan", "reflection.scale: 'nan' is not a number in range (0.125 .. 4)"},
        BadValue{"reflection.scale", "", "reflection.scale: '' is not a number in range (0.125 .. 4)"},
        BadValue{"reflection.samples", "3",
                 "reflection.samples: '3' is not one of the whole numbers allowed (1 2 4 8)"},
        BadValue{"reflection.max_depth", "1.5",
                 "reflection.max_depth: '1.5' is not one of the whole numbers allowed (0 .. 32)"},
        BadValue{"reflection.clip", "maybe",
                 "reflection.clip: 'maybe' is not a choice (clip_distance | oblique | none)"},
        BadValue{"view.wireframe", "1", "view.wireframe: '1' is not a choice (true | false)"},
        BadValue{"view.clear_color", "1,2",
                 "view.clear_color: '1,2' is not a color (three linear values 0 .. 1e38, such as 0.1,0.2,0.3)"},
        BadValue{"view.clear_color", "1,2,3,4",
                 "view.clear_color: '1,2,3,4' is not a color (three linear values 0 .. 1e38, such as 0.1,0.2,0.3)"},
        BadValue{"view.exposur", "1", "view.exposur: unknown setting (did you mean 'view.exposure'?)"}));

TEST(Settings, UnknownKeyListsAll) {
  Settings settings;
  const std::string problem = setSetting(settings, "zzz", "1").value_or("");
  for (const SettingField& field : settingFields()) {
    EXPECT_TRUE(contains(problem, field.key)) << field.key;
  }
}

TEST(Settings, SceneErrorsNameFileAndLine) {
  Scene scene;
  scene.file = "room.toml";
  scene.settings = {{"reflection.max_depth", "2", 4}, {"view.exposure", "0.5", 5}};
  const Settings settings = settingsOf(scene);
  EXPECT_EQ(settings.reflection.maxDepth, 2);
  EXPECT_EQ(settings.view.exposure, 0.5);

  scene.settings = {{"reflection.scale", "1", 7, true}};
  EXPECT_EQ(messageOf<InputError>([&] { settingsOf(scene); }),
            "room.toml:7: reflection.scale: a string is the wrong type (0.125 .. 4)");
}

TEST(Settings, ColorsHaveTheSameFormsEverywhere) {
  Scene scene;
  for (const bool quoted : {true, false}) {
    scene.settings = {{"view.clear_color", quoted ? "0.5, 0,1" : "[0.5,0.0,1.0]", 7, quoted}};
    EXPECT_EQ(settingsOf(scene).view.clearColor, glm::dvec3(0.5, 0.0, 1.0));
    scene.settings[0].value = quoted ? "" : "[]";
    EXPECT_EQ(settingsOf(scene).view.clearColor, std::nullopt);
  }
}

TEST(SettingHelp, NamesEffectRangeAndCost) {
  EXPECT_EQ(settingHelp("view.samples"),
            "Samples a pixel of the main view. Shading grows with it.\nview.samples: 1 2 4 8");
  EXPECT_EQ(settingHelp("no.such_key"), "");
}

TEST(SettingHelp, NoFigureIsOfAnotherDevice) {
  for (const SettingField& field : settingFields()) {
    EXPECT_FALSE(contains(settingHelp(field.key), "H200")) << field.key;
    EXPECT_FALSE(contains(field.cost, " ms")) << field.key;
  }
}

}  // namespace
}  // namespace speculum
