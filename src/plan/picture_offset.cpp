#include "plan/picture_offset.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace speculum {

Settings pictureSettings(const Settings& settings) {
  if (settings.view.accumulate == 1) {
    return settings;
  }
  Settings drawn = settings;
  drawn.reflection.skipUnchanged = false;
  drawn.reflection.updateInterval = 1;
  drawn.limit.mostInterval = 1;
  drawn.effects.environmentInterval = 1;
  if (settings.view.accumulate >= singleSamplePictures) {
    drawn.view.samples = 1;
    drawn.reflection.samples = 1;
    drawn.limit.samples = 1;
  }
  return drawn;
}

glm::dvec2 pictureOffset(int index, const Settings& settings) {
  if (index == 0) {
    return glm::dvec2(0.0);
  }
  // Leading bits of Sobol's first two dimensions by bit of the index. The centre is a corner of the first cell.
  constexpr std::array<glm::ivec2, 6> directions = {{{4, 4}, {2, 6}, {1, 5}, {0, 7}, {0, 4}, {0, 6}}};
  glm::ivec2 cell(4, 4);
  for (size_t bit = 0; bit < directions.size(); ++bit) {
    cell ^= (index >> bit & 1) * directions[bit];
  }
  // Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences" (2018).
  constexpr glm::dvec2 plastic(0.7548776662466927, 0.5698402909980532);
  const glm::dvec2 withinCell = glm::fract(0.5 + static_cast<double>(index / 64) * plastic);
  const double open = std::pow(std::min(settings.view.samples, settings.reflection.samples), -0.75);
  return open * ((glm::dvec2(cell) + withinCell) / 8.0 - 0.5);
}

}  // namespace speculum
