#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "settings/settings.hpp"

namespace speculum {

// Finds the value of a setting within Settings.
template <typename T>
struct SettingMember {
  T& (*in)(Settings& settings);

  T& of(Settings& settings) const { return in(settings); }
  const T& of(const Settings& settings) const { return in(const_cast<Settings&>(settings)); }
};

// Each kind of setting reads its value with get() and writes it with set().
template <typename T>
struct MemberSetting {
  SettingMember<T> value;

  const T& get(const Settings& settings) const { return value.of(settings); }
  void set(Settings& settings, const T& wanted) const { value.of(settings) = wanted; }
};
// Numbers from low to high.
struct NumberSetting : MemberSetting<double> {
  double low = 0.0;
  double high = 1.0;
};
// A number from low to high, or "auto", which has no value.
struct AutomaticSetting : MemberSetting<std::optional<double>> {
  double low = 0.0;
  double high = 1.0;
};
struct IntegerSetting : MemberSetting<int> {
  int low = 0;
  int high = 1;
  bool powersOfTwo = false;
  bool automatic = false;  // takes "auto" too, which is 0
};
struct BooleanSetting : MemberSetting<bool> {};
struct ChoiceSetting {
  int (*get)(const Settings& settings);  // index into names
  void (*set)(Settings& settings, int index);
  std::span<const std::string_view> names;
};
struct ColorSetting : MemberSetting<std::optional<glm::dvec3>> {};  // linear
struct TextSetting : MemberSetting<std::string> {
  std::string_view meaning;
};
using SettingKind = std::variant<NumberSetting, AutomaticSetting, IntegerSetting, BooleanSetting, ChoiceSetting,
                                 ColorSetting, TextSetting>;

// The first part of a frame that a setting changes. Earlier parts are the same whatever the setting's value.
enum class FramePart { mirrorImages, mainView, display, none };

// Slider of the panel; without one, numbers are typed or chosen from a list.
struct SettingSlider {
  double low = 0.0;
  double high = 1.0;
  const char* format = "%.2f";
  bool logarithmic = true;
};

// Another setting and the value that it must have, or must not have, for a setting to have an effect.
struct SettingNeed {
  std::string_view key;
  std::string_view value;
  bool isOther = false;  // the setting must have another value
};

// Which values of a setting take less time. Numbers are compared by size, choices by their order, false is below true.
enum class Cheaper { neither, lower, higher };

// Values that the built-in sweeps `quick` and `full` try, separated by blanks, as --set takes them.
struct SweptValues {
  std::string_view quick;
  std::string_view full = quick;
};

// What a row of settingFields() says besides its member, key, range and texts, by name.
struct SettingTraits {
  std::string_view unit = {};
  FramePart changes = FramePart::mirrorImages;
  bool subject = false;  // chooses what is shown, not how well: no sweep varies it
  std::optional<SettingSlider> slider = std::nullopt;
  std::optional<SettingNeed> needs = std::nullopt;
  Cheaper cheaper = Cheaper::neither;
  // Returns the mean FLIP that the value adds to a picture of a scene with that many mirrors, on average over the
  // shipped scenes. Null: the error was not measured, or there is none.
  double (*error)(const Settings& settings, size_t mirrors) = nullptr;
  SweptValues swept = {};
};

// Describes a setting. `--set`, [settings] of scenes, JSON, comparisons, the panel, tooltips, `--help`, completion and
// docs/settings.md follow from it; the default is the member's in settings.hpp.
struct SettingField : SettingTraits {
  std::string_view key;
  SettingKind kind;
  const char* label;      // in the panel
  std::string_view text;  // what the setting does, one line
  std::string_view cost;  // what the setting costs or saves: no figures of a device that is not the user's
};

// Returns all settings, in the order of `--help`.
std::span<const SettingField> settingFields();
const SettingField* findSettingField(std::string_view key);  // null: no such key

// Returns the values that the setting takes, without its unit: "0.125 .. 4", "1 2 4 8", "clamp | aces".
std::string settingRange(const SettingField& field);
std::string settingRangeWithUnit(const SettingField& field);  // "texels, 0 .. 16"
// Returns the tooltip of a setting: what it does, what it costs, key and range; empty for an unknown key. `range`
// replaces settingRangeWithUnit().
std::string settingHelp(std::string_view key, const std::string& range = {});
bool sameSetting(const SettingField& field, const Settings& a, const Settings& b);
// Says whether the setting's value in `a` takes less time than that in `b`.
bool isCheaper(const SettingField& field, const Settings& a, const Settings& b);
void copySetting(const SettingField& field, const Settings& from, Settings& to);

}  // namespace speculum
