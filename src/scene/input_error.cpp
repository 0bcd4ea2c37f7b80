#include "scene/input_error.hpp"

#include <algorithm>

#include "platform/files.hpp"
#include "platform/text.hpp"

namespace speculum {

std::string oneLine(std::string message) {
  constexpr size_t kLongest = 4000;
  constexpr size_t kEnd = 1000;
  if (message.size() > kLongest) {
    size_t begin = kLongest - kEnd;
    size_t end = message.size() - kEnd;
    while (begin > 0 && continuesCharacter(message[begin])) {
      --begin;
    }
    while (end < message.size() && continuesCharacter(message[end])) {
      ++end;
    }
    message.replace(begin, end - begin, " ... ");
  }
  std::ranges::replace_if(
      message, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
  return message;
}

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
