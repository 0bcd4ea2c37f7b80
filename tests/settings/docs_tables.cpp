// The lists of settings and scene keys in docs/ follow from their descriptions. UPDATE_DOCS=1 in the environment
// rewrites them.
#include "platform/files.hpp"
#include "scene/scene_fields.hpp"
#include "scene/toml_file.hpp"
#include "settings/setting_fields.hpp"
#include "test_headers.hpp"
#include "test_paths.hpp"

namespace speculum {
namespace {

// Returns the setting's default, then its other values.
std::string settingValues(const SettingField& field) {
  const std::string value = settingValue(Settings(), field.key);
  const std::string usual = value.empty() ? "" : "`" + value + "`";
  if (std::holds_alternative<BooleanSetting>(field.kind)) {
    return usual;
  }
  if (const auto* choice = std::get_if<ChoiceSetting>(&field.kind)) {
    std::string names = usual;
    for (const std::string_view name : choice->names) {
      names += name == value ? "" : ", " + std::string(name);
    }
    return names;
  }
  return usual + (usual.empty() ? "" : ", ") + settingRangeWithUnit(field);
}

// Returns the list of a group's settings. What each costs is told by its tooltip.
std::string settingsList(std::string_view group) {
  std::string list;
  for (const SettingField& field : settingFields()) {
    if (field.key.starts_with(group)) {
      const std::string need = field.needs
                                   ? std::string(field.needs->isOther ? ", without `" : ", with `") +
                                         std::string(field.needs->key) + "=" + std::string(field.needs->value) + "`"
                                   : "";
      list +=
          "- `" + std::string(field.key) + "` (" + settingValues(field) + "): " + std::string(field.text) + need + "\n";
    }
  }
  return list;
}

// Returns a range without bounds of 1e9 and more, which stand in the page's list of limits.
std::string rangeText(Range range) {
  range.low = range.low <= -1e9 ? anyRange.low : range.low;
  range.high = range.high >= 1e9 ? anyRange.high : range.high;
  return range.shortText();
}

// What a field takes without saying so by its default.
template <typename Field>
std::string shape(const Field& field) {
  using Value = typename Field::Value;
  using Inner = decltype([] {
    if constexpr (IsOptional<Value>::value) {
      return typename Value::value_type();
    } else {
      return Value();
    }
  }());
  if constexpr (Described<Inner>) {
    return "table";
  } else if constexpr (std::is_enum_v<Inner>) {
    std::string names;
    for (const std::string_view name : choicesOf(Inner())) {
      names += (names.empty() ? "" : ", ") + tomlText(name);
    }
    return names;
  } else if constexpr (std::is_same_v<Inner, std::string>) {
    return "text";
  } else if constexpr (std::is_same_v<Inner, glm::dvec2>) {
    return "[width,height]";
  } else if constexpr (std::is_same_v<Inner, glm::dvec3>) {
    return field.color ? "[r,g,b]" : "[x,y,z]";
  } else if constexpr (std::is_same_v<Inner, std::vector<glm::dvec3>>) {
    return "[[x,y,z],...]";
  }
  return "number";
}

// Returns the value in a node without keys; nothing for a field without a default.
template <typename Field, typename Node>
std::string defaultText(const Field& field, const Node& node) {
  using Value = typename Field::Value;
  if constexpr (std::is_enum_v<Value>) {
    return tomlText(choicesOf(Value())[static_cast<size_t>(node.*field.member)]);
  } else if constexpr (!IsOptional<Value>::value && !Described<Value> &&
                       !std::is_same_v<Value, std::vector<glm::dvec3>>) {
    return tomlText(node.*field.member);
  }
  return "";
}

// Calls `visit` with each field, those of nested tables too, the node that holds its default, and the key's prefix.
template <Described Node, typename Visitor>
void forEachRow(const std::string& prefix, const Visitor& visit) {
  const Node node{};
  forEachField<Node>([&](const auto& field) {
    using Value = typename std::decay_t<decltype(field)>::Value;
    visit(field, node, prefix);
    const std::string within = prefix + std::string(field.key) + ".";
    if constexpr (Described<Value>) {
      forEachRow<Value>(within, visit);
    } else if constexpr (IsOptional<Value>::value) {
      if constexpr (Described<typename Value::value_type>) {
        forEachRow<typename Value::value_type>(within, visit);
      }
    }
  });
}

// Returns "required", the default or the shape of the value, then other choices, range and unit.
template <typename Field, typename Node>
std::string fieldValue(const Field& field, const Node& node) {
  using Value = typename Field::Value;
  std::string value = field.required ? "" : defaultText(field, node);
  value.erase(std::remove(value.begin(), value.end(), ' '), value.end());
  std::string text = field.required ? "required, " + shape(field) : value.empty() ? shape(field) : "`" + value + "`";
  const auto add = [&](const std::string& part) { text += (part.empty() ? "" : ", ") + part; };
  if constexpr (std::is_enum_v<Value>) {
    for (const std::string_view name : choicesOf(Value())) {
      add(tomlText(name) == value ? "" : tomlText(name));
    }
  }
  add(field.uniform ? "or a number" : "");
  add(rangeText(field.range));
  add(std::string(field.unit));
  return text;
}

template <Described Node>
std::string fieldsList() {
  std::string list;
  forEachRow<Node>("", [&](const auto& field, const auto& node, const std::string& prefix) {
    list += "- `" + prefix + std::string(field.key) + "` (" + fieldValue(field, node) +
            "): " + std::string(field.text) + "\n";
  });
  EXPECT_FALSE(contains(list, "olour")) << "keys say color";
  return list;
}

// Compares the part of a file between two lines with what it should be.
void expectPart(const std::filesystem::path& name, const std::string& first, const std::string& last,
                const std::string& expected) {
  const std::filesystem::path file = sourceDir() / name;
  std::string text = readText(file);
  const size_t mark = text.find(first + "\n");
  const size_t end = text.find(last, mark);
  ASSERT_TRUE(mark != std::string::npos && end != std::string::npos) << name << " lacks " << first;
  const size_t begin = mark + first.size() + 1;
  if (std::getenv("UPDATE_DOCS")) {
    std::ofstream(file) << text.replace(begin, end - begin, expected);
    return;
  }
  EXPECT_EQ(text.substr(begin, end - begin), expected)
      << name << ": run edit_tests --gtest_filter='Descriptions*' with UPDATE_DOCS=1";
}

void expectList(const std::string& page, const std::string& name, const std::string& list) {
  expectPart("docs/" + page, "<!--list " + name + "-->", "<!--end-->", "\n" + list + "\n");
}

TEST(Descriptions, MakeTheListOfSettings) {
  for (const std::string group : {"reflection", "view", "effects", "quality", "debug", "ui"}) {
    expectList("settings.md", group, settingsList(group + "."));
  }
}

TEST(Descriptions, MakeTheListsOfSceneKeys) {
  const std::string page = "scene_format.md";
  expectList(page, "environment", fieldsList<Environment>());
  expectList(page, "camera", fieldsList<CameraSpec>());
  expectList(page, "object", fieldsList<Object>());
  expectList(page, "light", fieldsList<PointLight>());
  expectList(page, "mirror", fieldsList<Mirror>());
  expectList(page, "bookmark", fieldsList<Bookmark>());
}

// Quotes a word for a fuzzer's dictionary.
std::string word(const std::string& text) {
  std::string word = "\"";
  for (const char c : text) {
    word += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  }
  return word + "\"\n";
}

TEST(Descriptions, MakeTheDictionaryOfTheFuzzers) {
  std::string words;
  std::set<std::string> known;
  const auto add = [&]<typename Node>(const Node&, const std::string& header) {
    words += word(header);
    forEachRow<Node>("", [&](const auto& field, const auto& node, const std::string& prefix) {
      const std::string key = prefix + std::string(field.key) + " = ";
      words += known.insert(key).second ? word(key + defaultText(field, node)) : "";
    });
  };
  add(Environment(), "[environment]");
  add(CameraSpec(), "[camera]");
  add(Object(), "[[object]]");
  add(PointLight(), "[[light]]");
  add(Mirror(), "[[mirror]]");
  add(Bookmark(), "[[bookmark]]");
  words += word("[settings]");
  for (const SettingField& field : settingFields()) {
    const bool number = std::holds_alternative<NumberSetting>(field.kind) ||
                        std::holds_alternative<IntegerSetting>(field.kind) ||
                        std::holds_alternative<BooleanSetting>(field.kind);
    const std::string value = settingValue(Settings(), field.key);
    words += word(tomlText(field.key) + " = " + (number ? value : tomlText(value)));
  }
  expectPart("tests/fuzz/dictionaries/scene.dict", "# From the descriptions of fields and settings.",
             "# Values and shapes.", words);
}

}  // namespace
}  // namespace speculum
