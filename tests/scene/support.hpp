#pragma once

#include <string>

#include "error_message.hpp"
#include "log_capture.hpp"
#include "scene/obj_loader.hpp"
#include "scene/scene_loader.hpp"
#include "temporary_folder.hpp"

namespace speculum {

// A broken input and the error that it gives.
struct Fault {
  const char* name;
  std::string text;
  const char* place;    // LINE: key:
  const char* message;  // what is wrong or what would be right
};

inline void PrintTo(const Fault& fault, std::ostream* stream) {
  *stream << fault.name;
}

// The shortest scene file that is valid.
inline const std::string usualCamera = "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\n";

inline constexpr const char* triangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

// Returns the error message about `text` as a scene file beside "triangle.obj", without the file's name.
inline std::string sceneFaultOf(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("triangle.obj", triangleObj);
  const std::filesystem::path file = folder.write("scene.toml", text);
  const std::string message = messageOf<InputError>([&] { loadScene(file); });
  const std::string prefix = file.string() + ":";
  return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
}

inline std::string repeated(const std::string& part, size_t count) {
  std::string text;
  for (size_t i = 0; i < count; ++i) {
    text += part;
  }
  return text;
}

}  // namespace speculum
