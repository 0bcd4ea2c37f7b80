#include "accuracy/html_page.hpp"

#include <nlohmann/json.hpp>

namespace speculum {

namespace {

// Returns JSON for an HTML script element: nothing in it can end the element or begin a comment.
std::string escapedForScript(const nlohmann::ordered_json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) {
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  }
  return text;
}

}  // namespace

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

std::string pageWithData(std::string_view page, const nlohmann::ordered_json& data) {
  constexpr std::string_view placeholder = "@DATA@";
  const size_t at = page.find(placeholder);
  return std::string(page.substr(0, at)) + escapedForScript(data) + std::string(page.substr(at + placeholder.size()));
}

}  // namespace speculum
