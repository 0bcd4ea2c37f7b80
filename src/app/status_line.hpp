#pragma once

#include <spdlog/spdlog.h>

#include <chrono>
#include <string>

#include "ui/views.hpp"

namespace speculum {

// The result of the last action, shown for some seconds, and below it how the picture is drawn.
class StatusLine {
 public:
  void set(const std::string& text) {  // and logs it
    spdlog::info("{}", text);
    show(text);
  }
  void show(const std::string& text) {
    view_.text = text;
    since_ = Clock::now();
    isWarning_ = false;
  }
  // Shows a warning, which goes when another scene comes: it may be about what the scene asks for.
  void warn(const std::string& text) {
    show(text);
    isWarning_ = true;
  }
  void sceneChanged() {
    if (isWarning_) {
      clear();
    }
  }
  void setPicture(const std::string& text) { view_.picture = text; }
  void clear() { view_.text.clear(); }
  // Once a frame. `savesPicture`: the window is being saved as a picture.
  void update(bool savesPicture) {
    view_.savesPicture = savesPicture;
    view_.age = age();
    if (statusAlpha(view_.age) <= 0.0f) {
      clear();
    }
  }
  bool fades() const { return !view_.text.empty() && statusAlpha(age()) < 1.0f; }
  const StatusView& view() const { return view_; }

 private:
  using Clock = std::chrono::steady_clock;
  double age() const { return std::chrono::duration<double>(Clock::now() - since_).count(); }

  StatusView view_;
  bool isWarning_ = false;
  Clock::time_point since_;
};

}  // namespace speculum
