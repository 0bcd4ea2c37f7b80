#include "ui/input_map.hpp"

#include <array>

namespace speculum {

namespace {

Shortcut pointer(const char* keys, const char* help) {
  return {.keys = keys, .help = help};
}

Shortcut plain(const char* keys, const char* help, Key key, Command command) {
  return {.keys = keys, .help = help, .key = key, .command = std::move(command)};
}

Shortcut withShift(Shortcut shortcut) {
  shortcut.shift = true;
  return shortcut;
}

Shortcut withControl(Shortcut shortcut) {
  shortcut.control = true;
  return shortcut;
}

Shortcut repeated(Shortcut shortcut) {
  shortcut.repeats = true;
  return shortcut;
}

}  // namespace

std::span<const ShortcutGroup> shortcutGroups() {
  static const std::array<ShortcutGroup, 5> groups{
      {{"View",
        {pointer("drag", "Orbit about the target, or look around in fly mode"), pointer("drag middle or right", "Pan"),
         pointer("wheel", "Zoom"), pointer("W A S D", "Move forward, left, back, right"),
         pointer("Q E", "Move down, up"),
         plain("F", "Frame the selection, or the whole scene", Key::f, FrameSelection{}),
         plain("B", "Look from behind the selected mirror, or the largest in the picture", Key::b,
               LookFromMirror{MirrorSide::back}),
         withShift(plain("Shift+B", "Look out of that mirror", Key::b, LookFromMirror{MirrorSide::front})),
         plain("M", "Bookmark the view (saved with the scene)", Key::m, AddBookmark{}),
         withShift(plain("Shift+M", "Go to the next bookmark", Key::m, GoToNextBookmark{}))}},
       {"Time",
        {plain("Space", "Pause or play", Key::space, TogglePaused{}),
         repeated(plain(".", "Step forward by 1/60 s", Key::period, StepTime{1})),
         repeated(plain(",", "Step back by 1/60 s", Key::comma, StepTime{-1})),
         plain("[", "Halve the speed", Key::leftBracket, MultiplyTimeSpeed{0.5}),
         plain("]", "Double the speed", Key::rightBracket, MultiplyTimeSpeed{2.0})}},
       {"Capture",
        {plain("F12", "Save a screenshot", Key::f12, TakeScreenshot{true}),
         withShift(plain("Shift+F12", "Save a screenshot without the panels", Key::f12, TakeScreenshot{false})),
         plain("F10", "Start or stop recording frames", Key::f10, ToggleRecording{true}),
         withShift(plain("Shift+F10", "Record frames without the panels", Key::f10, ToggleRecording{false}))}},
       {"Edit",
        {pointer("click", "Select, in mirrors too; click again for the mirror it is seen in"),
         pointer("Shift+click", "Add to the selection, or remove from it"),
         plain("G", "Switch between move, rotate and scale handles (Ctrl while dragging: snap)", Key::g,
               NextGizmoMode{}),
         repeated(plain("N", "Select the next object, light or mirror", Key::n, SelectNext{1})),
         repeated(withShift(plain("Shift+N", "Select the previous one", Key::n, SelectNext{-1}))),
         withControl(plain("Ctrl+D", "Duplicate", Key::d, DuplicateSelected{})),
         plain("Del", "Delete", Key::del, RemoveSelected{}),
         repeated(withControl(plain("Ctrl+Z", "Undo", Key::z, Undo{}))),
         repeated(withControl(withShift(plain("Ctrl+Shift+Z", "Redo", Key::z, Redo{})))),
         repeated(withControl(plain("Ctrl+Y", "Redo", Key::y, Redo{}))),
         withControl(plain("Ctrl+N", "New scene", Key::n, NewScene{})),
         withControl(plain("Ctrl+O", "Open", Key::o, AskWhatToOpen{})),
         withControl(plain("Ctrl+S", "Save", Key::s, Save{})),
         withControl(withShift(plain("Ctrl+Shift+S", "Save as", Key::s, AskWhereToSave{})))}},
       {"Window",
        {plain("F2", "Show or hide the inspector", Key::f2, ToggleInspector{}),
         plain("F11", "Full screen", Key::f11, ToggleFullScreen{}),
         plain("Tab", "Show or hide the panels", Key::tab, TogglePanel{}),
         pointer("arrows", "Walk through the panel's widgets; Space presses"),
         plain("F1", "Show or hide this list", Key::f1, ToggleHelp{}),
         plain("Esc", "Cancel the drag, deselect, close the top window", Key::escape, Escape{}),
         withControl(plain("Ctrl+Q", "Quit", Key::q, Quit{}))}}}};
  return groups;
}

std::span<const Shortcut> gamepadHelp() {
  static const std::array<Shortcut, 9> rows{
      {pointer("left stick", "Move forward, back, left, right"), pointer("triggers", "Move down, up"),
       pointer("right stick", "Look around"), pointer("direction pad", "Navigate the panels: A presses, B leaves"),
       pointer("A, B", "Frame the selection or the scene; orbit or fly"),
       pointer("Y, X", "Look from behind a mirror; look out of it"),
       pointer("bumpers", "Step back or forward by 1/60 s"),
       pointer("sticks pressed", "Left: reset the camera; right: screenshot"),
       pointer("Start, Back", "Pause or play; show or hide the panels")}};
  return rows;
}

std::optional<Command> commandOf(const KeyEvent& event) {
  const Shortcut* found = nullptr;
  for (const ShortcutGroup& group : shortcutGroups()) {
    for (const Shortcut& shortcut : group.shortcuts) {
      const bool matches = shortcut.command && shortcut.key == event.key && shortcut.control == event.control &&
                           (shortcut.shift == event.shift || (event.shift && !found));
      found = matches ? &shortcut : found;
    }
  }
  return found && (found->repeats || !event.repeat) ? found->command : std::nullopt;
}

const char* keysOf(const Command& command) {
  for (const ShortcutGroup& group : shortcutGroups()) {
    for (const Shortcut& shortcut : group.shortcuts) {
      if (shortcut.command && shortcut.command->index() == command.index()) {
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
       {TakeScreenshot{true}}}};
  return commands[static_cast<size_t>(button)];
}

}  // namespace speculum
