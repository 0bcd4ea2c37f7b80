#include "edit/scene_keys.hpp"

#include "scene/toml_text.hpp"

namespace speculum {

namespace {

template <typename Field, typename Value>
std::string textOf(const Field& field, const Value& value) {
  if constexpr (std::is_same_v<Value, glm::dvec3>) {
    if (field.uniform && value.x == value.y && value.y == value.z) {
      return tomlText(value.x);
    }
  }
  if constexpr (std::is_enum_v<Value>) {
    return tomlText(choicesOf(value)[static_cast<size_t>(value)]);
  } else {
    return tomlText(value);
  }
}

template <Described Node>
void addKeys(const Node& node, const std::string& table, std::vector<KeyText>& keys) {
  const Node usual{};
  forEachField<Node>([&](const auto& field) {
    if (!field.appliesTo(node)) {
      return;
    }
    using Value = typename std::decay_t<decltype(field)>::Value;
    const std::string key(field.key);
    const Value& value = node.*field.member;
    if constexpr (Described<Value>) {
      addKeys(value, key, keys);
    } else if constexpr (!IsOptional<Value>::value) {
      const std::string text = textOf(field, value);
      const bool omissible = !field.required && !field.alwaysSaved && text == textOf(field, usual.*field.member);
      keys.push_back({table, key, text, omissible});
    } else if constexpr (Described<typename Value::value_type>) {
      if (value) {
        addKeys(*value, key, keys);
      }
    } else if (value) {
      keys.push_back({table, key, textOf(field, *value), false});
    }
  });
}

}  // namespace

template <Described Node>
std::vector<KeyText> keyTexts(const Node& node) {
  std::vector<KeyText> keys;
  addKeys(node, "", keys);
  return keys;
}

template std::vector<KeyText> keyTexts(const Environment& node);
template std::vector<KeyText> keyTexts(const CameraSpec& node);
template std::vector<KeyText> keyTexts(const Object& node);
template std::vector<KeyText> keyTexts(const PointLight& node);
template std::vector<KeyText> keyTexts(const Mirror& node);
template std::vector<KeyText> keyTexts(const Bookmark& node);

}  // namespace speculum
