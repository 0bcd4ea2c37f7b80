// Random scenes that join hard cases: the rasteriser against the tracer, and with each debug switch against itself.
#include <gtest/gtest-spi.h>

#include "image/image.hpp"
#include "random_scene.hpp"
#include "reference/ray_tracer.hpp"
#include "sampling.hpp"
#include "scene/material_mirrors.hpp"
#include "session/session.hpp"
#include "studio.hpp"
#include "truth_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr PictureSize size{160, 90};

// A scene with its views: 0 is the camera's, others are bookmarks.
class Drawn : public Studio {
 public:
  Drawn(const std::filesystem::path& file, double at) : Studio(headless(file, size)), file_(file) { time = at; }

  size_t views() const { return scene.bookmarks.size() + 1; }
  void look(size_t view) {
    const CameraSpec spec = view == 0 ? scene.camera : cameraOf(scene.bookmarks[view - 1], scene.camera);
    camera = lookAt(spec.position, spec.target, spec.up, spec.verticalFov, spec.near);
  }
  Tracing tracing(PictureSize extent, int maxDepth) {
    if (!loaded_) {
      loaded_ = tracingOf(file_, size, maxDepth, time);
    }
    Tracing tracing = *loaded_;
    tracing.options.width = extent.width;
    tracing.options.height = extent.height;
    tracing.options.maxDepth = maxDepth;
    tracing.state.camera = camera.value();
    return tracing;
  }
  // Draws with the same quality for all mirrors.
  Image8 drawWithQuality(const MirrorQuality& quality, const Settings& changed) {
    const std::vector<Mirror> mirrors = scene.mirrors;
    std::ranges::for_each(scene.mirrors, [&](Mirror& mirror) { mirror.quality = quality; });
    Image8 picture = drawWith(changed);
    scene.mirrors = mirrors;
    return picture;
  }
  // Draws with another mirror in the place of the one with this index.
  Image8 drawWithMirror(size_t index, const Mirror& mirror, const Settings& changed) {
    const Mirror before = std::exchange(scene.mirrors[index], mirror);
    Image8 picture = drawWith(changed);
    scene.mirrors[index] = before;
    return picture;
  }
  double lowestScale(double scale) const {
    for (const Mirror& mirror : scene.mirrors) {
      scale = std::min(scale, mirror.quality.scale.value_or(scale));
    }
    return scale;
  }
  Image8 drawWith(const Settings& changed, bool fresh = true) {
    settings = changed;
    return fresh ? Studio::fresh() : draw();
  }

 private:
  std::filesystem::path file_;
  std::optional<Tracing> loaded_;
};

Settings settingsWith(const SettingList& changes) {
  Settings settings;
  settings.debug.checkFinite = true;
  for (const auto& [key, value] : changes) {
    EXPECT_EQ(setSetting(settings, key, value), std::nullopt);
  }
  return settings;
}

int mostViews() {
  return fullTests() ? 4 : 1;
}

class RandomScenes : public testing::TestWithParam<unsigned> {
 protected:
  static void TearDownTestSuite() {
    // scripts/test-gpu runs each scene in a process of its own, and a few may have few views.
    if (scenes_ > 9) {
      EXPECT_GE(2 * views_, mostViews() * scenes_) << "few views see a mirror";
      EXPECT_GE(4 * encoded_, views_) << "few views are encoded early";
    }
  }

  static inline int scenes_ = 0;
  static inline int views_ = 0;    // that see a mirror
  static inline int encoded_ = 0;  // of these: FramePlan::encodes
};

// Counts pixels at silhouettes and other steps, which a difference in rounding may move by a pixel.
int edgePixels(const Image8& picture) {
  int count = 0;
  for (int y = 1; y < picture.height; ++y) {
    for (int x = 1; x < picture.width; ++x) {
      const auto steps = [&](int i, int j) {
        const auto* a = picture.at(x, y);
        const auto* b = picture.at(i, j);
        return std::abs(a[0] - b[0]) > 2 || std::abs(a[1] - b[1]) > 2 || std::abs(a[2] - b[2]) > 2;
      };
      count += steps(x - 1, y) || steps(x, y - 1);
    }
  }
  return count;
}

