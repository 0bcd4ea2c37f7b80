#pragma once

namespace speculum {

enum class Theme { dark, light };

// Sets colors and sizes of the current ImGui context. `scale`: 1 for 96 dots an inch.
void applyTheme(Theme theme, float scale);

}  // namespace speculum
