// Images of several mirrors in one frame: overlapping, nested, many; their seams and memory.
#include <malloc.h>

#include <spdlog/fmt/fmt.h>

#include <cstdio>
#include <numbers>

#include "image/image.hpp"
#include "picture_support.hpp"
#include "random.hpp"
#include "sampling.hpp"
#include "scene_text.hpp"
#include "test_headers.hpp"
#include "truth_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr PictureSize size{320, 180};

const std::string room = R"(
[environment] sky = { zenith = [0.1, 0.2, 0.9], horizon = [0.9, 0.8, 0.3], ground = [0.2, 0.5, 0.1] }
  ambient = [0.2, 0.2, 0.2]
[camera] position = [0, 1, 5], target = [0, 1, 0]
[settings] "view.samples" = 1, "reflection.samples" = 1
[[object]] model = "MODELS/teapot.obj", position = [-1.2, 0.3, 6.5]
[[object]] model = "MODELS/torus_knot.obj", position = [1.2, 1, 7], scale = 0.6
[[light]] position = [0, 3, 5], intensity = 20
)";

std::string mirror(const std::string& name, const std::string& rest) {
  return "[[mirror]]\nname = \"" + name + "\"\n" + rest + "\n";
}

// Two mirrors that face the eye and overlap on the screen. Neither shows the other.
const std::string left = mirror("left", "position = [-0.5, 1, 0]\nrotation = [0, 8, 0]\nsize = [2, 1.6]");
const std::string right = mirror("right", "position = [0.5, 1.2, -1]\nrotation = [0, -6, 0]\nsize = [2.4, 1.6]");
const std::string black = "reflectance = [0, 0, 0]\n";

Image8 drawText(const std::string& name, const std::string& text) {
  return draw(headless(writeScene(name, text), size));
}

// Expects that making one mirror black does not change the pixels of the other.
void expectIndependent(const std::string& name, const std::string& before, const std::string& after) {
  const Image8 both = drawText(name, before + left + right + after);
  const Image8 leftOnly = drawText(name + "_l", before + left + right + black + after);
  const Image8 rightOnly = drawText(name + "_r", before + left + black + right + after);
  const std::vector<bool> leftMask = blackPixels(rightOnly);
  const std::vector<bool> rightMask = blackPixels(leftOnly);
  ASSERT_GT(std::ranges::count(leftMask, true), 200);
  ASSERT_GT(std::ranges::count(rightMask, true), 200);
  EXPECT_EQ(difference(both, leftOnly, 0, leftMask).largest, 0);
  EXPECT_EQ(difference(both, rightOnly, 0, rightMask).largest, 0);
}

TEST(MirrorPictures, OverlappingMirrorsHaveTheirOwnImages) {
  expectIndependent("overlap", room, "");
}

// The room, but the camera looks the other way.
std::string turnedRoom() {
  return replaced(room, "target = [0, 1, 0]", "target = [0, 1, 9]");
}

// Three mirrors meet in a corner. In front of all, nothing shows the red back of any.
TEST(MirrorPictures, CornersShowNoBacks) {
  const std::string corner = R"(
[environment] background = [0.9, 0.9, 0.9]
[settings] "reflection.max_depth" = 4, "view.samples" = 1, "reflection.samples" = 1
[[mirror]] position = [0, 0, -1], size = [2, 2], back_color = [1, 0, 0]
[[mirror]] position = [-1, 0, 0], rotation = [0, 90, 0], size = [2, 2], back_color = [1, 0, 0]
[[mirror]] position = [0, 1, 0], rotation = [90, 0, 0], size = [2, 2], back_color = [1, 0, 0]
[[light]] position = [-0.2, 0.2, -0.2], glow = 0.0
)";
  Random random(14);
  for (int view = 0; view < 16; ++view) {
    const glm::dvec3 eye = random.inBox(0.45);
    const glm::dvec3 target = eye + glm::dvec3(-0.3, 0.3, -0.3) + random.inBox(0.3);
    const Image8 picture = drawText("corner", corner + "[camera]\nvertical_fov = 80\nposition = " + text(eye) +
                                                  "\ntarget = " + text(target) + "\n");
    int backs = 0;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        backs += picture.at(x, y)[1] < picture.at(x, y)[0] / 2;
      }
    }
    EXPECT_EQ(backs, 0) << "view " << view;
  }
}

