#include "accuracy/html_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace speculum {

namespace {

constexpr std::string_view replacementCharacter = "\uFFFD";

std::string formatted(const char* format, int precision, double value) {
  char text[512];
  std::snprintf(text, sizeof(text), format, precision, value);
  return text;
}

std::string superscript(int number) {
  static constexpr std::string_view digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : std::to_string(number)) {
    text += c == '-' ? "⁻" : digits[c - '0'];
  }
  return text;
}

// Bytes of the UTF-8 sequence that `text` begins with, 0 if it is none (overlong forms and surrogates are none).
size_t sequenceLength(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<uint8_t>(text[i]); };
  const uint8_t first = byte(0);
  const size_t length = first < 0x80                     ? 1
                        : first >= 0xc2 && first <= 0xdf ? 2
                        : (first & 0xf0) == 0xe0         ? 3
                        : first >= 0xf0 && first <= 0xf4 ? 4
                                                         : 0;
  if (length == 0 || text.size() < length) {
    return 0;
  }
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) {
      return 0;
    }
  }
  const bool overlong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xf0 && byte(1) < 0x90);
  const bool beyond = (first == 0xed && byte(1) > 0x9f) || (first == 0xf4 && byte(1) > 0x8f);
  return overlong || beyond ? 0 : length;
}

std::string_view escapedCharacter(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

bool isControl(char c) {
  return (static_cast<uint8_t>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7f;
}

}  // namespace

std::string escapeHtml(std::string_view text) {
  std::string escaped;
  for (size_t i = 0; i < text.size();) {
    const size_t length = sequenceLength(text.substr(i));
    if (length == 0 || isControl(text[i])) {
      escaped += replacementCharacter;
    } else if (const std::string_view reference = escapedCharacter(text[i]); !reference.empty()) {
      escaped += reference;
    } else {
      escaped += text.substr(i, length);
    }
    i += std::max<size_t>(1, length);
  }
  return escaped;
}

std::string base64(std::span<const uint8_t> bytes) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < count ? bytes[i + k] : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      text += k <= count ? alphabet[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

std::string numberText(double value, int significant) {
  if (std::isnan(value)) {
    return "–";
  }
  if (std::isinf(value)) {
    return value > 0.0 ? "∞" : "−∞";
  }
  if (value == 0.0) {
    return "0";
  }
  const std::string rounded = formatted("%.*e", significant - 1, value);
  const size_t e = rounded.find('e');
  const int exponent = std::atoi(rounded.c_str() + e + 1);
  if (exponent >= -4 && exponent < 6) {
    return withMinusSign(formatted("%.*f", std::max(0, significant - 1 - exponent), value));
  }
  return withMinusSign(rounded.substr(0, e)) + "×10" + superscript(exponent);
}

std::string powerText(double value) {
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
  const std::string mantissa = formatted("%.*g", 6, value / std::pow(10.0, exponent));
  const std::string power = "10" + superscript(exponent);
  return mantissa == "1" ? power : withMinusSign(mantissa) + "×" + power;
}

std::string withMinusSign(std::string number) {
  if (number.starts_with('-')) {
    number.replace(0, 1, "−");
  }
  return number;
}

int characterCount(std::string_view text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string fixedText(double value, int decimals) {
  return std::isfinite(value) ? withMinusSign(formatted("%.*f", decimals, value)) : numberText(value);
}

int columnDecimals(const std::vector<double>& values) {
  int decimals = 0;
  for (const double value : values) {
    if (std::isfinite(value) && value != 0.0) {
      decimals = std::max(decimals, 2 - static_cast<int>(std::floor(std::log10(std::abs(value)))));
    }
  }
  return std::min(decimals, 6);
}

std::string exactText(double value) {
  char text[64];
  return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

std::string shellWord(std::string_view text) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./=,:+-@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string_view::npos) {
    return std::string(text);
  }
  std::string quoted = "'";
  for (const char c : text) {
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return quoted + "'";
}

std::string setOptions(const std::vector<SettingChange>& changes) {
  std::string text;
  for (const SettingChange& change : changes) {
    text += (text.empty() ? "--set " : " --set ") + shellWord(change.key + "=" + change.value);
  }
  return text;
}

}  // namespace speculum
