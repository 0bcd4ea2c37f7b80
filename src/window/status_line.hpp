#pragma once

#include <spdlog/spdlog.h>

#include <chrono>
#include <functional>
#include <string>
#include <utility>

#include "platform/text.hpp"
#include "ui/shown.hpp"

namespace speculum {

// The result of the last action, shown for some seconds, and below it how the picture is drawn.
class StatusLine {
 public:
  // Shows the result and logs it. `holds`: says whether the state that the text is about lasts; the text ends with it.
  void set(const std::string& text, std::function<bool()> holds = {}) {
    spdlog::info("{}", text);
    show(text, std::move(holds));
  }
  void show(const std::string& text, std::function<bool()> holds = {}) {
    holds_ = std::move(holds);
    shown_.text = shortened(text, 1000);  // names may be of any length
    since_ = Clock::now();
    isWarning_ = false;
  }
  // Shows a warning. Another scene clears it, because it may be about what the last scene asks for.
  void warn(const std::string& text) {
    show(text);
    isWarning_ = true;
  }
  void sceneChanged() {
    if (isWarning_) {
      clear();
    }
  }
  void setPicture(const std::string& text) { shown_.picture = text; }
  void clear() { shown_.text.clear(); }
  // Once a frame. `savesPicture`: the window is being saved as a picture, with the status line where it is shown.
  void update(bool savesPicture) {
    shown_.savesPicture = savesPicture;
    shown_.age = age();
    if (statusAlpha(shown_.age) <= 0.0f || (holds_ && !holds_())) {
      clear();
    }
  }
  bool fades() const { return !shown_.text.empty() && statusAlpha(age()) < 1.0f; }
  const ShownStatus& shown() const { return shown_; }

 private:
  using Clock = std::chrono::steady_clock;
  double age() const { return std::chrono::duration<double>(Clock::now() - since_).count(); }

  ShownStatus shown_;
  std::function<bool()> holds_;
  bool isWarning_ = false;
  Clock::time_point since_;
};

}  // namespace speculum
