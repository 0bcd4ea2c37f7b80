#pragma once

#include <optional>
#include <span>
#include <vector>

#include "platform/window.hpp"
#include "ui/commands.hpp"

namespace speculum {

// A key or a movement of the pointer, with its command or effect in the window.
struct Shortcut {
  const char* keys;  // as the list of keys shows it
  const char* help;
  Key key = Key::unknown;
  bool control = false;
  bool shift = false;
  bool repeats = false;  // while the key is held
  std::optional<Command> command = std::nullopt;
};
struct ShortcutGroup {
  const char* name;
  std::vector<Shortcut> shortcuts;
};
std::span<const ShortcutGroup> shortcutGroups();
std::span<const Shortcut> gamepadHelp();

// Returns the keys of the first shortcut that sends such a command, like "Ctrl+S"; empty if there is none.
const char* keysOf(const Command& command);

// Returns the command of a key that goes down. Ignores Shift for keys without a command of their own with Shift.
std::optional<Command> commandOf(const KeyEvent& event);

struct GamepadCommand {
  Command command;
  bool inPanels = false;  // also while the panels are navigated
};
GamepadCommand commandOf(GamepadButton button);

}  // namespace speculum
