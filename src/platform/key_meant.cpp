#include "platform/window.hpp"

namespace speculum {

namespace {

// Characters of the keys from Key::w to Key::rightBracket; those that fly come first.
constexpr std::string_view printedKeys = "wasdqebmrfgnyz,.[]";
constexpr size_t flying = 6;

bool flies(Key key) {
  return key >= Key::w && key <= Key::e;
}

// The character that an American keyboard has there; 0 for keys without a meaning of their own.
char americanPrint(Key place) {
  return place >= Key::w && place <= Key::rightBracket
             ? printedKeys[static_cast<size_t>(place) - static_cast<size_t>(Key::w)]
             : '\0';
}

}  // namespace

Key keyMeant(Key place, std::string_view printed, bool control, std::string_view printedWhereFlying) {
  const bool latin = printed.size() == 1 && static_cast<unsigned char>(printed[0]) < 128;
  if (!latin || (flies(place) && !control)) {
    return place;
  }
  const char upper = printed[0];
  const char letter = upper >= 'A' && upper <= 'Z' ? static_cast<char>(upper - 'A' + 'a') : upper;
  const size_t at = printedKeys.find(letter);
  if (at != std::string_view::npos && (control || at >= flying)) {
    return static_cast<Key>(static_cast<size_t>(Key::w) + at);
  }
  const char own = americanPrint(place);
  if (own != '\0' && !control && printedWhereFlying.find(own) != std::string_view::npos) {
    return place;
  }
  const bool isLetter = place >= Key::w && place <= Key::z;
  return isLetter ? Key::unknown : place;
}

}  // namespace speculum