// Small mirrors on a mirrored wall, just before a wall: what is left of the mirrored wall has many parts.
TEST(MirrorPictures, MirrorsWithManyHolesHideWhatIsBehind) {
  std::string text = R"(
[environment] ambient = [1, 1, 1], background = [0.2, 0.3, 0.4]
[camera] position = [0.6, 0.4, 3], target = [0, 0, 0]
[[object]] model = "MODELS/box.obj", position = [0, -3, -0.501], scale = [6, 6, 1], color = [0.9, 0.1, 0.1]
)";
  for (int i = 0; i < 12; ++i) {
    text += "[[mirror]]\nreflectance = [0.9, 0.7, 0.3]\npolygon = [";
    for (int corner = 0; corner < 8; ++corner) {
      const double angle = (corner + 0.1 * i) * std::numbers::pi / 4;
      text += fmt::format("[{:.6f}, {:.6f}, 0], ", 0.27 * (i - 5.5) + 0.13 * std::cos(angle),
                          0.4 * std::sin(1.7 * i) + 0.13 * std::sin(angle));
    }
    text += "]\n";
  }
  text += "[[mirror]]\nsize = [3.6, 2.4]\nreflectance = [0.8, 0.9, 0.95]\n";
  const std::filesystem::path file = writeScene("holes", text);
  expectTruth(file, size, 1, trace(file, size, 1));
}

// A lake with one corner 10 cm high, seen from just above: the eye and its mirror image would see that corner at
// different places.
TEST(MirrorPictures, CornersOffThePlaneAreFlattened) {
  const std::filesystem::path file = writeScene("lake", R"(
[environment] ambient = [0.5, 0.5, 0.5]
  sky = { zenith = [0.05, 0.1, 0.9], horizon = [1, 0.8, 0.3], ground = [0.3, 0.28, 0.25] }
[camera] position = [998, 0.5, -2], target = [997, 0, -3]
[[object]] model = "MODELS/box.obj", position = [996.8, 0, -3.2], scale = [0.5, 0.14, 0.5], color = [0.9, 0.1, 0.1]
[[mirror]] polygon = [[0, 0, 0], [1000, 0, 0], [1000, 0.1, -1000], [0, 0, -1000]]
)");
  expectTruth(file, size, 2, trace(file, size, 2));
}

// Vertices on the edges of a mirror, or beside its corners, from any vertex on.
std::vector<glm::dvec3> withNeedlessVertices(const std::vector<glm::dvec3>& polygon, Random& random) {
  std::vector<glm::dvec3> more;
  for (size_t i = 0; i < polygon.size(); ++i) {
    more.push_back(polygon[i]);
    const glm::dvec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    std::vector<double> places;
    for (size_t count = random.index(4); count > 0; --count) {
      places.push_back(random.chance(0.5) ? random.uniform(0.01, 0.99) : std::pow(10.0, random.uniform(-8, -3)));
    }
    std::ranges::sort(places);
    for (const double place : places) {
      more.push_back(polygon[i] + place * edge);
    }
  }
  std::rotate(more.begin(), more.begin() + static_cast<std::ptrdiff_t>(random.index(more.size())), more.end());
  return more;
}

