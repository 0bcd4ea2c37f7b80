// Random input to the window, at least for SPECULUM_SECONDS: no crash, no validation message, nothing is leaked, and
// afterwards it still works.
#include <malloc.h>

#include <iostream>

#include "sampling.hpp"
#include "window/journeys_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr unsigned defaultSeed = 20261121;  // SPECULUM_SEED takes another

const std::vector<std::string> keys{
    "w",       "a",         "s",      "d",      "q",      "e",           "f",           "b",
    "g",       "t",         "r",      "space",  "period", "comma",       "bracketleft", "Tab",
    "F1",      "F11",       "F12",    "Escape", "Delete", "ctrl+d",      "ctrl+z",      "ctrl+y",
    "ctrl+s",  "Return",    "Up",     "Down",   "Left",   "Right",       "shift+F12",   "bracketright",
    "shift+b", "shift+F10", "ctrl+q", "n",      "F2",     "ctrl+shift+s"};

class RandomInput : public Journey {
 protected:
  RandomInput() : Journey(wallScene, checked()), random_(seed()) { connectGamepad(); }

  static Options checked() {
    Options options;
    options.settings = {{"debug.check_finite", "true"}};
    return options;
  }
  static unsigned seed() {
    const char* given = std::getenv("SPECULUM_SEED");
    const unsigned seed = given ? static_cast<unsigned>(std::strtoul(given, nullptr, 10)) : defaultSeed;
    std::cout << "seed " << seed << "\n";
    return seed;
  }
  int upTo(int last) { return std::uniform_int_distribution<int>(0, last)(random_); }
  std::string place(int size) { return std::to_string(upTo(size)); }

  // Aims half of the presses at a widget: most of the others hit the picture, which is large.
  std::vector<std::string> pointerTo() {
    const auto& widgets = demo_->panels().widgets;
    if (!widgets.empty() && upTo(1) == 0) {
      const PixelRect rect = widgets[upTo(static_cast<int>(widgets.size()) - 1)].second;
      return {"mousemove", "--window", window_, std::to_string(rect.x + upTo(std::max(0, rect.width))),
              std::to_string(rect.y + rect.height / 2)};
    }
    const VkExtent2D size = demo_->window().size();
    return {"mousemove", "--window", window_, place(static_cast<int>(size.width)),
            place(static_cast<int>(size.height))};
  }
  // Ignores errors, because a window manager may be slower than the next event.
  void send(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "xdotool");
    runProcess(arguments);
  }
  void connectGamepad() {
    demo_->setGamepadSource([this] { return pad_; });
  }
  void reopen() {
    messages_ += demo_->device().validationMessages();
    nonFinite_ += demo_->nonFinite();
    demo_.reset();
    start();
    if (shown().edit.prompt == Prompt::recovery) {
      demo_->apply(DiscardChanges{});
    }
    connectGamepad();
  }
  void stepped(int steps) {
    for (int i = 0; i < steps; ++i) {
      if (!demo_->step()) {
        reopen();
        ++closed_;
      }
    }
  }
  // Descriptors and heap of the process after the window was closed and opened again.
  struct Usage {
    long descriptors = 0;
    size_t bytes = 0;  // of the heap
  };
  Usage reopenAndMeasure() {
    reopen();
    demo_->renderer().waitIdle();
    const auto heap = mallinfo2();
    return {std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}), heap.uordblks + heap.hblkhd};
  }
  void resize() {
    const int most = fullTests() ? 1200 : 600;
    const int width = 1 + upTo(most);
    demo_->window().resize(width, 1 + upTo(2 * most / 3));
  }
  void act() {
    switch (upTo(11)) {
      case 0:
        return resize();
      case 1:
        demo_->window().iconify();
        stepped(2);
        return demo_->window().restore();
      case 2:
        pad_ = GamepadState{.leftX = upTo(2) - 1.0f, .leftY = upTo(2) - 1.0f, .rightX = upTo(2) - 1.0f};
        pad_->buttons[upTo(static_cast<int>(pad_->buttons.size()) - 1)] = upTo(1) == 1;
        return;
      case 3:
        pad_.reset();
        return;
      case 4:
      case 5:
        return send({"click", std::to_string(4 + upTo(1))});
      case 6:
      case 7:
      case 8:
        return send({"key", "--window", window_, keys[upTo(static_cast<int>(keys.size()) - 1)]});
      default:
        send(pointerTo());
        stepped(2);
        const std::string button = std::to_string(1 + upTo(2));
        const bool shift = upTo(2) == 0;
        if (shift) {
          send({"keydown", "Shift_L"});
        }
        send({"mousedown", button});
        stepped(2);
        if (upTo(1) == 0) {
          send(pointerTo());
          stepped(2);
        }
        send({"mouseup", button});
        if (shift) {
          send({"keyup", "Shift_L"});
        }
    }
  }

  std::mt19937 random_;
  std::optional<GamepadState> pad_;
  int closed_ = 0;
  int messages_ = 0;  // of windows that were closed
  uint64_t nonFinite_ = 0;
};

TEST_F(RandomInput, LeavesAWindowThatWorks) {
  const char* given = std::getenv("SPECULUM_SECONDS");
  const double seconds = given ? std::strtod(given, nullptr) : 0.0;
  const int enough = fullTests() ? 250 : 25;
  int actions = 0;
  Usage first;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (actions < enough || Clock::now() < end) {
    if (actions == enough / 5) {
      first = reopenAndMeasure();
    }
    act();
    stepped(3);
    ++actions;
    ASSERT_EQ(demo_->device().validationMessages() + messages_, 0) << "after " << actions << " actions";
  }
  std::cout << actions << " actions, " << demo_->framesDrawn() << " frames, closed " << closed_ << " times\n";
  pad_.reset();
  const Usage last = reopenAndMeasure();
  std::cout << first.bytes / 1'000'000 << " MB at first, " << last.bytes / 1'000'000 << " MB at last\n";
  EXPECT_EQ(last.descriptors, first.descriptors);
  constexpr size_t keptOfADevice = 1'000'000;  // by the validation layer, 0.6 MB as measured
  EXPECT_LT(last.bytes, first.bytes + first.bytes / 10 + 5'000'000 + (closed_ + 1) * keptOfADevice);
  EXPECT_EQ(nonFinite_, 0u);
  const int frames = demo_->framesDrawn();
  resize();
  // Repeats this, because the window manager may not have hidden the iconified window yet.
  for (int i = 0; i < 100 && demo_->framesDrawn() == frames; ++i) {
    demo_->window().restore();
    stepped(2);
  }
  EXPECT_GT(demo_->framesDrawn(), frames);
}

}  // namespace
}  // namespace speculum
