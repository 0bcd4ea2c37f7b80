#include "accuracy/setting_values.hpp"

#include <nlohmann/json.hpp>

namespace speculum {

namespace {

using Key = std::string_view;

constexpr Key valueKinds = "a number, true, false, a string or an array of those is needed";

std::string valueText(const TableReader& table, Key key, const toml::node& node) {
  if (const toml::value<std::string>* text = node.as_string()) {
    return text->get();
  }
  if (!node.is_number() && !node.is_boolean()) {
    table.failAt(node, key, "is " + std::string(typeName(node)), valueKinds);
  }
  if (const toml::value<bool>* flag = node.as_boolean()) {
    return flag->get() ? "true" : "false";
  }
  return node.is_integer() ? std::to_string(node.as_integer()->get())
                           : nlohmann::json(node.as_floating_point()->get()).dump();
}

}  // namespace

std::vector<std::string> valueTexts(const TableReader& table, Key key, const toml::node& node) {
  std::vector<std::string> texts;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& element : *array) {
      texts.push_back(valueText(table, key, element));
    }
  } else {
    texts.push_back(valueText(table, key, node));
  }
  if (texts.empty()) {
    table.failAt(node, key, "is empty", "at least one value is needed");
  }
  return texts;
}

}  // namespace speculum
