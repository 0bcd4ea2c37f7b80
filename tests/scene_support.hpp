#pragma once

#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <sstream>
#include <string>

#include "scene/obj_loader.hpp"
#include "scene/scene_loader.hpp"
#include "temporary_folder.hpp"

namespace speculum {

// Collects the log, one message a line, instead of the default logger while it lives.
class LogCapture {
 public:
  LogCapture() : previous_(spdlog::default_logger()) {
    auto logger =
        std::make_shared<spdlog::logger>("capture", std::make_shared<spdlog::sinks::ostream_sink_mt>(stream_));
    logger->set_pattern("%l: %v");
    spdlog::set_default_logger(logger);
  }
  ~LogCapture() { spdlog::set_default_logger(previous_); }
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;

  std::string text() const { return stream_.str(); }

 private:
  std::ostringstream stream_;
  std::shared_ptr<spdlog::logger> previous_;
};

// The message of the InputError that `action` throws.
template <typename Action>
std::string inputErrorOf(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError was thrown";
}

// A broken input and what its error says.
struct Fault {
  const char* name;
  std::string text;
  const char* place;    // LINE: key:
  const char* message;  // what is wrong or what would be right
};

inline void PrintTo(const Fault& fault, std::ostream* stream) {
  *stream << fault.name;
}

// The least that a scene file may hold.
inline const std::string kCamera = "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\n";

inline constexpr const char* kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

inline std::string repeated(const std::string& part, size_t count) {
  std::string text;
  for (size_t i = 0; i < count; ++i) {
    text += part;
  }
  return text;
}

}  // namespace speculum