TEST(MirrorPictures, NeedlessVerticesChangeNothing) {
  Random random(29);
  for (int round = 0; round < (fullTests() ? 400 : 10); ++round) {
    std::vector<glm::dvec3> polygon;
    const size_t corners = 3 + random.index(5);
    const double turn = random.uniform(0, 6);
    for (size_t i = 0; i < corners; ++i) {
      const double share = (static_cast<double>(i) + random.uniform(0, 0.6)) / static_cast<double>(corners);
      const double angle = turn + 2.0 * std::numbers::pi * share;
      polygon.emplace_back(1.4 * std::cos(angle), 1.0 + 0.9 * std::sin(angle), 0.0);
    }
    const std::string facing = mirror("behind", "position = [0, 1, 8]\nrotation = [0, 180, 0]\nsize = [6, 4]");
    std::array<Image8, 2> pictures;
    for (size_t i = 0; i < 2; ++i) {
      const std::vector<glm::dvec3> drawn = i == 0 ? polygon : withNeedlessVertices(polygon, random);
      Studio studio(headless(writeScene("needless", room + mirror("ahead", polygonText(drawn)) + facing), size));
      pictures[i] = studio.fresh();
    }
    const PictureAgreement d = difference(pictures[0], pictures[1], 2);
    if (d.over > 4) {
      ADD_FAILURE() << "round " << round << ": " << d.over << " pixels differ";
      writeEvidence(pictures[0], pictures[1], "needless_" + std::to_string(round));
    }
  }
}

// The camera looks into a large mirror that shows the two.
TEST(MirrorPictures, NestedOverlappingMirrorsHaveTheirOwnImages) {
  // Limits the depth: below it the large mirror would show the two in each other.
  const std::string turned = replaced(turnedRoom(), "[settings]", "[settings] \"reflection.max_depth\" = 2,");
  const std::string behind = mirror("big", "position = [0, 1, 9]\nrotation = [0, 180, 0]\nsize = [12, 8]");
  expectIndependent("nested_overlap", turned, behind);
}

// A floor that every ray meets sooner or later, so that the background is seen nowhere.
const std::string floorAllAround = R"(
[environment] background = [4, 0, 0], ambient = [0, 0.5, 1]
[camera] position = [0.3, 1.1, 1.4], target = [0.05, 0, 0], up = [0.06, 1, 0], vertical_fov = 45
[settings] "view.samples" = 4, "reflection.samples" = 4
[[object]] model = "seam_floor.obj", color = [0, 1, 0]
)";

const std::string wallMirror = "polygon = [[-9, -1, 0], [9, -1, 0], [9, 9, 0], [-9, 9, 0]]\n";
const std::string cornerLeft = "polygon = [[-9, -1, 9], [0, -1, 0], [0, 9, 0], [-9, 9, 9]]\n";
const std::string cornerRight = "polygon = [[0, -1, 0], [9, -1, 9], [9, 9, 9], [0, 9, 0]]\n";
const std::string overBase = "reflectance = [0.5, 0.5, 0.5]\nbase_color = [0, 0, 1]";

class Seams : public testing::TestWithParam<std::pair<std::string, std::string>> {};

// The floor's radiance is (0, 0.5, 0). A mirror with a base adds half of (0, 0, 1) to half of what it shows, so that
// green and half of blue make 0.5 on floor and mirrors, in every mixture of them and after any number of reflections.
TEST_P(Seams, ShowNoBackground) {
  const std::filesystem::path scene = writeScene("seam_" + GetParam().first, floorAllAround + GetParam().second);
  std::ofstream(scene.parent_path() / "seam_floor.obj") << "v -10 0 -10\nv -10 0 10\nv 10 0 10\nv 10 0 -10\n"
                                                        << "f 1 2 3 4\n";
  QuietSession session(headless(scene, size));
  const LinearImage picture = drawRadiance(session);
  int wrong = 0;
  float mostBlue = 0.0f;
  for (const glm::vec3& pixel : picture.pixels) {
    wrong += pixel.r > 0.0f || std::abs(pixel.g + 0.5f * pixel.b - 0.5f) > 1e-3f ? 1 : 0;
    mostBlue = std::max(mostBlue, pixel.b);
  }
  // A sample within rounding of a seam can fall either way. A resolved image shows the background in 235 pixels of the
  // wall's seam and in 468 of the corner's.
  EXPECT_LE(wrong, 4) << "the background shows";
  EXPECT_GT(mostBlue, 0.4f);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Seams,
                         testing::Values(std::pair("wall", mirror("wall", wallMirror + overBase)),
                                         std::pair("corner", mirror("left", cornerLeft + overBase) +
                                                                 mirror("right", cornerRight + overBase))),
                         [](const auto& info) { return info.param.first; });

