// Keys and gamepad buttons, and the list of them.
#include "ui/input_map.hpp"
#include "picture_support.hpp"
#include "platform/files.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using testing_support::sourceFile;

TEST(InputMap, KeysMeanTheirCommands) {
  EXPECT_TRUE(std::holds_alternative<Undo>(*commandOf({.key = Key::z, .pressed = true, .control = true})));
  EXPECT_TRUE(
      std::holds_alternative<Redo>(*commandOf({.key = Key::z, .pressed = true, .shift = true, .control = true})));
  EXPECT_FALSE(commandOf({.key = Key::z, .pressed = true}));
  EXPECT_FALSE(commandOf({.key = Key::unknown, .pressed = true}));
  EXPECT_FALSE(commandOf({.key = Key::f, .pressed = true, .alt = true})) << "a menu is meant";
  const auto side = [](bool shift) {
    return std::get<LookFromMirror>(*commandOf({.key = Key::b, .pressed = true, .shift = shift})).side;
  };
  EXPECT_EQ(side(false), MirrorSide::back);
  EXPECT_EQ(side(true), MirrorSide::front);
  EXPECT_TRUE(commandOf({.key = Key::f, .pressed = true, .shift = true})) << "shift means nothing here";
  const auto withPanel = [](bool shift) {
    return std::get<TakeScreenshot>(*commandOf({.key = Key::f12, .pressed = true, .shift = shift})).withPanel;
  };
  EXPECT_FALSE(withPanel(false));
  EXPECT_TRUE(withPanel(true));
}

TEST(InputMap, MenusShowTheKeysOfTheirCommands) {
  EXPECT_STREQ(keysOf(ToggleRecording{false}), "F10");
  EXPECT_STREQ(keysOf(ToggleRecording{true}), "Shift+F10");
  EXPECT_STREQ(keysOf(TakeScreenshot{true}), "Shift+F12");
  EXPECT_STREQ(keysOf(LookFromMirror{MirrorSide::front}), "Shift+B");
  EXPECT_STREQ(keysOf(ToggleSplit{SplitStart::naive}), "Shift+C");
  EXPECT_STREQ(keysOf(Redo{}), "Ctrl+Shift+Z") << "the first of two";
}

TEST(InputMap, PrintedLettersAreKnown) {
  for (const ShortcutGroup& group : shortcutGroups()) {
    for (const Shortcut& shortcut : group.shortcuts) {
      const int code = static_cast<int>(shortcut.key);
      if (shortcut.command && code > ' ' && code < 128) {
        const std::string printed(1, static_cast<char>(std::tolower(code)));
        EXPECT_EQ(meaningOfKey(shortcut.key, printed, shortcut.control, ""), shortcut.key) << shortcut.keys;
      }
    }
  }
}

TEST(InputMap, OnlySomeKeysRepeat) {
  EXPECT_TRUE(commandOf({.key = Key::period, .pressed = true, .repeat = true}));
  EXPECT_TRUE(commandOf({.key = Key::n, .pressed = true, .repeat = true}));
  EXPECT_FALSE(commandOf({.key = Key::space, .pressed = true, .repeat = true}));
  EXPECT_FALSE(commandOf({.key = Key::d, .pressed = true, .repeat = true, .control = true}));
}

TEST(InputMap, GamepadButtonsMeanTheirCommands) {
  EXPECT_EQ(std::get<StepTime>(commandOf(GamepadButton::leftBumper).command).steps, -1);
  EXPECT_EQ(std::get<StepTime>(commandOf(GamepadButton::rightBumper).command).steps, 1);
  EXPECT_EQ(std::get<LookFromMirror>(commandOf(GamepadButton::y).command).side, MirrorSide::back);
  EXPECT_TRUE(std::holds_alternative<TakeScreenshot>(commandOf(GamepadButton::rightStick).command));
  EXPECT_TRUE(commandOf(GamepadButton::start).inPanels);
  EXPECT_FALSE(commandOf(GamepadButton::a).inPanels);
}

TEST(InputMap, KeysInTheDocsAreInTheList) {
  std::string list;
  for (const ShortcutGroup& group : shortcutGroups()) {
    for (const Shortcut& shortcut : group.shortcuts) {
      std::string row = "    " + std::string(shortcut.keys);
      row.resize(26, ' ');
      list.append(row).append(shortcut.help).append("\n");
    }
  }
  const std::string docs = readText(sourceFile("docs/window.md"));
  const size_t begin = docs.find("## Which keys come first?");
  ASSERT_NE(begin, std::string::npos);
  std::istringstream section(docs.substr(begin, docs.find("\n## ", begin) - begin));
  int rows = 0;
  for (std::string line; std::getline(section, line);) {
    if (line.starts_with("    ")) {
      EXPECT_TRUE(contains(list, line + "\n")) << line;
      ++rows;
    }
  }
  EXPECT_GT(rows, 0);
}

}  // namespace
}  // namespace speculum
