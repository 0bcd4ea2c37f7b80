#include "scene_support.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

void expectFault(const std::string& text, const std::string& place, const std::string& part) {
  const std::string message = sceneFaultOf(text);
  EXPECT_TRUE(startsWith(message, place + " ")) << "\nexpected at " << place;
  EXPECT_TRUE(contains(message, part)) << message << "\nexpected to hold " << part;
  EXPECT_FALSE(contains(message, "\n"));
  EXPECT_EQ(message.back(), ')') << message;
}

class SceneFault : public testing::TestWithParam<Fault> {};

// The text of a case begins at line 4.
TEST_P(SceneFault, NamesLineAndKey) {
  expectFault(kCamera + GetParam().text, GetParam().place, GetParam().message);
}

const std::string kObject = "[[object]]\nmodel = 'triangle.obj'\n";
const std::string kLight = "[[light]]\nposition = [0, 2, 0]\n";
const std::string kMirror = "[[mirror]]\nsize = [2, 1]\n";
const std::string kPolygonMirror = "[[mirror]]\npolygon = [[0,0,0],[1,0,0],[0,1,0]]\n";
const std::string kBookmark = "[[bookmark]]\nname = 'door'\n";
const std::string kDoor = kBookmark + "position = [0, 1, 4]\ntarget = [0, 1, 0]\n";