// The whole picture is one mirror's image, shown over it.
Image8 drawDebugView(const std::string& samples) {
  QuietSession session(headless(writeScene("debug_view", room + left), size, {{"reflection.samples", samples}}));
  const DrawnFrame first = session.draw(0.0, false);
  recordFrame(session, first.state, session.settings(), first.plan,
              TargetDisplay{.pass = 0, .area = {0, 0, size.width, size.height}});
  return session.picture();
}

// Draws two pictures, the second a moment later, while new memory is filled with one byte. lavapipe's images are such
// memory.
std::vector<std::vector<uint8_t>> picturesInMemoryOf(int fill, const std::string& scene, const SettingList& settings) {
  ::mallopt(M_PERTURB, fill);
  Options options = headless(sceneFile(scene), {96, 54}, settings);
  set(options, {{"reflection.max_passes", "12"}});
  std::vector<std::vector<uint8_t>> pictures;
  {
    QuietSession session(options);
    for (const double time : {0.0, 0.05}) {
      pictures.push_back(draw(session, time).rgba);
    }
  }
  ::mallopt(M_PERTURB, 1);  // the value of MALLOC_PERTURB_ in tests/CMakeLists.txt
  return pictures;
}

TEST(MirrorPictures, DoNotDependOnUnwrittenMemory) {
  const SettingList small = {{"reflection.samples", "1"}, {"reflection.scale", "0.53"}};
  std::vector<std::pair<std::string, SettingList>> cases = {
      {"single_plane", small},
      {"facing_mirrors", {{"reflection.update_interval", "3"}, {"reflection.scale", "0.7"}}},
      {"rough", {{"effects.rough_lookup", "image"}, {"effects.rough_samples", "4"}, {"reflection.scale", "0.7"}}}};
  if (fullTests()) {
    cases.insert(cases.end(), {{"mirror_maze", small},
                               {"outdoors", small},
                               {"gallery", small},
                               {"gallery", {{"reflection.update_interval", "3"}, {"reflection.scale", "0.7"}}},
                               {"single_plane", {{"reflection.samples", "1"}, {"reflection.scale", "1.7"}}}});
  }
  for (const auto& [scene, settings] : cases) {
    const auto dark = picturesInMemoryOf(1, scene, settings);
    const auto bright = picturesInMemoryOf(255, scene, settings);
    EXPECT_TRUE(dark == bright) << scene << ", " << settings[0].first << " = " << settings[0].second;
  }
}

TEST(MirrorPictures, DebugViewShowsTheMeanOfSamples) {
  const Image8 averaged = drawDebugView("4");
  EXPECT_LT(difference(averaged, drawDebugView("1"), 3).share(), 0.1);  // edges differ
  EXPECT_GT(difference(averaged, drawText("no_debug_view", room + left), 3).share(), 0.2);
}

TEST(MirrorPictures, ClearColorReachesPictureAndReflections) {
  Options options = headless(writeScene("clear_color", room + left + "reflectance = [1, 1, 1]\n"), size,
                             {{"view.clear_color", "0.25,0.5,1"}});
  const Image8 picture = draw(options);
  const std::array<uint8_t, 3> expected{137, 188, 255};
  for (const glm::ivec2 pixel : {glm::ivec2(310, 10), glm::ivec2(120, 72)}) {
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), picture.at(pixel.x, pixel.y))) << pixel.x;
  }
}

TEST(MirrorPictures, ManyMirrorsStayWithinTheirMemory) {
  QuietSession session(headless(sceneFile("many_mirrors"), {1280, 720},
                                {{"reflection.max_depth", "4"}, {"reflection.samples", "4"}, {"view.samples", "4"}}));
  session.draw(0.0, false);
  session.draw(1.0, false);
  session.renderer().waitIdle();
  EXPECT_LT(session.device().allocatedBytes(), 512u << 20);
}

