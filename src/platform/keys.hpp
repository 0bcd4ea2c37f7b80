#pragma once

#include <string_view>

namespace speculum {

// Keys with a meaning in the program, by GLFW's codes; keys that print something have the code of that character.
enum class Key {
  unknown = -1,
  space = ' ',
  comma = ',',
  period = '.',
  a = 'A',
  b,
  c,
  d,
  e,
  f,
  g,
  m = 'M',
  n,
  o,
  q = 'Q',
  r,
  s,
  w = 'W',
  x,
  y,
  z,
  leftBracket = '[',
  rightBracket = ']',
  escape = 256,
  enter,
  tab,
  del = 261,
  f1 = 290,
  f2,
  f10 = 299,
  f11,
  f12,
  leftShift = 340,
  leftControl,
  rightShift = 344,
  rightControl
};
// Returns the meaning of the key at `place` of an American keyboard with the character `printed` on it (empty: none or
// unknown). The six keys that fly are identified by their place; all others, and all keys with Control, by their
// character, or by their place if the character is not Latin. `printedWhereFlying` are the characters on the six fly
// keys: a shortcut whose character is one of them has the key that it has on an American keyboard, unless another
// shortcut is printed on that key.
Key meaningOfKey(Key place, std::string_view printed, bool control, std::string_view printedWhereFlying);

}  // namespace speculum
