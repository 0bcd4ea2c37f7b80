#include "ui/input_map.hpp"

#include <array>
#include <concepts>
#include <map>
#include <string_view>
#include <utility>

namespace speculum {

namespace {

// Returns the key that has this name in the list of keys.
Key keyNamed(std::string_view name) {
  static const std::map<std::string_view, Key> words = {{"Space", Key::space}, {"Tab", Key::tab}, {"Del", Key::del},
                                                        {"Esc", Key::escape},  {"F1", Key::f1},   {"F2", Key::f2},
                                                        {"F10", Key::f10},     {"F11", Key::f11}, {"F12", Key::f12}};
  const auto word = words.find(name);
  return word != words.end() ? word->second : static_cast<Key>(name.front());  // Key has the codes of characters
}

Shortcut pointer(const char* keys, const char* help) {
  return {.keys = keys, .help = help};
}

// Takes the key from its name after the modifiers, as in "Ctrl+Shift+Z".
Shortcut key(const char* keys, const char* help, Command command, bool repeats = false) {
  const std::string_view names = keys;
  return {.keys = keys,
          .help = help,
          .key = keyNamed(names.substr(names.rfind('+') + 1)),
          .control = names.starts_with("Ctrl+"),
          .shift = names.find("Shift+") != std::string_view::npos,
          .repeats = repeats,
          .command = std::move(command)};
}

Shortcut repeated(const char* keys, const char* help, Command command) {
  return key(keys, help, std::move(command), true);
}

}  // namespace

std::span<const ShortcutGroup> shortcutGroups() {
  static const std::array<ShortcutGroup, 5> groups{
      {{"View",
        {pointer("Drag", "Orbit about the target, or look around in fly mode"), pointer("Drag middle or right", "Pan"),
         pointer("Wheel", "Zoom"), pointer("W A S D", "Move forward, left, back, right"),
         pointer("Q E", "Move down, up"), key("F", "Frame the selection, or the whole scene", FrameSelection{}),
         key("B", "Look from behind the selected mirror, or the largest", LookFromMirror{MirrorSide::back}),
         key("Shift+B", "Look out of that mirror", LookFromMirror{MirrorSide::front}),
         key("M", "Bookmark the view (saved with the scene)", AddBookmark{}),
         key("Shift+M", "Go to the next bookmark", GoToNextBookmark{}),
         key("C", "Compare two sets of settings (A | B), or end it", ToggleSplit{}),
         key("Shift+C", "Compare with the settings of most mirror demos", ToggleSplit{SplitStart::naive}),
         key("X", "Edit the settings of the other half", ChooseOtherHalf{})}},
       {"Time",
        {key("Space", "Pause or play", TogglePaused{}), repeated(".", "Step forward by 1/60 s", StepTime{1}),
         repeated(",", "Step back by 1/60 s", StepTime{-1}), key("[", "Halve the speed", MultiplyTimeSpeed{0.5}),
         key("]", "Double the speed", MultiplyTimeSpeed{2.0})}},
       {"Capture",
        {key("F12", "Save the picture", TakeScreenshot{false}),
         key("Shift+F12", "Save the picture with the panels", TakeScreenshot{true}),
         key("F10", "Start or stop recording frames", ToggleRecording{false}),
         key("Shift+F10", "Record frames with the panels", ToggleRecording{true})}},
       {"Edit",
        {pointer("Click", "Select, in mirrors too; click again for the mirror it is seen in"),
         pointer("Shift+click", "Add to the selection, or remove from it"),
         key("G", "Switch between move, rotate and scale handles (Ctrl while dragging: snap)", NextGizmoMode{}),
         repeated("N", "Select the next object, light or mirror", SelectNext{1}),
         repeated("Shift+N", "Select the previous one", SelectNext{-1}),
         key("Ctrl+D", "Duplicate", DuplicateSelected{}), key("Del", "Delete", RemoveSelected{}),
         repeated("Ctrl+Z", "Undo", Undo{}), repeated("Ctrl+Shift+Z", "Redo", Redo{}),
         repeated("Ctrl+Y", "Redo", Redo{}), key("Ctrl+N", "New scene", NewScene{}),
         key("Ctrl+O", "Open", AskWhatToOpen{}), key("Ctrl+S", "Save", Save{}),
         key("Ctrl+Shift+S", "Save as", AskWhereToSave{})}},
       {"Window",
        {key("F2", "Show or hide the inspector", ToggleInspector{}), key("F11", "Full screen", ToggleFullScreen{}),
         key("Tab", "Show or hide the panels", TogglePanel{}), pointer("Alt", "Go to the menus"),
         pointer("Ctrl+Tab", "Go to another panel"),
         pointer("Arrows", "Walk through the panel's widgets; Enter presses or types"),
         key("F1", "Show or hide this list", ToggleHelp{}),
         key("Esc", "Cancel the drag, close a menu, deselect, end A | B", Escape{}), key("Ctrl+Q", "Quit", Quit{})}}}};
  return groups;
}

std::span<const Shortcut> gamepadHelp() {
  static const std::array<Shortcut, 9> rows{
      {pointer("Left stick", "Move forward, back, left, right"), pointer("Triggers", "Move down, up"),
       pointer("Right stick", "Look around"), pointer("Direction pad", "Navigate the panels: A presses, B leaves"),
       pointer("A, B", "Frame the selection or the scene; orbit or fly"),
       pointer("Y, X", "Look from behind a mirror; look out of it"),
       pointer("Bumpers", "Step back or forward by 1/60 s"),
       pointer("Sticks pressed", "Left: reset the camera; right: save the picture"),
       pointer("Start, Back", "Pause or play; show or hide the panels")}};
  return rows;
}

std::optional<Command> commandOf(const KeyEvent& event) {
  const Shortcut* found = nullptr;
  for (const ShortcutGroup& group : shortcutGroups()) {
    for (const Shortcut& shortcut : group.shortcuts) {
      const bool matches = shortcut.command && !event.alt && shortcut.key == event.key &&
                           shortcut.control == event.control &&
                           (shortcut.shift == event.shift || (event.shift && !found));
      found = matches ? &shortcut : found;
    }
  }
  return found && (found->repeats || !event.repeat) ? found->command : std::nullopt;
}

namespace {

// Says whether two commands are of one type and have the same values. Values count only if the type can be compared.
bool isSame(const Command& a, const Command& b) {
  return a.index() == b.index() && std::visit(
                                       [&]<typename Kind>(const Kind& one) {
                                         if constexpr (std::equality_comparable<Kind>) {
                                           return one == std::get<Kind>(b);
                                         } else {
                                           return true;
                                         }
                                       },
                                       a);
}

}  // namespace

const char* keysOf(const Command& command) {
  for (const ShortcutGroup& group : shortcutGroups()) {
    for (const Shortcut& shortcut : group.shortcuts) {
      if (shortcut.command && isSame(*shortcut.command, command)) {
        return shortcut.keys;
      }
    }
  }
  return "";
}

GamepadCommand commandOf(GamepadButton button) {
  static const std::array<GamepadCommand, static_cast<size_t>(GamepadButton::count)> commands{
      {{FrameSelection{}},
       {ToggleCameraMode{}},
       {LookFromMirror{MirrorSide::front}},
       {LookFromMirror{MirrorSide::back}},
       {StepTime{-1}},
       {StepTime{1}},
       {TogglePanel{}, true},
       {TogglePaused{}, true},
       {ResetCamera{}},
       {TakeScreenshot{false}}}};
  return commands[static_cast<size_t>(button)];
}

}  // namespace speculum
