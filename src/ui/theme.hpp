#pragma once

namespace speculum {

enum class Theme { dark, light };

// The theme that the user chose last, kept beside the layout in userConfigDir(); dark to begin with.
Theme savedTheme();
void saveTheme(Theme theme);

// Sets colors and sizes of the current ImGui context. `scale`: 1 for 96 dots an inch.
void applyTheme(Theme theme, float scale);

}  // namespace speculum
