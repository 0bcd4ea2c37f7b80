#pragma once

#include "scene/scene_fields.hpp"

namespace speculum {

template <Described Node>
void changeFields(Node& node);

inline double otherNumber(const Range& range, double floor, double value) {
  const double other = 0.75 * value + 0.123456789012345;
  if (other < floor) {
    return floor + other;
  }
  return range.contains(other) ? other : range.contains(0.5 * value) ? 0.5 * value : 0.5 * (range.low + range.high);
}

// Changes the value of a field to another one that a scene file may have.
template <typename Field, typename Value>
void changeValue(const Field& field, Value& value) {
  if constexpr (Described<Value>) {
    changeFields(value);
  } else if constexpr (IsOptional<Value>::value) {
    typename Value::value_type other = value.value_or(typename Value::value_type{});
    changeValue(field, other);
    value = other;
  } else if constexpr (std::is_same_v<Value, bool>) {
    value = !value;
  } else if constexpr (std::is_same_v<Value, int>) {
    value = field.range.contains(value + 1) ? value + 1 : static_cast<int>(field.range.low);
  } else if constexpr (std::is_same_v<Value, double>) {
    value = otherNumber(field.range, field.floor, value);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    value += " \"x\" \\ Ü";
  } else if constexpr (std::is_enum_v<Value>) {
    value = static_cast<Value>((static_cast<size_t>(value) + 1) % choicesOf(value).size());
  } else if constexpr (std::is_same_v<Value, std::vector<glm::dvec3>>) {
    for (glm::dvec3& point : value) {
      point += glm::dvec3(0.125, 0.25, 0.5);
    }
  } else {
    for (int i = 0; i < Value::length(); ++i) {
      value[i] = otherNumber(field.range, field.floor, value[i]);
    }
  }
}

// Changes every field that a user can edit and that applies to the node, so that the node stays valid.
template <Described Node>
void changeFields(Node& node) {
  forEachField<Node>([&](const auto& field) {
    if (field.appliesTo(node) && field.key != "model" && field.key != "reflectance_map") {
      changeValue(field, node.*field.member);
    }
  });
}

}  // namespace speculum