TEST(MirrorPictures, MovingFramesKeepTheirMemory) {
  std::string text = turnedRoom();
  for (int i = 0; i < 8; ++i) {
    text += mirror(std::to_string(i), "position = [" + std::to_string(i - 3.5) + ", 1, " + std::to_string(8 + i % 3) +
                                          "]\nrotation = [0, 180, 0]\nsize = [0.9, 1.2]");
  }
  QuietSession session(headless(writeScene("moving", text), {96, 54}));
  const auto bytesAfter = [&](int frames, double step) {
    for (int i = 0; i < frames; ++i) {
      const double turn = step * (i % 20);
      session.setCamera(lookAt({std::sin(turn), 1, 5}, {3.0 * std::sin(2.0 * turn), 1, 9}, {0, 1, 0}, 60, 0.001));
      session.draw(0.0, false);
    }
    session.renderer().waitIdle();
    return session.device().allocatedBytes();
  };
  const uint64_t before = bytesAfter(10, 0.6);
  // Draws other views for longer than idle targets are kept.
  EXPECT_LT(static_cast<double>(bytesAfter(40, 0.3)), 1.2 * static_cast<double>(before));
}

// Bytes in use of all heaps of the C library, by the totals at the end of its report.
double heapMegabytes() {
  char* report = nullptr;
  size_t size = 0;
  std::FILE* file = ::open_memstream(&report, &size);
  ::malloc_info(0, file);
  std::fclose(file);
  const std::string text = report;
  std::free(report);
  const auto total = [&](const std::string& type) {
    const size_t at = text.find("size=\"", text.rfind("type=\"" + type + "\""));
    return at == std::string::npos ? 0.0 : std::stod(text.substr(at + 6));
  };
  return (total("current") - total("fast") - total("rest") + total("mmap")) / 1e6;
}

// A driver may compile a shader again for each draw, and keep it: a frame took 0.8 MB and more.
TEST(MirrorPictures, DriverKeepsNoMemoryOfFrames) {
  std::string manyLights = room + left + right + "fresnel = \"schlick\"\n";
  for (int i = 0; i < 20; ++i) {
    manyLights += "[[light]]\nposition = [" + std::to_string(i - 10) + ", 3, 4]\nintensity = 1\n";
  }
  const std::vector<std::pair<std::filesystem::path, SettingList>> cases = {
      {sceneFile("single_plane"), {}},
      {sceneFile("rough"), {{"effects.rough_lookup", "image"}, {"effects.rough_samples", "4"}}},
      {writeScene("many_lights", manyLights), {{"debug.check_finite", "true"}}}};
  for (const auto& [file, settings] : cases) {
    Options options = headless(file, {32, 18}, settings);
    options.validation = false;  // takes longer than the frames themselves
    QuietSession session(options);
    const auto leastOf = [&](int frames) {
      double least = 1e9;
      for (int i = 0; i < frames; ++i) {
        session.draw(0.02 * i, false);
        session.renderer().waitIdle();
        least = std::min(least, heapMegabytes());
      }
      return least;
    };
    leastOf(10);  // its threads take some 12 MB late
    const double before = leastOf(10);
    leastOf(20);
    EXPECT_LT(leastOf(10), before + 15.0) << file;
  }
}

TEST(MirrorPictures, UnseenMirrorsTakeNoMemory) {
  QuietSession with(headless(writeScene("away", turnedRoom() + left + right), size));
  QuietSession without(headless(writeScene("no_mirrors", turnedRoom()), size));
  for (Session* session : {&with, &without}) {
    session->draw(0.0, true);
    session->renderer().waitIdle();
  }
  EXPECT_TRUE(with.lastFrame().plan.drawnMirrors().empty());
  EXPECT_EQ(with.picture().rgba, without.picture().rgba);
  EXPECT_LE(with.device().allocatedBytes(), without.device().allocatedBytes() + 4096);
}