// Vertices are snapped to 1/256 pixel in each image that an edge passes through, so a pixel at an edge is on the wrong
// side with a probability of about 1/256. Allows twice that and some pixels more, but no patch of wrong pixels. Where
// an edge lies along pixel centres, more are on the wrong side: these are compared with Tracing::nearest().
void expectTraced(const Image8& picture, const Tracing& tracing, const std::string& name) {
  const TraceResult traced = tracing.result();
  Image8 expected = toDisplay(traced.image);
  const int edges = edgePixels(expected);
  const auto agreement = [&] { return difference(picture, expected, 2, notBackground(traced)); };
  const auto holds = [&](const PictureAgreement& d) { return d.over <= 8 + edges / 128 && !d.block; };
  if (!holds(agreement())) {
    expected = tracing.nearest(picture);
  }
  if (const PictureAgreement d = agreement(); !holds(d)) {
    ADD_FAILURE() << name << ": " << d.over << " of " << d.counted << " pixels differ, " << edges << " are at edges";
    writeEvidence(picture, expected, name);
  }
  expectBackground(picture, expected, traced, name);
}

// Returns the means of blocks of `side` x `side` pixels.
Image8 blockMeans(const Image8& picture, int side) {
  Image8 means(picture.width / side, picture.height / side);
  for (int y = 0; y < means.height; ++y) {
    for (int x = 0; x < means.width; ++x) {
      for (int channel = 0; channel < 4; ++channel) {
        int sum = 0;
        for (int i = 0; i < side * side; ++i) {
          sum += picture.at(side * x + i % side, side * y + i / side)[channel];
        }
        means.at(x, y)[channel] = static_cast<uint8_t>(sum / (side * side));
      }
    }
  }
  return means;
}

// Expects that at most `pixels` pixels differ by more than `steps` of 255, and unless they may, no 3x3 block as a
// whole.
void expectSame(const Image8& picture, const Image8& expected, const std::string& name, int pixels = 0, int steps = 0,
                bool mayBlocks = false) {
  const PictureAgreement d = difference(picture, expected, steps);
  if (d.over > pixels || (d.block && !mayBlocks)) {
    ADD_FAILURE() << name << ": " << d.over << " pixels differ";
    writeEvidence(picture, expected, name);
  }
}

// Expects that no debug switch changes the picture. Returns the picture.
Image8 expectNoSwitchMatters(Drawn& drawn, const Settings& settings, const std::string& name) {
  const Image8 picture = drawn.drawWith(settings);
  const bool traces = drawn.plan.effects.any();
  expectSame(drawn.drawWith(settings, false), picture, name + "_cached");
  static constexpr std::array switches{std::pair("skip_hidden", &DebugSettings::skipHidden),
                                       std::pair("mask_passes", &DebugSettings::maskPasses),
                                       std::pair("cull_clusters", &DebugSettings::cullClusters)};
  constexpr size_t count = switches.size();
  for (unsigned off = 1; off < 1u << count; ++off) {
    // The suite turns each switch off alone and all together; the full tests try every combination.
    if (!fullTests() && !std::has_single_bit(off) && off + 1 != 1u << count) {
      continue;
    }
    Settings without = settings;
    std::string kind = name + "_without";
    for (size_t i = 0; i < count; ++i) {
      if ((off >> i & 1) != 0) {
        without.debug.*switches[i].second = false;
        kind += std::string("_") + switches[i].first;
      }
    }
    const Image8 other = drawn.drawWith(without);
    // A hidden mirror may be all that calls for an effect. Without it no rays are traced, and other shaders round
    // differently. So does lavapipe with other triangles in a draw. Along outlines, backs may be nearer than fronts.
    const int steps = drawn.plan.effects.any() == traces ? 0 : 1;
    // Enlarging spreads one texel over a square of that side, so a single one looks like a block.
    const double side = 2.0 / (settings.view.scale * std::min(drawn.lowestScale(settings.reflection.scale), 1.0));
    const bool enlarged = side > 2.0;
    const int backs = enlarged ? static_cast<int>(5.0 * side * side) : 20;
    expectSame(other, picture, kind, without.debug.cullClusters ? 0 : backs, steps, enlarged);
  }
  return picture;
}

