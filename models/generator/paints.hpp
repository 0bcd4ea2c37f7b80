#pragma once

#include "model.hpp"

// The palette of all models; linear RGB. Metals keep some diffuse color, or they would be black away from highlights.
namespace speculum::generator::paints {

inline const Paint kGold{"gold", {0.42, 0.26, 0.075}, {0.55, 0.38, 0.13}, 48.0};
inline const Paint kBronze{"bronze", {0.20, 0.105, 0.05}, {0.34, 0.20, 0.10}, 36.0};
inline const Paint kSilver{"silver", {0.33, 0.34, 0.36}, {0.50, 0.50, 0.52}, 90.0};
inline const Paint kPorcelain{"porcelain", {0.78, 0.76, 0.72}, {0.05, 0.05, 0.05}, 220.0};
inline const Paint kIvory{"ivory", {0.72, 0.62, 0.46}, {0.05, 0.05, 0.05}, 90.0};
inline const Paint kEbony{"ebony", {0.022, 0.019, 0.018}, {0.07, 0.07, 0.07}, 110.0};
inline const Paint kWhiteMarble{"white_marble", {0.86, 0.84, 0.80}, {0.05, 0.05, 0.05}, 140.0, {}, "marble_white.png"};
inline const Paint kGreenMarble{"green_marble", {0.85, 0.85, 0.85}, {0.06, 0.06, 0.06}, 160.0, {}, "marble_green.png"};
inline const Paint kPlaster{"plaster", {0.70, 0.66, 0.60}, {0.0, 0.0, 0.0}, 1.0, {}, "plaster.png"};
inline const Paint kTrim{"trim", {0.74, 0.70, 0.62}, {0.02, 0.02, 0.02}, 30.0};
inline const Paint kWood{"wood", {0.80, 0.80, 0.80}, {0.04, 0.04, 0.04}, 60.0, {}, "wood.png"};
inline const Paint kRuby{"ruby", {0.30, 0.012, 0.025}, {0.12, 0.10, 0.10}, 260.0};
inline const Paint kGlaze{"glaze", {0.03, 0.12, 0.22}, {0.07, 0.07, 0.07}, 200.0};
inline const Paint kShell{"shell", {0.74, 0.56, 0.44}, {0.08, 0.07, 0.06}, 80.0};
inline const Paint kWalnut{"walnut", {0.105, 0.055, 0.030}, {0.03, 0.03, 0.03}, 40.0};
inline const Paint kLampGlass{"lamp_glass", {0.8, 0.75, 0.65}, {0.0, 0.0, 0.0}, 1.0, {2.6, 2.0, 1.25}};

}  // namespace speculum::generator::paints
