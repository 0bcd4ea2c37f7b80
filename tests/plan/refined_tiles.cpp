// Where a mean of pictures is drawn on: estimates against whole means of random signals, and the parts of passes that
// are left out.
#include "plan/refined_tiles.hpp"

#include <functional>
#include <random>

#include "plan/pass_mask.hpp"
#include "sampling.hpp"
#include "support.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr int side = 64;      // texels of a picture
constexpr int pictures = 64;  // of the whole mean
constexpr double step = 0.5;

// Radiance at a point (texels) in a picture.
using Signal = std::function<double(const glm::dvec2& point, int picture)>;

// A mean of pictures of a signal that stops where it has converged.
struct RefinedMean {
  std::vector<float> whole;     // sum of all pictures
  std::vector<double> stopped;  // the mean of the pictures that each texel has
  std::vector<int> counts;      // their number
};

RefinedMean refine(const Signal& signal, double error) {
  const Settings settings = pictureSettings({.view = {.accumulate = pictures}});
  const glm::ivec2 size(side);
  RefinedMean mean{std::vector<float>(4 * side * side), std::vector<double>(side * side),
                   std::vector<int>(side * side, pictures)};
  std::map<int, std::vector<float>> sums;
  RefinedTiles refined;
  for (int n = 1; n <= pictures; ++n) {
    for (int texel = 0; texel < side * side; ++texel) {
      const glm::dvec2 point = glm::dvec2(texel % side, texel / side) + 0.5 + pictureOffset(n - 1, settings);
      const auto value = static_cast<float>(signal(point, n));
      for (int channel = 0; channel < 3; ++channel) {
        mean.whole[static_cast<size_t>(4 * texel + channel)] += value;
      }
    }
    sums[n] = mean.whole;
    if (decidesTiles(n) && n < pictures) {
      refined =
          refineTiles({n / 2, sums[n / 2]}, {n, sums[n]}, size, {}, error, refined.tiles.empty() ? nullptr : &refined);
      EXPECT_EQ(refined.decidedAfter, n);
      for (int texel = 0; texel < side * side; ++texel) {
        const int tile = texel / side / refinedSide * refined.grid().x + texel % side / refinedSide;
        int& count = mean.counts[static_cast<size_t>(texel)];
        count = refined.tiles[static_cast<size_t>(tile)] == 0 ? std::min(count, n) : count;
      }
    }
  }
  for (size_t texel = 0; texel < mean.stopped.size(); ++texel) {
    mean.stopped[texel] = sums[mean.counts[texel]][4 * texel] / mean.counts[texel];
  }
  return mean;
}

// Returns how far a mean that stops is from the whole one, for each tile with a contrast: root mean square, in steps of
// 8 bits.
std::vector<double> offWhole(const RefinedMean& mean) {
  std::vector<double> tiles;
  for (int row = 0; row < side; row += refinedSide) {
    for (int column = 0; column < side; column += refinedSide) {
      double sum = 0.0;
      double low = 1.0;
      double high = 0.0;
      for (int i = 0; i < refinedSide * refinedSide; ++i) {
        const auto texel = static_cast<size_t>((row + i / refinedSide) * side + column + i % refinedSide);
        const double whole = displayValue(mean.whole[4 * texel] / pictures, {});
        const double off = displayValue(mean.stopped[texel], {}) - whole;
        sum += 255.0 * 255.0 * off * off;
        low = std::min(low, whole);
        high = std::max(high, whole);
      }
      if (high - low > 0.01) {
        tiles.push_back(std::sqrt(sum / (refinedSide * refinedSide)));
      }
    }
  }
  return tiles;
}

struct SignalClass {
  const char* name;
  Signal (*make)(std::mt19937& random);
  double missed;  // largest share of tiles that may be off by more than two steps of 8 bits
};

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// A number from 0 to 1 that follows from the cell of a point.
double noise(const glm::dvec2& point, int seed) {
  const glm::ivec2 cell(glm::floor(point));
  uint32_t x = static_cast<uint32_t>(cell.x) * 73856093u ^ static_cast<uint32_t>(cell.y) * 19349663u ^
               static_cast<uint32_t>(seed) * 83492791u;
  x = (x ^ x >> 16) * 0x7feb352du;
  x = (x ^ x >> 15) * 0x846ca68bu;
  return static_cast<double>(x ^ x >> 16) / 4294967296.0;
}

// Returns the signed distance of points from a line through the picture, in any direction or at this angle.
std::function<double(const glm::dvec2&)> line(std::mt19937& random, std::optional<double> direction = {}) {
  const double angle = direction ? *direction : uniform(random, 0.0, 2.0 * std::numbers::pi);
  const glm::dvec2 normal(std::cos(angle), std::sin(angle));
  const glm::dvec2 through(uniform(random, 0.0, side), uniform(random, 0.0, side));
  return [=](const glm::dvec2& point) { return glm::dot(normal, point - through); };
}

Signal flat(std::mt19937& random) {
  const double value = uniform(random, 0.0, 1.2);
  return [=](const glm::dvec2&, int) { return value; };
}

