#include "platform/keys.hpp"

#include <cctype>

namespace speculum {

namespace {

constexpr std::string_view flyingKeys = "WASDQE";
constexpr std::string_view otherKeys = "BCMRFGNOXYZ,.[]";

bool isAmong(std::string_view characters, Key key) {
  const int code = static_cast<int>(key);
  return code > 0 && code < 128 && characters.find(static_cast<char>(code)) != std::string_view::npos;
}

}  // namespace

Key meaningOfKey(Key place, std::string_view printed, bool control, std::string_view printedWhereFlying) {
  const bool latin = printed.size() == 1 && static_cast<unsigned char>(printed[0]) < 128;
  if (!latin || (isAmong(flyingKeys, place) && !control)) {
    return place;
  }
  const auto meant = static_cast<Key>(std::toupper(static_cast<unsigned char>(printed[0])));
  if (isAmong(otherKeys, meant) || (control && isAmong(flyingKeys, meant))) {
    return meant;
  }
  const bool yields =
      isAmong(otherKeys, place) &&
      printedWhereFlying.find(static_cast<char>(std::tolower(static_cast<int>(place)))) != std::string_view::npos;
  if (yields && !control) {
    return place;
  }
  const bool isLetter = place >= Key::a && place <= Key::z;
  return isLetter ? Key::unknown : place;
}

}  // namespace speculum
