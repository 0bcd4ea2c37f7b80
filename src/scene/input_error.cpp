#include "scene/input_error.hpp"

#include "platform/files.hpp"
#include "platform/text.hpp"

namespace speculum {

void throwInputError(const std::filesystem::path& file, int line, std::string_view key, std::string_view wrong,
                     std::string_view right) {
  std::string message = file.string() + ":" + std::to_string(line) + ": ";
  message.append(key).append(": ").append(wrong).append(" (").append(right).append(")");
  throw InputError(oneLine(std::move(message)));
}

std::string readInputText(const std::filesystem::path& file, std::string_view right, uintmax_t most) {
  try {
    return readText(file, most);
  } catch (const FileError& error) {
    throwInputError(file, 1, "file", error.problem(), right);
  }
}

}  // namespace speculum