Signal shaded(std::mt19937& random) {
  const auto distance = line(random);
  const double slope = uniform(random, 0.0, 0.01);
  return [=](const glm::dvec2& point, int) { return 0.5 + slope * distance(point); };
}

Signal edgeAt(std::mt19937& random, std::optional<double> direction) {
  const auto distance = line(random, direction);
  const double dark = uniform(random, 0.0, 0.3);
  const double bright = uniform(random, 0.3, 1.0);
  return [=](const glm::dvec2& point, int) { return distance(point) < 0.0 ? dark : bright; };
}

Signal wireAt(std::mt19937& random, std::optional<double> direction) {
  const auto distance = line(random, direction);
  const double width = uniform(random, 0.02, 0.2);
  return [=](const glm::dvec2& point, int) { return std::abs(distance(point)) < width ? 1.0 : 0.1; };
}

constexpr double upright = 0.0;
constexpr double level = std::numbers::pi / 2.0;
constexpr double diagonal = std::numbers::pi / 4.0;

template <Signal (*make)(std::mt19937&, std::optional<double>), const double& direction>
Signal along(std::mt19937& random) {
  return make(random, direction);
}

// At most so many degrees from a slope that is a ratio of numbers up to 4.
template <Signal (*make)(std::mt19937&, std::optional<double>), int degrees>
Signal nearRatio(std::mt19937& random) {
  const double slope = std::floor(uniform(random, 1.0, 5.0)) / std::floor(uniform(random, 1.0, 5.0));
  const double angle = std::atan(slope) + uniform(random, -degrees, degrees) * std::numbers::pi / 180.0;
  return make(random, random() % 2 == 0 ? angle : -angle);
}

template <Signal (*make)(std::mt19937&, std::optional<double>)>
Signal anyhow(std::mt19937& random) {
  return make(random, {});
}

Signal highlight(std::mt19937& random) {
  const glm::dvec2 middle(uniform(random, 8.0, side - 8.0), uniform(random, 8.0, side - 8.0));
  const double width = uniform(random, 0.1, 3.0);
  return [=](const glm::dvec2& point, int) {
    const glm::dvec2 from = (point - middle) / width;
    return 0.05 + 20.0 * std::exp(-glm::dot(from, from));
  };
}

Signal texture(std::mt19937& random) {
  const double scale = uniform(random, 0.3, 4.0);
  const double contrast = uniform(random, 0.0, 0.5);
  const int seed = static_cast<int>(random() % 1000);
  return [=](const glm::dvec2& point, int) { return 0.3 + contrast * noise(scale * point, seed); };
}

// Coverage by random thresholds: each sample shows the surface with a probability.
Signal coverage(std::mt19937& random) {
  const double share = std::pow(10.0, uniform(random, -4.0, -0.3));
  const int seed = static_cast<int>(random() % 1000);
  return [=](const glm::dvec2& point, int picture) {
    return noise(64.0 * point, seed + 1000 * picture) < share ? 0.8 : 0.2;
  };
}

constexpr SignalClass classes[] = {
    {"flat", flat, 0.0},
    {"shaded", shaded, 0.0},
    {"edge", anyhow<edgeAt>, 0.0005},
    {"uprightEdge", along<edgeAt, upright>, 0.0},
    {"levelEdge", along<edgeAt, level>, 0.0},
    {"diagonalEdge", along<edgeAt, diagonal>, 0.01},
    {"ratioEdge", nearRatio<edgeAt, 0>, 0.002},
    {"nearRatioEdge", nearRatio<edgeAt, 2>, 0.0005},
    {"wire", anyhow<wireAt>, 0.0015},
    {"uprightWire", along<wireAt, upright>, 0.0},
    {"levelWire", along<wireAt, level>, 0.0},
    {"diagonalWire", along<wireAt, diagonal>, 0.18},
    {"ratioWire", nearRatio<wireAt, 0>, 0.04},
    {"nearRatioWire", nearRatio<wireAt, 2>, 0.004},
    {"highlight", highlight, 0.003},
    {"texture", texture, 0.0},
    {"coverage", coverage, 0.0005},
};

class RefinedSignals : public testing::TestWithParam<SignalClass> {};

