#include "ui/theme.hpp"

#include <imgui.h>
#include <spdlog/spdlog.h>

#include <string_view>

#include "platform/files.hpp"
#include "platform/folders.hpp"

namespace speculum {

namespace {

constexpr std::string_view lightText = "light\n";
constexpr std::string_view darkText = "dark\n";

std::filesystem::path themeFile() {
  return userConfigDir() / "theme";
}

}  // namespace

Theme savedTheme() {
  const auto content = readFileIfAny(themeFile());
  const std::string_view text =
      content ? std::string_view(reinterpret_cast<const char*>(content->data()), content->size()) : darkText;
  return text == lightText ? Theme::light : Theme::dark;
}

void saveTheme(Theme theme) {
  const std::string_view text = theme == Theme::light ? lightText : darkText;
  if (!storeFile(themeFile(), text)) {
    spdlog::warn("{} cannot be written: the theme is not remembered", themeFile().string());
  }
}

void applyTheme(Theme theme, float scale) {
  ImGuiStyle style;
  theme == Theme::light ? ImGui::StyleColorsLight(&style) : ImGui::StyleColorsDark(&style);
  style.WindowRounding = 6.0f;
  style.FrameRounding = 3.0f;
  style.GrabRounding = 3.0f;
  style.Colors[ImGuiCol_WindowBg].w = 0.88f;
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace speculum
