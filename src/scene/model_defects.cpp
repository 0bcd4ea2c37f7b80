#include "scene/model_defects.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "platform/text.hpp"

namespace speculum {

void ModelDefects::add(const std::filesystem::path& file, int line, std::string_view key, std::string_view kind,
                       std::string_view detail) {
  const auto known = std::ranges::find_if(entries_, [&](const Entry& entry) {
    return entry.kind == kind && entry.key == key && entry.file.native() == file.native();
  });
  if (known != entries_.end()) {
    ++known->count;
    return;
  }
  // A damaged file may have tokens of any length.
  constexpr size_t most = 200;
  std::string text = fmt::format("{}:{}: {}: ", file.string(), line, key);
  text += fmt::format(fmt::runtime(kind), std::string(detail.substr(0, most)) + (detail.size() > most ? "..." : ""));
  entries_.push_back({file, std::string(key), kind, oneLine(std::move(text))});
}

std::vector<std::string> ModelDefects::report() {
  std::vector<std::string> texts;
  for (Entry& entry : entries_) {
    if (entry.count > 1) {
      entry.text += fmt::format(" (and {} more)", entry.count - 1);
    }
    spdlog::warn("{}", entry.text);
    texts.push_back(std::move(entry.text));
  }
  entries_.clear();
  return texts;
}

}  // namespace speculum
