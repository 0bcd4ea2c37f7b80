#include <sys/stat.h>

#include <ctime>

#include "scene/scene_state.hpp"
#include "scene/support.hpp"
#include "scene/toml_file.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

std::string faultOf(const std::string& text) {
  return sceneFaultOf(usualCamera + text);
}

// A regular polygon of radius 1.
std::string polygonOf(int vertices) {
  std::string text = "[[mirror]]\npolygon = [";
  for (int i = 0; i < vertices; ++i) {
    const double angle = 2.0 * 3.14159265358979323846 * i / vertices;
    text += "[" + std::to_string(std::cos(angle)) + ", " + std::to_string(std::sin(angle)) + ", 0],\n";
  }
  return text + "]\n";
}

TEST(SceneLimits, KeysOfManyPartsAreNotParsed) {
  const std::string deep = repeated("a.", 200'000) + "a";
  const std::string fault = " toml: a key has too many parts (no key of a scene file has more than 3)";
  EXPECT_EQ(faultOf("[settings]\n" + deep + " = 1\n"), "5:" + fault);
  EXPECT_EQ(faultOf("[" + deep + "]\n"), "4:" + fault);
  EXPECT_EQ(faultOf("\n[[" + deep + "]]\n"), "5:" + fault);
  EXPECT_EQ(faultOf("[settings]\nx = { " + deep + " = 1 }\n"), "5:" + fault);
  EXPECT_EQ(faultOf("[settings]\n" + repeated("\"a\" . ", 200'000) + "b = 1\n"), "5:" + fault);
}

TEST(TomlDepth, CountsThePartsOfOneKey) {
  EXPECT_EQ(lineOfTooDeepKey(repeated("a.", 31) + "a = 1\n"), 0);
  EXPECT_EQ(lineOfTooDeepKey(repeated("a.", 32) + "a = 1\n"), 1);
  EXPECT_EQ(lineOfTooDeepKey(repeated("a.b = 1\n", 100)), 0);
  EXPECT_EQ(lineOfTooDeepKey("[" + repeated("[0.5, 0.25, 1.5], ", 100) + "]"), 0);
}

TEST(TomlDepth, DotsInStringsAndCommentsAreIgnored) {
  const std::string dots(100, '.');
  EXPECT_EQ(lineOfTooDeepKey("title = \"" + dots + "\"\n"), 0);
  EXPECT_EQ(lineOfTooDeepKey("title = \"\\\"" + dots + "\"\n"), 0);
  EXPECT_EQ(lineOfTooDeepKey("title = '" + dots + "'\n"), 0);
  EXPECT_EQ(lineOfTooDeepKey("title = \"\"\"\n\"" + dots + "\n\"\"\"\n"), 0);
  EXPECT_EQ(lineOfTooDeepKey("title = '''" + dots + "\n'" + dots + "'''\n"), 0);
  EXPECT_EQ(lineOfTooDeepKey("# " + dots + "\ntitle = '' # " + dots + "\n"), 0);
}

TEST(TomlDepth, StringsHideNothingBehindThem) {
  const std::string deep = repeated("a.", 40) + "a = 1";
  EXPECT_EQ(lineOfTooDeepKey("t = \"\"\n" + deep), 2);
  EXPECT_EQ(lineOfTooDeepKey("t = \"\\\\\"\n" + deep), 2);
  EXPECT_EQ(lineOfTooDeepKey("t = '\\'\n" + deep), 2);
  EXPECT_EQ(lineOfTooDeepKey("t = [\"\"\"\nx\"\"\"\"\", {" + deep + "}]"), 2);
  EXPECT_EQ(lineOfTooDeepKey("t = ['''\n\nx'''', {" + deep + "}]"), 3);
  EXPECT_EQ(lineOfTooDeepKey("# \"\n" + deep), 2);
}

TEST(SceneLimits, CharactersBeyondAsciiStandInQuotationMarks) {
  const std::string fault =
      " toml: a character that is not ASCII stands outside quotation marks (a TOML 1.0 file is needed, which quotes "
      "such "
      "keys and texts)";
  EXPECT_EQ(faultOf("near = 1 \xc3\xa9\n"), "4:" + fault);
  EXPECT_EQ(faultOf("\n\"\" # \xc3\xa9\n\xc2\xa0near = 1\n"), "6:" + fault);
  EXPECT_EQ(faultOf("near = [1,\n\xd0\xa2\n"), "5:" + fault);
  EXPECT_EQ(faultOf("# \xc3\xa9\n[[light]]\nname = \"\xc3\xa9\" # \xc3\xa9\nposition = [0, 0, 0]\n"),
            "nothing was thrown");
  EXPECT_EQ(lineOfStrayCharacter("a = 1\n\"\"\"\n\xc3\xa9\"\"\"\n'\xc3\xa9'\n\xff"), 5);
}

TEST(SceneLimits, DeeplyNestedValuesAreRefused) {
  EXPECT_TRUE(contains(faultOf("x = " + repeated("{ a = ", 100'000)), "4: toml: "));
}

TEST(SceneLimits, PolygonsOfUpTo1000Vertices) {
  const TemporaryFolder folder;
  EXPECT_EQ(loadScene(folder.write("a.toml", usualCamera + polygonOf(1000))).mirrors[0].polygon.size(), 1000u);
  EXPECT_EQ(faultOf(polygonOf(1001)), "5: mirror[0].polygon: has 1001 vertices (3 .. 1000 are needed)");
}

TEST(SceneLimits, ScalesStayInTheRangeOfDoubles) {
  const std::string object = "[[object]]\nmodel = 'triangle.obj'\n";
  for (const std::string scale : {"1e-320", "1e-110", "1e110", "[1e200, 1, 1e200]"}) {
    EXPECT_EQ(faultOf(object + "scale = " + scale + "\n"),
              "6: object[0].scale: leaves the range of double precision (scales nearer to 1 are needed)");
  }
  EXPECT_EQ(faultOf(object + "scale = [1e-100, 1e100, -1]\n"),
            "6: object[0].scale: makes the model too large (at most 1e+35 m are needed)");
  EXPECT_EQ(faultOf(object + "scale = [1e-30, 1e30, -1]\n"), "nothing was thrown");
  EXPECT_EQ(faultOf(object + "mirror = {}\nscale = [1e-30, 1e30, -1]\n"),
            "7: object[0].scale: makes the model too large (at most 1e+18 m are needed of a curved mirror)");
}

TEST(SceneLimits, AllCopiesTogetherAreLimited) {
  const auto object = [](int copies) {
    return "[[object]]\nmodel = 'triangle.obj'\ncopies = { count = " + std::to_string(copies) + " }\n";
  };
  EXPECT_EQ(faultOf(object(600'000) + object(400'000)), "nothing was thrown");
  EXPECT_EQ(faultOf(object(600'000) + object(400'000) + object(1)),
            "12: object[2].copies: makes more than 1000000 objects of the scene (fewer copies are needed)");
}

TEST(SceneLimits, PositionsAndSpeedsStayFinite) {
  const std::string mirror = "[[mirror]]\nsize = [1e6, 1e6]\n";
  EXPECT_EQ(faultOf(mirror + "position = [1e15, -1e15, 0]\nspin = [1e9, 0, -1e9]\n"), "nothing was thrown");
  EXPECT_EQ(faultOf(mirror + "position = [1.1e15, 0, 0]\n"),
            "6: mirror[0].position[0]: is 1100000000000000 (a finite number -1e15 .. 1e15 is needed)");
  EXPECT_EQ(faultOf(mirror + "spin = [0, 1.1e9, 0]\n"),
            "6: mirror[0].spin[1]: is 1100000000 (a finite number -1e9 .. 1e9 is needed)");
  EXPECT_EQ(faultOf("[[mirror]]\nsize = [1, 1]\nposition = [0, 0, 2e10]\n"),
            "6: mirror[0].position: is too far from the origin for the mirror's size "
            "(at most 1e10 times its width and height are needed)");
  EXPECT_EQ(faultOf("[[light]]\nposition = [0, 0, 0]\nradius = 1e16\n"),
            "6: light[0].radius: is 1e+16 (a finite number above 0 and up to 1e15 is needed)");
  EXPECT_EQ(faultOf("up = [0, 1e-31, 0]\n"),
            "4: camera.up: has no direction (a vector that is not zero, such as [0, 1, 0], is needed)");
}

TEST(SceneLimits, SettingsAreNotNestedDeeply) {
  EXPECT_EQ(faultOf("[settings]\na.b.c.d.e.f.g.h = 1\n"), "nothing was thrown") << "unknown, but read";
  EXPECT_EQ(faultOf("[settings]\na.b.c.d.e.f.g.h.i = 1\n"),
            "5: settings.a.b.c.d.e.f.g.h: has too many parts (no setting has more than 2)");
}

// Computing eye and target anew at each time would at some angle round them to one point.
TEST(SceneLimits, CameraOrbitsANearlyTouchedTarget) {
  const TemporaryFolder folder;
  const Scene scene =
      loadScene(folder.write("scene.toml",
                             "[camera]\nposition = [10000000.000000002, 1e9, 1e9]\ntarget = [1e7, 1e9, 1e9]\n"
                             "up = [1, 3, 1]\norbit_speed = 37\n"));
  const double angle = glm::radians(60.0);
  for (int second = 0; second < 1000; ++second) {
    const CameraPose pose = evaluate(scene, second).camera;
    EXPECT_EQ(pose.verticalFov, angle);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(glm::length(pose.worldToView[i]), 1.0, 1e-14) << second;
    }
  }
}

TEST(SceneLimits, ManySettingsAreReadInShortTime) {
  const TemporaryFolder folder;
  std::string text = usualCamera + "[settings]\n";
  for (int i = 0; i < 200'000; ++i) {
    text += "key" + std::to_string(i) + " = " + std::to_string(i) + "\n";
  }
  const std::clock_t start = std::clock();
  const Scene scene = loadScene(folder.write("scene.toml", text));
  EXPECT_LT(std::clock() - start, 30 * CLOCKS_PER_SEC);
  ASSERT_EQ(scene.settings.size(), 200'000u);
  EXPECT_EQ(scene.settings.back().key, "key199999");
  EXPECT_EQ(scene.settings.back().line, 200'004);
}

TEST(SceneLimits, PipesDevicesAndHugeFilesAreRefused) {
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder / "pipe.toml";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(messageOf<InputError>([&] { loadScene(pipe); }),
            pipe.string() + ":1: file: is a device or pipe (a scene file is needed)");
  EXPECT_EQ(messageOf<InputError>([] { loadScene("/dev/zero"); }),
            "/dev/zero:1: file: is a device or pipe (a scene file is needed)");
  EXPECT_EQ(sceneFaultOf(usualCamera + "[[object]]\nmodel = '" + pipe.string() + "'\n"),
            "5: object[0].model: '" + pipe.string() +
                "' is a device or pipe (name a Wavefront OBJ or glTF 2.0 file, relative to the scene file)");
  const std::filesystem::path huge = folder.write("huge.toml", usualCamera);
  std::filesystem::resize_file(huge, (16u << 20) + 1);
  EXPECT_EQ(messageOf<InputError>([&] { loadScene(huge); }),
            huge.string() + ":1: file: is larger than 16 MiB (a scene file is needed)");
}

TEST(SceneLimits, LineEndsAndMarksKeepLineNumbers) {
  EXPECT_EQ(faultOf("\r\nnear = 0\r\n"), "5: camera.near: is 0 (a finite number above 0 is needed)");
  const TemporaryFolder folder;
  const auto file = folder.write("scene.toml", "\xef\xbb\xbf" + usualCamera + "near = 0\n");
  EXPECT_EQ(messageOf<InputError>([&] { loadScene(file); }),
            file.string() + ":4: camera.near: is 0 (a finite number above 0 is needed)");
}

TEST(SceneLimits, ModelsAreFoundThroughLinkedFolders) {
  const TemporaryFolder folder;
  folder.write("far/models/box.obj", triangleObj);
  std::filesystem::create_directories(folder / "far/parts");
  std::filesystem::create_directory_symlink(folder / "far/parts", folder / "parts");
  const auto file = folder.write("scene.toml", usualCamera + "[[object]]\nmodel = 'parts/../models/box.obj'\n" +
                                                   "[[object]]\nmodel = 'far/models/box.obj'\n");
  EXPECT_EQ(loadScene(file).meshes.size(), 1u);
}

}  // namespace
}  // namespace speculum
