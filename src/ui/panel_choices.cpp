#include "ui/panel_choices.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "platform/files.hpp"
#include "platform/folders.hpp"

namespace speculum {

namespace {

constexpr std::string_view openWord = "open";
constexpr std::string_view closedWord = "closed";
constexpr std::string_view percentWord = "percent";
constexpr std::string_view themeWord = "theme";
constexpr std::string_view lightWord = "light";

std::filesystem::path choicesFile() {
  return userConfigDir() / "panels";
}

}  // namespace

PanelChoices savedPanelChoices() {
  PanelChoices choices;
  std::istringstream lines(readTextIfAny(choicesFile(), 1u << 16));
  std::string word;
  std::string value;
  while (lines >> word >> value) {
    for (const PanelName& panel : rememberedPanels) {
      if (value == panel.name && (word == openWord || word == closedWord)) {
        choices.*panel.open = word == openWord;
      }
    }
    if (word == themeWord) {
      choices.theme = value == lightWord ? Theme::light : Theme::dark;
    }
    if (word == percentWord) {
      choices.percent = std::clamp(std::atoi(value.c_str()), 50, 300);
    }
  }
  return choices;
}

void savePanelChoices(const PanelChoices& choices) {
  std::string text = fmt::format("{} {}\n", percentWord, choices.percent);
  text += choices.theme == Theme::light ? fmt::format("{} {}\n", themeWord, lightWord) : "";
  for (const PanelName& panel : rememberedPanels) {
    const bool open = choices.*panel.open;
    const bool usual = open == PanelChoices().*panel.open;
    text += usual ? "" : fmt::format("{} {}\n", open ? openWord : closedWord, panel.name);
  }
  if (!storeFile(choicesFile(), text, Links::follow)) {
    spdlog::warn("{} cannot be written: the choices of the panel are not remembered", choicesFile().string());
  }
}

}  // namespace speculum
