#include "scene/input_error.hpp"

#include <algorithm>
#include <string>

#include "platform/file_io.hpp"

namespace speculum {

std::string oneLine(std::string message) {
  std::replace_if(
      message.begin(), message.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
  return message;
}

void throwInputError(const std::filesystem::path& file, int line, std::string_view key, std::string_view wrong,
                     std::string_view right) {
  std::string message = file.string() + ":" + std::to_string(line) + ": ";
  message.append(key).append(": ").append(wrong).append(" (").append(right).append(")");
  throw InputError(oneLine(std::move(message)));
}

std::string readInputText(const std::filesystem::path& file, std::string_view right) {
  try {
    const std::vector<uint8_t> bytes = readFileBytes(file);
    return std::string(bytes.begin(), bytes.end());
  } catch (const std::runtime_error& failure) {
    const std::string message = failure.what();
    const size_t start = file.string().size() + 2;
    throwInputError(file, 1, "file", message.substr(start, message.rfind(" (") - start), right);
  }
}

}  // namespace speculum
