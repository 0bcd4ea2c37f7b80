#include "scene/toml_text.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "platform/text.hpp"

namespace speculum {

std::string tomlText(double value) {
  const double size = std::abs(value);
  // An integer has no negative zero.
  if (value == std::trunc(value) && size < 1e15 && !(value == 0.0 && std::signbit(value))) {
    return std::to_string(static_cast<int64_t>(value));
  }
  if (value == 0.0) {
    return "-0.0";
  }
  std::array<char, 64> text;
  const bool plain = size >= 1e-5 && size < 1e15;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 plain ? std::chars_format::fixed : std::chars_format::scientific)
                       .ptr;
  return {text.data(), end};
}

std::string tomlText(int value) {
  return std::to_string(value);
}

std::string tomlText(const glm::dvec2& value) {
  return fmt::format("[{}, {}]", tomlText(value.x), tomlText(value.y));
}

std::string tomlText(const glm::dvec3& value) {
  return fmt::format("[{}, {}, {}]", tomlText(value.x), tomlText(value.y), tomlText(value.z));
}

std::string tomlText(const std::vector<glm::dvec3>& values) {
  std::string text;
  for (const glm::dvec3& value : values) {
    text += (text.empty() ? "" : ", ") + tomlText(value);
  }
  return "[" + text + "]";
}

std::string tomlText(bool value) {
  return value ? "true" : "false";
}

std::string tomlText(std::string_view value) {
  std::string text = "\"";
  for (size_t i = 0; i < value.size(); ++i) {
    const char c = value[i];
    if (c == '"' || c == '\\') {
      text.append(1, '\\').append(1, c);
    } else if (c == '\n') {
      text += "\\n";
    } else if (c == '\t') {
      text += "\\t";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      text += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else if (const size_t length = firstCharacter(value.substr(i)).second; length > 0) {
      text += value.substr(i, length);
      i += length - 1;
    } else {
      text += utf8(value.substr(i, 1));
    }
  }
  return text + "\"";
}

std::string tomlKey(std::string_view key) {
  const bool bare = !key.empty() && std::ranges::all_of(key, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? std::string(key) : tomlText(key);
}

}  // namespace speculum