// Draws a mirror in a mirror at half the resolution, with several samples. The bytes are those of a picture of half the
// size, enlarged.
TEST(ViewScale, DrawsTheSmallerPictureEnlarged) {
  const Options options =
      headless(writeScene("scaled", turnedRoom() + left + right +
                                        mirror("big", "position = [0, 1, 9]\nrotation = [0, 180, 0]\nsize = [12, 8]")),
               size);
  QuietSession whole(options);
  Settings settings = whole.settings();
  for (const auto& [scale, drawn] : {std::pair(0.5, PictureSize{160, 90}), std::pair(0.125, PictureSize{40, 23})}) {
    settings.view.samples = settings.reflection.samples = 4;
    settings.view.scale = scale;
    settings.reflection.minPixels = 0.0;  // pixels of the picture, which differ
    whole.setSettings(settings);
    const Image8 picture = draw(whole);
    EXPECT_EQ(whole.lastFrame().plan.main().areaPx, drawn.width * drawn.height);
    const LinearImage radiance = whole.radiance();
    ASSERT_EQ(radiance.width, size.width);
    EXPECT_LE(difference(picture, toDisplay(radiance), 1).over, 0) << scale;
    if (drawn.width * size.height == drawn.height * size.width) {
      Options small = options;
      small.size = drawn;
      small.settings = {{"view.samples", "4"}, {"reflection.samples", "4"}, {"reflection.min_pixels", "0"}};
      Session half(small);
      EXPECT_TRUE(enlarged(drawRadiance(half), size.width, size.height).pixels == radiance.pixels);
    }
  }
}

// An image whose size is no whole number of texels is drawn up to its last texel, which ripples spread.
TEST(MirrorPictures, ImagesOfAnySizeReachTheirBorder) {
  const std::filesystem::path file = writeScene("border", R"(
[environment] sky = { zenith = [0.4, 0.5, 0.6], horizon = [0.4, 0.5, 0.6], ground = [0.4, 0.5, 0.6] }
[camera] position = [0, 0, 3], target = [0, 0, 0]
[settings] "effects.ripple_lookup" = "image"
[[mirror]] size = [60, 60], reflectance = [1, 1, 1], ripple = { amplitude = 0.02 }
)");
  Random random(55);
  for (int i = 0; i < 24; ++i) {
    const PictureSize any{20 + static_cast<int>(random.index(200)), 20 + static_cast<int>(random.index(120))};
    const SettingList settings{{"reflection.scale", std::to_string(random.uniform(0.1, 3.0))},
                               {"view.scale", std::to_string(random.uniform(0.3, 1.0))},
                               {"effects.ripple", random.chance(0.5) ? "true" : "false"}};
    const Image8 picture = draw(headless(file, any, settings));
    int different = 0;
    for (size_t k = 0; k < picture.rgba.size(); ++k) {
      different += std::abs(picture.rgba[k] - picture.rgba[k % 4]) > 1;
    }
    EXPECT_EQ(different, 0) << any.width << "x" << any.height << ", scale " << settings[0].second;
  }
}

// Blurring reads the image beside the visible region, so that part must be drawn too. In a scene of one color the
// mirror then has that color.
TEST(MirrorPictures, BlurredImagesAreDrawnBesideTheirMirror) {
  const std::filesystem::path file = writeScene("one_color", R"(
[environment] sky = { zenith = [0.4, 0.5, 0.6], horizon = [0.4, 0.5, 0.6], ground = [0.4, 0.5, 0.6] }
[camera] position = [0, 0, 3], target = [0, 0, 0]
[settings] "effects.rough_lookup" = "image"
[[mirror]] rotation = [15, 30, 20], size = [1.6, 1], roughness = 0.4, reflectance = [1, 1, 1]
)");
  const Image8 picture = draw(headless(file, size));
  for (size_t i = 0; i < picture.rgba.size(); ++i) {
    ASSERT_NEAR(picture.rgba[i], picture.rgba[i % 4], 1) << "pixel " << i / 4;
  }
}

}  // namespace
}  // namespace speculum
