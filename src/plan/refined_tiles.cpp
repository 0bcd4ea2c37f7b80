#include "plan/refined_tiles.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>

namespace speculum {

namespace {

constexpr int around = refinedSide / 2;  // texels beside a tile that count
constexpr size_t shortestRun = 2;        // tiles of a row: shorter ones would make more rectangles than they save

// Returns the square of the estimated error of a texel's mean, in steps of 8 bits.
double squareAt(const float* half, const float* whole, int pictures, const DisplayCurve& curve) {
  const double n = 0.5 * pictures;
  double error = 0.0;
  for (int channel = 0; channel < 3; ++channel) {
    const double first = half[channel] / n;
    const double second = (whole[channel] - half[channel]) / n;
    // Neither curve is steeper than 32: such differences are too small to count.
    if (!(std::abs(first - second) * curve.exposure < 1e-6)) {
      error = std::max(error, 0.5 * 255.0 * std::abs(displayValue(first, curve) - displayValue(second, curve)));
    }
  }
  return error * error;
}

}  // namespace

double RefinedTiles::share() const {
  return static_cast<double>(std::accumulate(tiles.begin(), tiles.end(), size_t{0})) /
         static_cast<double>(std::max<size_t>(tiles.size(), 1));
}

bool startsHalf(int pictures) {
  return decidesTiles(2 * pictures);
}

bool decidesTiles(int pictures) {
  // Each 8 pictures hit all eighths of a texel's width and height once. With halves that do not, an edge that all rows
  // of texels see at the same place would look converged before it is.
  constexpr int evenHalves = 16;
  const auto n = static_cast<unsigned>(std::max(pictures, 0));
  return n % evenHalves == 0 && (std::has_single_bit(n) || (n % 3 == 0 && std::has_single_bit(n / 3)));
}

RefinedTiles refineTiles(const PictureSum& half, const PictureSum& whole, const glm::ivec2& texels,
                         const DisplayCurve& curve, double step, const RefinedTiles* before) {
  RefinedTiles refined{.decidedAfter = whole.pictures, .texels = texels};
  const glm::ivec2 grid = refined.grid();
  const auto goesOn = [&](int x, int y) { return !before || before->tiles[static_cast<size_t>(y * grid.x + x)] != 0; };
  std::vector<float> squares(static_cast<size_t>(texels.x) * static_cast<size_t>(texels.y));
  tbb::parallel_for(0, texels.y, [&](int y) {
    for (int x = 0; x < texels.x; ++x) {
      const size_t texel = static_cast<size_t>(y) * static_cast<size_t>(texels.x) + static_cast<size_t>(x);
      if (goesOn(x / refinedSide, y / refinedSide)) {
        squares[texel] =
            static_cast<float>(squareAt(&half.texels[4 * texel], &whole.texels[4 * texel], whole.pictures, curve));
      }
    }
  });
  // Texels that no picture has been added to since an earlier decision say nothing.
  const auto isRefined = [&](int column, int row) {
    const glm::ivec2 corner = refinedSide * glm::ivec2(column, row);
    const glm::ivec2 low = glm::max(corner - around, glm::ivec2(0));
    const glm::ivec2 high = glm::min(corner + refinedSide + around, texels);
    double sum = 0.0;
    int count = 0;
    for (int y = low.y; y < high.y; ++y) {
      for (int x = low.x; x < high.x; ++x) {
        if (goesOn(x / refinedSide, y / refinedSide)) {
          sum += squares[static_cast<size_t>(y) * static_cast<size_t>(texels.x) + static_cast<size_t>(x)];
          ++count;
        }
      }
    }
    return !(sum < step * step * count);  // what is not finite has not converged
  };
  for (int row = 0; row < grid.y; ++row) {
    for (int column = 0; column < grid.x; ++column) {
      refined.tiles.push_back(goesOn(column, row) && isRefined(column, row));
    }
  }
  return refined;
}

std::vector<PixelRect> convergedRects(const RefinedTiles& refined, int margin) {
  const glm::ivec2 grid = refined.grid();
  std::vector<PixelRect> rects;
  std::map<std::pair<int, int>, size_t> open;  // rectangles that the row before ended with, by first and last column
  for (int row = 0; row < grid.y; ++row) {
    std::map<std::pair<int, int>, size_t> next;
    for (int column = 0; column < grid.x;) {
      const auto at = refined.tiles.begin() + static_cast<std::ptrdiff_t>(row) * grid.x;
      const auto first = std::find(at + column, at + grid.x, 0u);
      const auto last = std::find(first, at + grid.x, 1u);
      column = static_cast<int>(last - at);
      if (last - first < static_cast<std::ptrdiff_t>(shortestRun)) {
        continue;
      }
      const std::pair<int, int> run(static_cast<int>(first - at), column);
      const auto above = open.find(run);
      if (above == open.end()) {
        rects.push_back({run.first, row, run.second - run.first, 0});
      }
      const size_t index = above == open.end() ? rects.size() - 1 : above->second;
      ++rects[index].height;
      next[run] = index;
    }
    open = std::move(next);
  }
  // A side at the picture's border has no refined tile beyond it.
  for (PixelRect& rect : rects) {
    const auto inside = [&](int tile, int tiles, int count, int sign) {
      return tile == 0 || tile == tiles ? std::clamp(tile * refinedSide, 0, count) : tile * refinedSide + sign * margin;
    };
    const int x0 = inside(rect.x, grid.x, refined.texels.x, 1);
    const int y0 = inside(rect.y, grid.y, refined.texels.y, 1);
    const int x1 = inside(rect.x + rect.width, grid.x, refined.texels.x, -1);
    const int y1 = inside(rect.y + rect.height, grid.y, refined.texels.y, -1);
    rect = {x0, y0, x1 - x0, y1 - y0};
  }
  std::erase_if(rects, [](const PixelRect& rect) { return rect.empty(); });
  return rects;
}

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
  // Column and row of each cell, in octal. Each eight cells hit all columns and all rows. The order was found by a
  // search for slopes that are ratios of small numbers, where all texels along an edge or a thin line see it in the
  // same few ways: both halves of a decision shall differ wherever their mean is wrong. Of the first eight, those come
  // first whose mean errs least over random edges. The centre is a corner of the first cell.
  constexpr std::array<uint8_t, 64> cells = {
      044, 026, 030, 075, 013, 052, 067, 001, 070, 061, 054, 043, 035, 022, 016, 007, 077, 063, 050, 046, 032, 021,
      015, 004, 073, 065, 056, 041, 037, 024, 010, 002, 071, 064, 055, 042, 036, 020, 017, 003, 076, 062, 057, 040,
      034, 023, 011, 005, 072, 060, 051, 045, 033, 027, 014, 006, 074, 066, 053, 047, 031, 025, 012, 000};
  const int cell = cells[static_cast<size_t>(index % 64)];
  // Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences" (2018).
  constexpr glm::dvec2 plastic(0.7548776662466927, 0.5698402909980532);
  const glm::dvec2 withinCell = glm::fract(0.5 + static_cast<double>(index / 64) * plastic);
  const double open = std::pow(std::min(settings.view.samples, settings.reflection.samples), -0.75);
  return open * ((glm::dvec2(cell / 8, cell % 8) + withinCell) / 8.0 - 0.5);
}

}  // namespace speculum
