#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

namespace speculum {

// Returns the bytes as base64 text: RFC 4648, with padding, without line breaks.
std::string base64(std::span<const uint8_t> bytes);

// Returns an HTML page with the data in the place of its "@DATA@", which stands in a script element.
std::string pageWithData(std::string_view page, const nlohmann::ordered_json& data);

}  // namespace speculum
