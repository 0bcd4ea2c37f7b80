#include "scene_support.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

void expectFault(const std::string& text, const std::string& place, const std::string& part) {
  const std::string message = sceneFaultOf(text);
  EXPECT_TRUE(message.starts_with(place + " ")) << message << "\nexpected at " << place;
  EXPECT_TRUE(contains(message, part)) << message << "\nexpected to hold " << part;
  EXPECT_FALSE(contains(message, "\n"));
  EXPECT_EQ(message.back(), ')') << message;
}

class SceneFault : public testing::TestWithParam<Fault> {};

// The text of a case begins at line 4.
TEST_P(SceneFault, NamesLineAndKey) {
  expectFault(kCamera + GetParam().text, GetParam().place, GetParam().message);
}

std::string nameOf(const testing::TestParamInfo<Fault>& info) {
  return info.param.name;
}

const std::string kObject = "[[object]]\nmodel = 'triangle.obj'\n";
const std::string kLight = "[[light]]\nposition = [0, 2, 0]\n";
const std::string kMirror = "[[mirror]]\nsize = [2, 1]\n";

INSTANTIATE_TEST_SUITE_P(
    File, SceneFault,
    testing::Values(Fault{"UnknownTable", "[mirors]\n", "4: mirors:", "did you mean 'mirror'?"},
                    Fault{"UnknownKeyFarFromAny", "[weather]\n", "4: weather:", "one of: title environment"},
                    Fault{"Malformed", "\n[environment\n", "5: toml:", "a TOML 1.0 file is needed"},
                    Fault{"DuplicateKey", "near = 1\nnear = 2\n", "5: toml:", "near"},
                    Fault{"TitleIsNumber", "[settings]\n[[light]]\nname = 3\n", "6: light[0].name:", "is an integer"}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Camera, SceneFault,
    testing::Values(Fault{"UnknownKey", "verticl_fov = 60\n", "4: camera.verticl_fov:", "did you mean 'vertical_fov'?"},
                    Fault{"FovTooLarge", "vertical_fov = 170.5\n", "4: camera.vertical_fov:", "is 170.5"},
                    Fault{"FovIsString", "vertical_fov = '60'\n", "4: camera.vertical_fov:", "is a string"},
                    Fault{"NearZero", "near = 0\n", "4: camera.near:", "above 0"},
                    Fault{"OrbitSpeedNan", "orbit_speed = nan\n", "4: camera.orbit_speed:", "finite"},
                    Fault{"UpZero", "up = [0, 0, 0]\n", "4: camera.up:", "no direction"},
                    Fault{"UpParallel", "up = [0, 0, -2]\n", "4: camera.up:", "parallel"},
                    Fault{"UpTooShort", "up = [0, 1]\n", "4: camera.up:", "has 2 elements"},
                    Fault{"UpHoldsString", "up = [0,\n '1',\n 0]\n", "5: camera.up[1]:", "is a string"}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Environment, SceneFault,
    testing::Values(Fault{"IsNoTable", "[[environment]]\n", "4: environment:", "a table is needed"},
                    Fault{"NegativeBackground", "[environment]\nbackground = [0, -0.1, 0]\n",
                          "5: environment.background[1]:", "0 .. 1e"},
                    Fault{"SkyWithoutGround", "[environment]\nsky = { zenith = [0,0,0], horizon = [0,0,0] }\n",
                          "5: environment.sky.ground:", "is missing"},
                    Fault{"SkyUnknownKey", "[environment.sky]\nzenit = [0,0,0]\n",
                          "5: environment.sky.zenit:", "did you mean 'zenith'?"}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(Settings, SceneFault,
                         testing::Values(Fault{"IsArray", "[[settings]]\n", "4: settings:", "a table is needed"},
                                         Fault{"IsDate", "[settings]\n'view.exposure' = 2024-01-01\n",
                                               "5: settings.view.exposure:", "is a date"},
                                         Fault{"IsNan", "[settings]\nview.exposure = nan\n",
                                               "5: settings.view.exposure:", "not finite"},
                                         Fault{"ArrayOfStrings", "[settings]\nview.clear_color = [0,\n'a', 0]\n",
                                               "6: settings.view.clear_color:", "not a finite number"},
                                         Fault{"SetTwice", "[settings]\n'view.exposure' = 1\nview.exposure = 2\n",
                                               "5: settings.view.exposure:", "is set twice"}),
                         nameOf);

INSTANTIATE_TEST_SUITE_P(
    Object, SceneFault,
    testing::Values(
        Fault{"SingleTable", "[object]\nmodel = 'triangle.obj'\n", "4: object:", "[[object]]"},
        Fault{"ArrayOfNumbers", "[settings]\n[[light]]\nposition = [0,0,0]\norbit = 3\n",
              "7: light[0].orbit:", "a table is needed"},
        Fault{"NoModel", "[[object]]\nposition = [0, 0, 0]\n", "4: object[0].model:", "is missing"},
        Fault{"ModelMissing", "[[object]]\nmodel = 'none.obj'\n", "5: object[0].model:", "none.obj"},
        Fault{"ModelIsFolder", "[[object]]\nmodel = '.'\n", "5: object[0].model:", "there is no file"},
        Fault{"ModelEmpty", "[[object]]\nmodel = ''\n", "5: object[0].model:", "there is no file"},
        Fault{"SecondObjectByIndex", kObject + "[[object]]\nmodle = 'x'\n", "7: object[1].modle:", "'model'"},
        Fault{"ByName", kObject + "name = 'knot'\nscale = 0\n", "7: object[knot].scale:", "is zero"},
        Fault{"RoughnessOfACurvedMirror", kObject + "mirror = { roughness = 0 }\n",
              "6: object[0].mirror.roughness:", "not a known key"},
        Fault{"CurvedMirrorIsNumber", kObject + "mirror = 1\n", "6: object[0].mirror:", "is an integer"},
        Fault{"ScaleInfinite", kObject + "scale = inf\n", "6: object[0].scale:", "finite"},
        Fault{"ScaleIsString", kObject + "scale = 'big'\n", "6: object[0].scale:", "a number or an array"},
        Fault{"PositionNan", kObject + "position = [0, nan, 0]\n", "6: object[0].position[1]:", "finite"},
        Fault{"SpinIsBoolean", kObject + "spin = true\n", "6: object[0].spin:", "is a boolean"},
        Fault{"CopiesZero", kObject + "copies = { count = 0 }\n", "6: object[0].copies.count:", "1 .. 1000000"},
        Fault{"CopiesFraction", kObject + "copies = { count = 2.0 }\n", "6: object[0].copies.count:", "an integer"}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Light, SceneFault,
    testing::Values(
        Fault{"NoPosition", "[[light]]\nglow = 1\n", "4: light[0].position:", "is missing"},
        Fault{"UnknownKey", kLight + "colour = [1,1,1]\n", "6: light[0].colour:", "did you mean 'color'?"},
        Fault{"CastsShadowIsNumber", kLight + "casts_shadow = 1\n", "6: light[0].casts_shadow:", "true or false"},
        Fault{"OrbitAxisZero", kLight + "orbit = { axis = [0, 0, 0] }\n", "6: light[0].orbit.axis:", "no direction"}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Mirror, SceneFault,
    testing::Values(
        Fault{"NoShape", "[[mirror]]\nposition = [0, 0, 0]\n", "4: mirror[0].size:", "or polygon"},
        Fault{"UnknownKey", kMirror + "reflectence = 1\n", "6: mirror[0].reflectence:", "'reflectance'"},
        Fault{"SizeNegative", "[[mirror]]\nsize = [-1, 1]\n", "5: mirror[0].size[0]:", "above 0"},
        Fault{"SizeOfThree", "[[mirror]]\nsize = [1, 1, 1]\n", "5: mirror[0].size:", "array of 2 numbers"},
        Fault{"SizeBelowArithmetic", "[[mirror]]\nsize = [1e-200, 1e-200]\n", "5: mirror[0].size:", "has no area"},
        Fault{"PolygonAndSize", kMirror + "polygon = [[0,0,0],[1,0,0],[0,1,0]]\n", "5: mirror[0].size:", "polygon"},
        Fault{"PolygonAndPosition", "[[mirror]]\npolygon = [[0,0,0],[1,0,0],[0,1,0]]\nposition = [0,0,0]\n",
              "6: mirror[0].position:", "polygon"},
        Fault{"PolygonAndRotation", "[[mirror]]\npolygon = [[0,0,0],[1,0,0],[0,1,0]]\nrotation = [0,0,0]\n",
              "6: mirror[0].rotation:", "polygon"},
        Fault{"PolygonAndSpin", "[[mirror]]\npolygon = [[0,0,0],[1,0,0],[0,1,0]]\nspin = [0,0,0]\n",
              "6: mirror[0].spin:", "polygon"},
        Fault{"PolygonOfTwo", "[[mirror]]\npolygon = [[0,0,0],[1,0,0]]\n", "5: mirror[0].polygon:", "fewer than 3"},
        Fault{"PolygonNotConvex", "[[mirror]]\npolygon = [[0,0,0],[2,0,0],[0.5,0.5,0],[0,2,0]]\n",
              "5: mirror[0].polygon:", "not convex"},
        Fault{"PolygonNan", "[[mirror]]\npolygon = [[0,0,0],\n[1,0,nan],[0,1,0]]\n",
              "6: mirror[0].polygon[1][2]:", "finite"},
        Fault{"PolygonOfNumbers", "[[mirror]]\npolygon = [1, 2, 3]\n", "5: mirror[0].polygon[0]:", "an array of 3"},
        Fault{"ReflectanceAboveOne", kMirror + "reflectance = [1, 1.01, 1]\n",
              "6: mirror[0].reflectance[1]:", "0 .. 1"},
        Fault{"ReflectanceIsNumber", kMirror + "reflectance = 1\n", "6: mirror[0].reflectance:", "array of 3 numbers"},
        Fault{"FresnelUnknown", kMirror + "fresnel = 'shlick'\n", "6: mirror[0].fresnel:", "did you mean 'schlick'?"},
        Fault{"NameCannotBreakTheLine", kMirror + "name = \"a\\nb\"\nfresnel = 1\n",
              "7: mirror[a?b].fresnel:", "is an integer"}),
    nameOf);

const std::string kBookmark = "[[bookmark]]\nname = 'door'\n";
const std::string kDoor = kBookmark + "position = [0, 1, 4]\ntarget = [0, 1, 0]\n";

INSTANTIATE_TEST_SUITE_P(
    Bookmark, SceneFault,
    testing::Values(
        Fault{"WithoutName", "[[bookmark]]\nposition = [0, 0, 1]\n", "4: bookmark[0].name:", "is missing"},
        Fault{"NameIsEmpty", "[[bookmark]]\nname = ''\n", "5: bookmark[0].name:", "is empty"},
        Fault{"NameOfAnother", kDoor + kDoor, "9: bookmark[door].name:", "another bookmark's"},
        Fault{"WithoutPosition", kBookmark + "target = [0, 0, 1]\n", "4: bookmark[door].position:", "is missing"},
        Fault{"WithoutTarget", kBookmark + "position = [0, 0, 1]\n", "4: bookmark[door].target:", "is missing"},
        Fault{"TargetIsPosition", kBookmark + "position = [0, 0, 1]\ntarget = [0, 0, 1]\n",
              "7: bookmark[door].target:", "away from position"},
        Fault{"AlongTheUpOfTheCamera", kBookmark + "position = [0, 5, 1]\ntarget = [0, 0, 1]\n",
              "7: bookmark[door].target:", "parallel"},
        Fault{"UpIsZero", kDoor + "up = [0, 0, 0]\n", "8: bookmark[door].up:", "has no direction"},
        Fault{"UnknownKey", kDoor + "fov = 40\n", "8: bookmark[door].fov:", "one of: name"}),
    nameOf);

TEST(SceneFaults, CameraParts) {
  expectFault("", "1: camera:", "is missing");
  expectFault("title = 'x'\n\n[camera]\ntarget = [0, 0, 0]\n", "3: camera.position:", "is missing");
  expectFault("[camera]\nposition = [0, 0, 0]\n", "1: camera.target:", "is missing");
  expectFault("[camera]\nposition = [1, 2, 3]\ntarget = [1, 2, 3]\n", "3: camera.target:", "away from position");
  expectFault("[camera]\nposition = [0, 4, 0]\ntarget = [0, 0, 0]\n", "3: camera.target:", "parallel");
  expectFault("title = 3\n", "1: title:", "is an integer");
  expectFault("camera = 3\n", "1: camera:", "a table is needed");
}

TEST(SceneFaults, FirstUnknownKeyIsNamed) {
  expectFault("[camera]\nzebra = 1\napple = 2\n", "2: camera.zebra:", "not a known key");
}

TEST(SceneFaults, MissingFilesAndFolders) {
  const TemporaryFolder folder;
  const std::string missing = messageOf<InputError>([&] { loadScene(folder / "none.toml"); });
  EXPECT_EQ(missing, (folder / "none.toml").string() +
                         ":1: file: cannot be read: No such file or directory (a scene file is needed)");
  const std::string directory = messageOf<InputError>([&] { loadScene(folder / ""); });
  EXPECT_TRUE(contains(directory, ":1: file: is a folder (a scene file is needed)"));
}

TEST(SceneFaults, GarbageIsAnError) {
  expectFault(std::string("\x00\xff\xfe\x80garbage", 12), "1: toml:", "a TOML 1.0 file is needed");
  expectFault(std::string(100'000, '['), "1: toml:", "a TOML 1.0 file is needed");
  expectFault("a = " + std::string(100'000, '['), "1: toml:", "a TOML 1.0 file is needed");
}

TEST(SceneFaults, ModelErrorsNameTheModelFile) {
  const TemporaryFolder folder;
  folder.write("models/bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
  const auto scene = folder.write("scenes/a.toml", kCamera + "[[object]]\nmodel = '../models/bad.obj'\n");
  const std::string message = messageOf<InputError>([&] { loadScene(scene); });
  EXPECT_EQ(message.rfind((folder / "models/bad.obj").string() + ":4: f: ", 0), 0u) << message;
}

}  // namespace
}  // namespace speculum