// All texels have the same samples, so a thin line, or an edge, that runs between those of the first pictures in one
// texel does so in its neighbours, as long as its slope is nearly a ratio of small numbers.
TEST_P(RefinedSignals, StopNearTheWholeMean) {
  std::mt19937 random(7);
  double saved = 0.0;
  std::vector<double> off;
  const int cases = fullTests() ? 1000 : 100;
  for (int i = 0; i < cases; ++i) {
    const RefinedMean mean = refine(GetParam().make(random), step);
    const std::vector<double> tiles = offWhole(mean);
    off.insert(off.end(), tiles.begin(), tiles.end());
    for (const int count : mean.counts) {
      saved += 1.0 - static_cast<double>(count) / pictures;
    }
  }
  const auto count = std::max(1.0, static_cast<double>(off.size()));
  const auto missed = static_cast<double>(std::ranges::count_if(off, [](double tile) { return tile > 2.0; })) / count;
  RecordProperty("worst_steps", std::to_string(off.empty() ? 0.0 : std::ranges::max(off)));
  RecordProperty("missed", std::to_string(missed));
  RecordProperty("saved", std::to_string(saved / (cases * side * side)));
  EXPECT_LE(missed, GetParam().missed);
  EXPECT_GT(saved, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Classes, RefinedSignals, testing::ValuesIn(classes),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(RefinedTiles, AreDecidedWhereHalvesCanBeCompared) {
  std::vector<int> decisions;
  for (int n = 0; n < 200; ++n) {
    if (decidesTiles(n)) {
      decisions.push_back(n);
      EXPECT_TRUE(startsHalf(n / 2)) << n;
    }
  }
  EXPECT_EQ(decisions, (std::vector{16, 32, 48, 64, 96, 128, 192}));
  EXPECT_FALSE(startsHalf(12));
}

TEST(RefinedTiles, ValuesThatAreNoNumbersHaveNotConverged) {
  std::vector<float> half(4 * 8 * 8, 1.0f);
  std::vector<float> whole(4 * 8 * 8, 2.0f);
  EXPECT_TRUE(refineTiles({4, half}, {8, whole}, {8, 8}, {}, 0.5, nullptr).none());
  whole[40] = NAN;
  EXPECT_EQ(refineTiles({4, half}, {8, whole}, {8, 8}, {}, 0.5, nullptr).share(), 1.0);
}

RefinedTiles randomTiles(std::mt19937& random, const glm::ivec2& texels) {
  RefinedTiles refined{.decidedAfter = 8, .texels = texels};
  const double share = uniform(random, 0.0, 1.0);
  for (int i = 0; i < refined.grid().x * refined.grid().y; ++i) {
    refined.tiles.push_back(uniform(random, 0.0, 1.0) < share);
  }
  return refined;
}

TEST(ConvergedRects, KeepTheirDistanceFromRefinedTilesAndDoNotOverlap) {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    const glm::ivec2 texels(1 + random() % 90, 1 + random() % 60);
    const RefinedTiles refined = randomTiles(random, texels);
    const int margin = static_cast<int>(random() % 12);
    std::vector<bool> covered(static_cast<size_t>(texels.x * texels.y));
    for (const PixelRect& rect : convergedRects(refined, margin)) {
      ASSERT_TRUE(rect.x >= 0 && rect.y >= 0 && rect.x + rect.width <= texels.x && rect.y + rect.height <= texels.y);
      for (int y = rect.y - margin; y < rect.y + rect.height + margin; ++y) {
        for (int x = rect.x - margin; x < rect.x + rect.width + margin; ++x) {
          if (x < 0 || y < 0 || x >= texels.x || y >= texels.y) {
            continue;
          }
          const int tile = y / refinedSide * refined.grid().x + x / refinedSide;
          ASSERT_EQ(refined.tiles[static_cast<size_t>(tile)], 0u) << x << " " << y;
          if (rect.contains(x, y)) {
            const auto texel = static_cast<size_t>(y * texels.x + x);
            ASSERT_FALSE(covered[texel]);
            covered[texel] = true;
          }
        }
      }
    }
  }
}

TEST(ConvergedRects, OfAWholePictureAreOne) {
  RefinedTiles refined{.decidedAfter = 8, .texels = {50, 20}};
  refined.tiles.assign(7 * 3, 0);
  EXPECT_EQ(convergedRects(refined, 5), (std::vector<PixelRect>{{0, 0, 50, 20}}));
}

// The next picture of a mean is drawn in the tiles, any other one as a whole.
TEST(RefinedPlan, HasTilesForTheNextPictureOnly) {
  const Scene scene = corridor();
  const SceneState state = evaluate(scene, 0.0);
  Settings settings;
  settings.view.accumulate = 64;
  const auto refined = std::make_shared<RefinedTiles>(RefinedTiles{8, {width, height}, {}});
  refined->tiles.assign(static_cast<size_t>(refined->grid().x * refined->grid().y), 0);
  const auto planned = [&](int picture, const glm::ivec2& size) {
    return planFrame({scene, state, pictureSettings(settings), size, {.refined = refined, .accumulated = 8}, picture});
  };
  const FramePlan plan = planned(8, {width, height});
  EXPECT_EQ(plan.refined, refined);
  const std::vector<std::vector<PixelRect>> parts = convergedParts(plan);
  for (size_t i = 0; i < plan.passes.size(); ++i) {
    EXPECT_EQ(parts[i], std::vector<PixelRect>{plan.passes[i].view.rect});
  }
  EXPECT_GT(plan.passes.size(), 2u);
  EXPECT_EQ(planned(7, {width, height}).refined, nullptr) << "is drawn again";
  EXPECT_EQ(planned(0, {width, height}).refined, nullptr) << "begins another mean";
  EXPECT_EQ(planned(8, {width, 2 * height}).refined, nullptr) << "has another size";
}

}  // namespace
}  // namespace speculum