// Expects that a quality which all mirrors ask for is that of the settings, and that a lower one of a single mirror
// changes only pixels that show it. Those change if its color does.
void expectQualityOfOneMirror(Drawn& drawn, const Settings& settings, const std::string& name) {
  const ReflectionSettings& asked = settings.reflection;
  const Image8 usual = drawn.drawWithQuality({}, settings);
  expectSame(drawn.drawWithQuality({asked.scale, asked.samples, asked.updateInterval, asked.method}, settings), usual,
             name + "_quality_of_all");
  const Image8 picture = drawn.drawWith(settings);
  const auto seen = std::ranges::find_if(drawn.plan.main().mirrors, [&](const MirrorDraw& draw) {
    return draw.pass >= 0 && static_cast<size_t>(draw.mirror) < drawn.scene.mirrors.size();
  });
  if (seen == drawn.plan.main().mirrors.end()) {
    return;
  }
  const auto index = static_cast<size_t>(seen->mirror);
  Mirror mirror = drawn.scene.mirrors[index];
  mirror.quality = {.scale = 0.3, .samples = 1, .method = ReflectionMethod::raster};
  const bool traced = drawn.plan.effects.any();
  const Image8 lower = drawn.drawWithMirror(index, mirror, settings);
  const bool traces = drawn.plan.effects.any() != traced;  // other shaders, which round differently
  mirror = drawn.scene.mirrors[index];
  mirror.reflectance = glm::dvec3(0.0);
  mirror.fresnel = Fresnel::none;
  mirror.baseColor = glm::dvec3(0.0);
  const Image8 black = drawn.drawWithMirror(index, mirror, settings);
  mirror.baseColor = glm::dvec3(100.0);
  const Image8 bright = drawn.drawWithMirror(index, mirror, settings);
  Image8 expected = picture;
  for (size_t i = 0; i < picture.rgba.size(); ++i) {
    const bool shows = black.rgba[i] != picture.rgba[i] || bright.rgba[i] != picture.rgba[i];
    expected.rgba[i] = shows ? lower.rgba[i] : picture.rgba[i];
  }
  expectSame(lower, expected, name + "_quality_of_one", 0, traces ? 1 : 0);
}

// Expects that the display pass would show the same. Says whether the plan leaves it out.
bool expectEncodedAlike(Drawn& drawn, Settings settings, const std::string& name) {
  settings.debug.checkFinite = false;
  settings.view.samples = 1;
  settings.view.scale = 1.0;
  drawn.shownOnly = true;
  const Image8 picture = drawn.drawWith(settings);
  const bool encodes = drawn.plan.encodes;
  settings.debug.encodeEarly = false;
  expectSame(picture, drawn.drawWith(settings), name + "_encoded_early");
  drawn.shownOnly = false;
  return encodes;
}

