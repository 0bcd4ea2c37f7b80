#pragma once

namespace speculum {

enum class Theme { dark, light };

// What the user chose last, kept beside the layout in userConfigDir(); dark to begin with.
Theme savedTheme();
void saveTheme(Theme theme);

// Colours and sizes of the current ImGui context. `scale`: 1 for 96 dots an inch.
void applyLook(Theme theme, float scale);

}  // namespace speculum