const std::vector<Fault> kFaults = {
    {"QualityIsNoTable", kMirror + "quality = 0.5\n", "6: mirror[0].quality:", "a table is needed"},
    {"QualityUnknownKey", kMirror + "quality = { scal = 1 }\n", "6: mirror[0].quality.scal:", "did you mean 'scale'?"},
    {"QualityScaleTooSmall", kMirror + "quality = { scale = 0.1 }\n", "6: mirror[0].quality.scale:", "0.125 .. 4"},
    {"QualityScaleTooLarge", kMirror + "[mirror.quality]\nscale = 4.5\n", "7: mirror[0].quality.scale:", "is 4.5"},
    {"QualityScaleNan", kMirror + "quality = { scale = nan }\n", "6: mirror[0].quality.scale:", "0.125 .. 4"},
    {"QualityScaleIsString", kMirror + "quality.scale = '1'\n", "6: mirror[0].quality.scale:", "is a string"},
    {"QualitySamplesBetween", kMirror + "quality = { samples = 3 }\n",
     "6: mirror[0].quality.samples:", "is 3 (one of 1 2 4 8 is needed)"},
    {"QualitySamplesTooMany", kMirror + "quality = { samples = 16 }\n",
     "6: mirror[0].quality.samples:", "is 16 (one of 1 2 4 8 is needed)"},
    {"QualitySamplesNone", kMirror + "quality = { samples = 0 }\n", "6: mirror[0].quality.samples:", "1 2 4 8"},
    {"QualitySamplesFraction", kMirror + "quality = { samples = 2.0 }\n", "6: mirror[0].quality.samples:", "1 2 4 8"},
    {"QualityIntervalNone", kMirror + "quality = { update_interval = 0 }\n",
     "6: mirror[0].quality.update_interval:", "an integer 1 .. 1000000 is needed"},
    {"QualityIntervalTooLong", kMirror + "quality = { update_interval = 1000001 }\n",
     "6: mirror[0].quality.update_interval:", "is 1000001"},
    {"QualityMethodUnknown", kMirror + "quality = { method = 'ray' }\n",
     "6: mirror[0].quality.method:", "did you mean 'rays'?"},
    {"QualityMethodIsNumber", kMirror + "quality = { method = 1 }\n", "6: mirror[0].quality.method:", "is an integer"},
    {"QualityOfCurvedMirror", kObject + "mirror = { quality = { scale = 1 } }\n",
     "6: object[0].mirror.quality:", "one of: reflectance fresnel base_color"},
    {"UnknownTable", "[mirors]\n", "4: mirors:", "did you mean 'mirror'?"},
    {"UnknownKeyFarFromAny", "[weather]\n", "4: weather:", "one of: title environment"},
    {"Malformed", "\n[environment\n",
     "5: toml:", "in '[environment' (a TOML 1.0 file is needed, where [name] begins a table"},
    {"DuplicateKey", "near = 1\nnear = 2\n",
     "5: toml:", "'near', in 'near = 2' (a TOML 1.0 file is needed, where a key"},
    {"MissingEquals", "  near 1\n",
     "4: toml:", "expected '=', saw '1', in 'near 1' (a TOML 1.0 file is needed, where a "},
    {"NumbersWithoutBrackets", "up = 0, 1, 0\n", "4: toml:", "several numbers as [1, 2, 3]"},
    {"TextWithoutQuotes", "[[light]]\nname = ball\n", "5: toml:", "a text in quotation marks"},
    {"TextWithoutEnd", "[[light]]\nname = 'ball\n", "5: toml:", "a text ends with the quotation marks that begin it"},
    {"NumberWithoutDigits", "near = 1.\n", "4: toml:", "in 'near = 1.' (a TOML 1.0 file is needed, where a number is"},
    {"ArrayWithoutComma", "up = [0, 1 0]\n", "4: toml:", "an array is [1, 2, 3]"},
    {"TitleIsNumber", "[settings]\n[[light]]\nname = 3\n", "6: light[0].name:", "is an integer"},
    {"CameraUnknownKey", "verticl_fov = 60\n", "4: camera.verticl_fov:", "did you mean 'vertical_fov'?"},
    {"CameraFovTooLarge", "vertical_fov = 170.5\n", "4: camera.vertical_fov:", "is 170.5"},
    {"CameraFovIsString", "vertical_fov = '60'\n", "4: camera.vertical_fov:", "is a string"},
    {"CameraNearZero", "near = 0\n", "4: camera.near:", "above 0"},
    {"CameraOrbitSpeedNan", "orbit_speed = nan\n", "4: camera.orbit_speed:", "finite"},
    {"CameraUpZero", "up = [0, 0, 0]\n", "4: camera.up:", "no direction"},
    {"CameraUpParallel", "up = [0, 0, -2]\n", "4: camera.up:", "parallel"},
    {"CameraUpTooShort", "up = [0, 1]\n", "4: camera.up:", "has 2 elements"},
    {"CameraUpHoldsString", "up = [0,\n '1',\n 0]\n", "5: camera.up[1]:", "is a string"},
    {"EnvironmentIsNoTable", "[[environment]]\n", "4: environment:", "a table is needed"},
    {"EnvironmentNegativeBackground", "[environment]\nbackground = [0, -0.1, 0]\n",
     "5: environment.background[1]:", "0 .. 1e"},
    {"EnvironmentSkyWithoutGround", "[environment]\nsky = { zenith = [0,0,0], horizon = [0,0,0] }\n",
     "5: environment.sky.ground:", "is missing"},
    {"EnvironmentSkyUnknownKey", "[environment.sky]\nzenit = [0,0,0]\n",
     "5: environment.sky.zenit:", "did you mean 'zenith'?"},
    {"SettingsIsArray", "[[settings]]\n", "4: settings:", "a table is needed"},
    {"SettingsIsDate", "[settings]\n'view.exposure' = 2024-01-01\n", "5: settings.view.exposure:", "is a date"},
    {"SettingsIsNan", "[settings]\nview.exposure = nan\n", "5: settings.view.exposure:", "not finite"},
    {"SettingsArrayOfStrings", "[settings]\nview.clear_color = [0,\n'a', 0]\n",
     "6: settings.view.clear_color:", "not a finite number"},
    {"SettingsSetTwice", "[settings]\n'view.exposure' = 1\nview.exposure = 2\n",
     "5: settings.view.exposure:", "is set twice"},
    {"ObjectSingleTable", "[object]\nmodel = 'triangle.obj'\n", "4: object:", "[[object]]"},
    {"ObjectArrayOfNumbers", "[settings]\n[[light]]\nposition = [0,0,0]\norbit = 3\n",
     "7: light[0].orbit:", "a table is needed"},
    {"ObjectNoModel", "[[object]]\nposition = [0, 0, 0]\n", "4: object[0].model:", "is missing"},
    {"ObjectModelMissing", "[[object]]\nmodel = 'none.obj'\n", "5: object[0].model:", "none.obj"},
    {"ObjectModelIsFolder", "[[object]]\nmodel = '.'\n", "5: object[0].model:", "there is no file"},
    {"ObjectModelEmpty", "[[object]]\nmodel = ''\n", "5: object[0].model:", "there is no file"},
    {"ObjectSecondObjectByIndex", kObject + "[[object]]\nmodle = 'x'\n", "7: object[1].modle:", "'model'"},
    {"ObjectByName", kObject + "name = 'knot'\nscale = 0\n", "7: object[knot].scale:", "is zero"},
    {"ObjectRoughnessOfACurvedMirror", kObject + "mirror = { roughness = 0 }\n",
     "6: object[0].mirror.roughness:", "not a known key"},
    {"ObjectCurvedMirrorIsNumber", kObject + "mirror = 1\n", "6: object[0].mirror:", "is an integer"},
    {"ObjectScaleInfinite", kObject + "scale = inf\n", "6: object[0].scale:", "finite"},
    {"ObjectScaleIsString", kObject + "scale = 'big'\n", "6: object[0].scale:", "a number or an array"},
    {"ObjectPositionNan", kObject + "position = [0, nan, 0]\n", "6: object[0].position[1]:", "finite"},
    {"ObjectSpinIsBoolean", kObject + "spin = true\n", "6: object[0].spin:", "is a boolean"},
    {"ObjectCopiesZero", kObject + "copies = { count = 0 }\n", "6: object[0].copies.count:", "1 .. 1000000"},
    {"ObjectCopiesFraction", kObject + "copies = { count = 2.0 }\n", "6: object[0].copies.count:", "an integer"},
    {"LightNoPosition", "[[light]]\nglow = 1\n", "4: light[0].position:", "is missing"},
    {"LightUnknownKey", kLight + "colour = [1,1,1]\n", "6: light[0].colour:", "did you mean 'color'?"},
    {"LightCastsShadowIsNumber", kLight + "casts_shadow = 1\n", "6: light[0].casts_shadow:", "true or false"},
    {"LightOrbitAxisZero", kLight + "orbit = { axis = [0, 0, 0] }\n", "6: light[0].orbit.axis:", "no direction"},
    {"MirrorNoShape", "[[mirror]]\nposition = [0, 0, 0]\n", "4: mirror[0].size:", "or polygon"},
    {"MirrorUnknownKey", kMirror + "reflectence = 1\n", "6: mirror[0].reflectence:", "'reflectance'"},
    {"MirrorSizeNegative", "[[mirror]]\nsize = [-1, 1]\n", "5: mirror[0].size[0]:", "above 0"},
    {"MirrorSizeOfThree", "[[mirror]]\nsize = [1, 1, 1]\n", "5: mirror[0].size:", "array of 2 numbers"},
    {"MirrorSizeBelowArithmetic", "[[mirror]]\nsize = [1e-200, 1e-200]\n", "5: mirror[0].size:", "has no area"},
    {"MirrorPolygonAndSize", kMirror + "polygon = [[0,0,0],[1,0,0],[0,1,0]]\n", "5: mirror[0].size:", "polygon"},
    {"MirrorPolygonAndPosition", kPolygonMirror + "position = [0,0,0]\n", "6: mirror[0].position:", "polygon"},
    {"MirrorPolygonAndRotation", kPolygonMirror + "rotation = [0,0,0]\n", "6: mirror[0].rotation:", "polygon"},
    {"MirrorPolygonAndSpin", kPolygonMirror + "spin = [0,0,0]\n", "6: mirror[0].spin:", "polygon"},
    {"MirrorPolygonOfTwo", "[[mirror]]\npolygon = [[0,0,0],[1,0,0]]\n", "5: mirror[0].polygon:", "fewer than 3"},
    {"MirrorPolygonNotConvex", "[[mirror]]\npolygon = [[0,0,0],[2,0,0],[0.5,0.5,0],[0,2,0]]\n",
     "5: mirror[0].polygon:", "not convex"},
    {"MirrorPolygonNan", "[[mirror]]\npolygon = [[0,0,0],\n[1,0,nan],[0,1,0]]\n",
     "6: mirror[0].polygon[1][2]:", "finite"},
    {"MirrorPolygonOfNumbers", "[[mirror]]\npolygon = [1, 2, 3]\n", "5: mirror[0].polygon[0]:", "an array of 3"},
    {"MirrorReflectanceAboveOne", kMirror + "reflectance = [1, 1.01, 1]\n", "6: mirror[0].reflectance[1]:", "0 .. 1"},
    {"MirrorReflectanceIsNumber", kMirror + "reflectance = 1\n", "6: mirror[0].reflectance:", "array of 3 numbers"},
    {"MirrorFresnelUnknown", kMirror + "fresnel = 'shlick'\n", "6: mirror[0].fresnel:", "did you mean 'schlick'?"},
    {"MirrorNameCannotBreakTheLine", kMirror + "name = \"a\\nb\"\nfresnel = 1\n",
     "7: mirror[a\\x0ab].fresnel:", "is an integer"},
    {"BookmarkWithoutName", "[[bookmark]]\nposition = [0, 0, 1]\n", "4: bookmark[0].name:", "is missing"},
    {"BookmarkNameIsEmpty", "[[bookmark]]\nname = ''\n", "5: bookmark[0].name:", "is empty"},
    {"BookmarkNameOfAnother", kDoor + kDoor, "9: bookmark[door].name:", "another bookmark's"},
    {"BookmarkWithoutPosition", kBookmark + "target = [0, 0, 1]\n", "4: bookmark[door].position:", "is missing"},
    {"BookmarkWithoutTarget", kBookmark + "position = [0, 0, 1]\n", "4: bookmark[door].target:", "is missing"},
    {"BookmarkTargetIsPosition", kBookmark + "position = [0, 0, 1]\ntarget = [0, 0, 1]\n",
     "7: bookmark[door].target:", "away from position"},
    {"BookmarkAlongTheUpOfTheCamera", kBookmark + "position = [0, 5, 1]\ntarget = [0, 0, 1]\n",
     "7: bookmark[door].target:", "parallel"},
    {"BookmarkUpIsZero", kDoor + "up = [0, 0, 0]\n", "8: bookmark[door].up:", "has no direction"},
    {"BookmarkUnknownKey", kDoor + "fov = 40\n", "8: bookmark[door].fov:", "one of: name"},
};

INSTANTIATE_TEST_SUITE_P(All, SceneFault, testing::ValuesIn(kFaults),
                         [](const auto& info) { return std::string(info.param.name); });

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
  expectFault(std::string(100'000, '['), "1: toml:", "in '" + std::string(60, '[') + "...' (a TOML 1.0 file is needed");
  expectFault("a = " + std::string(100'000, '['), "1: toml:", "a TOML 1.0 file is needed");
}

TEST(SceneFaults, ModelErrorsNameTheModelFile) {
  const TemporaryFolder folder;
  folder.write("models/bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
  const auto scene = folder.write("scenes/a.toml", kCamera + "[[object]]\nmodel = '../models/bad.obj'\n");
  const std::string message = messageOf<InputError>([&] { loadScene(scene); });
  EXPECT_TRUE(startsWith(message, (folder / "models/bad.obj").string() + ":4: f: "));
}

}  // namespace
}  // namespace speculum