// Returns how many of its views saw a mirror, and how many of these were encoded early.
std::pair<int, int> compare(const RandomScene& scene) {
  const Settings settings = settingsWith(scene.settings);
  Drawn plain(scene.file, scene.time);
  std::optional<Drawn> withEffects;
  if (scene.withEffects != scene.file) {
    withEffects.emplace(scene.withEffects, scene.time);
  }
  int views = 0;
  int encoded = 0;
  for (size_t view = 0; view < plain.views() && views < mostViews(); ++view) {
    const std::string name = scene.name + "_" + scene.kind + "_" + std::to_string(view);
    plain.look(view);
    if (share(plain.tracing({16, 9}, 1).result().mirrorDepth, 1) < 0.02) {
      continue;
    }
    ++views;
    expectTraced(plain.drawWithQuality({}, settingsWith(truthSettings(scene.maxDepth))),
                 plain.tracing(size, scene.maxDepth), name);
    Drawn& drawn = withEffects ? *withEffects : plain;
    drawn.look(view);
    const Image8 picture = expectNoSwitchMatters(drawn, settings, name);
    expectQualityOfOneMirror(plain, settings, name);
    encoded += expectEncodedAlike(drawn, settings, name);
    const bool approximates =
        hasCurvedMirrors(plain.scene) && settings.effects.curvedLookup == CurvedLookup::environment;
    if (!withEffects && !approximates && settings.view.scale == 1.0) {
      // Other resolutions soften edges by a texel or two, but no patch may differ.
      const Image8 expected = toDisplay(plain.tracing(size, settings.reflection.maxDepth).result().image);
      const double scale = plain.lowestScale(settings.reflection.scale);
      const int texel = scale < 0.5 ? 4 : scale < 1.0 ? 2 : 1;  // pixels
      if (difference(blockMeans(picture, texel), blockMeans(expected, texel), 90).block) {
        ADD_FAILURE() << name << " differs at other settings";
        writeEvidence(picture, expected, name + "_settings");
      }
    }
  }
  return {views, encoded};
}

TEST_P(RandomScenes, AreDrawnAsTraced) {
  const RandomScene scene = randomScene(GetParam());
  scenes_ += 1;
  const auto [views, encoded] = compare(scene);
  views_ += views;
  encoded_ += encoded;
  if (HasFailure()) {
    std::printf("Reducing %s\n", scene.file.c_str());
    std::fflush(stdout);
    const RandomScene least = smallest(scene, [&](const RandomScene& smaller) {
      testing::TestPartResultArray results;
      const testing::ScopedFakeTestPartResultReporter reporter(
          testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &results);
      try {
        compare(smaller);
      } catch (const std::exception&) {
        return false;
      }
      return results.size() > 0;
    });
    compare(least);  // reports its failures
    std::printf("The smallest scene that fails: %s at %g s with depth %d; with effects %s and", least.file.c_str(),
                least.time, least.maxDepth, least.withEffects.c_str());
    for (const auto& [key, value] : least.settings) {
      std::printf(" --set %s=%s", key.c_str(), value.c_str());
    }
    std::printf("\n");
  }
}

TEST(SmallestScene, KeepsOnlyWhatMakesItFail) {
  const auto tables = [](const RandomScene& scene, const std::string& table) {
    const std::string text = readText(scene.file);
    int count = 0;
    for (size_t at = text.find(table); at != std::string::npos; at = text.find(table, at + 1)) {
      ++count;
    }
    return count;
  };
  const RandomScene scene = randomScene(1);
  ASSERT_GT(tables(scene, "[[mirror]]"), 2);
  const RandomScene least = smallest(scene, [&](const RandomScene& smaller) {
    return tables(smaller, "[[mirror]]") >= 2 && tables(smaller, "[camera]") == 1;
  });
  EXPECT_EQ(tables(least, "[[mirror]]"), 2);
  EXPECT_EQ(tables(least, "\n["), 2) << readText(least.file);
}

// SPECULUM_SEED is added to each.
std::vector<unsigned> seeds() {
  const char* first = std::getenv("SPECULUM_SEED");
  std::vector<unsigned> seeds = sampledSeeds(1000, 83);  // of all kinds, whose number has no common factor with 83
  for (unsigned& seed : seeds) {
    seed += first ? static_cast<unsigned>(std::atoi(first)) : 0;
  }
  return seeds;
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomScenes, testing::ValuesIn(seeds()), testing::PrintToStringParamName());

}  // namespace
}  // namespace speculum
