#include "core/window.hpp"

namespace speculum {

namespace {

// In the order of the keys from Key::w to Key::rightBracket.
constexpr std::string_view printedKeys = "wasdqebmrfgnyz,.[]";

bool flies(Key key) {
  return key >= Key::w && key <= Key::e;
}

}  // namespace

Key keyMeant(Key place, std::string_view printed, bool control) {
  const bool latin = printed.size() == 1 && static_cast<unsigned char>(printed[0]) < 128;
  if (!latin || (flies(place) && !control)) {
    return place;
  }
  const char upper = printed[0];
  const char letter = upper >= 'A' && upper <= 'Z' ? static_cast<char>(upper - 'A' + 'a') : upper;
  if (const size_t at = printedKeys.find(letter); at != std::string_view::npos) {
    return static_cast<Key>(static_cast<size_t>(Key::w) + at);
  }
  const bool isLetter = place >= Key::w && place <= Key::z;
  return isLetter ? Key::unknown : place;
}

}  // namespace speculum
