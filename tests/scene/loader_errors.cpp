#include "scene/support.hpp"
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
  expectFault(usualCamera + GetParam().text, GetParam().place, GetParam().message);
}

const std::string objectText = "[[object]]\nmodel = 'triangle.obj'\n";
const std::string lightText = "[[light]]\nposition = [0, 2, 0]\n";
const std::string mirrorText = "[[mirror]]\nsize = [2, 1]\n";
const std::string polygonMirrorText = "[[mirror]]\npolygon = [[0,0,0],[1,0,0],[0,1,0]]\n";
const std::string bookmarkText = "[[bookmark]]\nname = 'door'\n";
const std::string doorText = bookmarkText + "position = [0, 1, 4]\ntarget = [0, 1, 0]\n";

const std::vector<Fault> faults = {
    {"QualityIsNoTable", mirrorText + "quality = 0.5\n", "6: mirror[0].quality:", "a table is needed"},
    {"QualityUnknownKey", mirrorText + "quality = { scal = 1 }\n",
     "6: mirror[0].quality.scal:", "did you mean 'scale'?"},
    {"QualityScaleTooSmall", mirrorText + "quality = { scale = 0.1 }\n", "6: mirror[0].quality.scale:", "0.125 .. 4"},
    {"QualityScaleTooLarge", mirrorText + "[mirror.quality]\nscale = 4.5\n", "7: mirror[0].quality.scale:", "is 4.5"},
    {"QualityScaleNan", mirrorText + "quality = { scale = nan }\n", "6: mirror[0].quality.scale:", "0.125 .. 4"},
    {"QualityScaleIsString", mirrorText + "quality.scale = '1'\n", "6: mirror[0].quality.scale:", "is a string"},
    {"QualitySamplesBetween", mirrorText + "quality = { samples = 3 }\n",
     "6: mirror[0].quality.samples:", "is 3 (one of 1 2 4 8 is needed)"},
    {"QualitySamplesTooMany", mirrorText + "quality = { samples = 16 }\n",
     "6: mirror[0].quality.samples:", "is 16 (one of 1 2 4 8 is needed)"},
    {"QualitySamplesNone", mirrorText + "quality = { samples = 0 }\n", "6: mirror[0].quality.samples:", "1 2 4 8"},
    {"QualitySamplesFraction", mirrorText + "quality = { samples = 2.0 }\n",
     "6: mirror[0].quality.samples:", "1 2 4 8"},
    {"QualityIntervalNone", mirrorText + "quality = { update_interval = 0 }\n",
     "6: mirror[0].quality.update_interval:", "an integer 1 .. 1000000 is needed"},
    {"QualityIntervalTooLong", mirrorText + "quality = { update_interval = 1000001 }\n",
     "6: mirror[0].quality.update_interval:", "is 1000001"},
    {"QualityMethodUnknown", mirrorText + "quality = { method = 'ray' }\n",
     "6: mirror[0].quality.method:", "did you mean 'rays'?"},
    {"QualityMethodIsNumber", mirrorText + "quality = { method = 1 }\n",
     "6: mirror[0].quality.method:", "is an integer"},
    {"QualityOfCurvedMirror", objectText + "mirror = { quality = { scale = 1 } }\n",
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
    {"ObjectSecondObjectByIndex", objectText + "[[object]]\nmodle = 'x'\n", "7: object[1].modle:", "'model'"},
    {"ObjectByName", objectText + "name = 'knot'\nscale = 0\n", "7: object[knot].scale:", "is zero"},
    {"ObjectRoughnessOfACurvedMirror", objectText + "mirror = { roughness = 0 }\n",
     "6: object[0].mirror.roughness:", "not a known key"},
    {"ObjectCurvedMirrorIsNumber", objectText + "mirror = 1\n", "6: object[0].mirror:", "is an integer"},
    {"ObjectScaleInfinite", objectText + "scale = inf\n", "6: object[0].scale:", "finite"},
    {"ObjectScaleIsString", objectText + "scale = 'big'\n", "6: object[0].scale:", "a number or an array"},
    {"ObjectPositionNan", objectText + "position = [0, nan, 0]\n", "6: object[0].position[1]:", "finite"},
    {"ObjectSpinIsBoolean", objectText + "spin = true\n", "6: object[0].spin:", "is a boolean"},
    {"ObjectCopiesZero", objectText + "copies = { count = 0 }\n", "6: object[0].copies.count:", "1 .. 1000000"},
    {"ObjectCopiesFraction", objectText + "copies = { count = 2.0 }\n", "6: object[0].copies.count:", "an integer"},
    {"LightNoPosition", "[[light]]\nglow = 1\n", "4: light[0].position:", "is missing"},
    {"LightUnknownKey", lightText + "colour = [1,1,1]\n", "6: light[0].colour:", "did you mean 'color'?"},
    {"LightCastsShadowIsNumber", lightText + "casts_shadow = 1\n", "6: light[0].casts_shadow:", "true or false"},
    {"LightOrbitAxisZero", lightText + "orbit = { axis = [0, 0, 0] }\n", "6: light[0].orbit.axis:", "no direction"},
    {"MirrorNoShape", "[[mirror]]\nposition = [0, 0, 0]\n", "4: mirror[0].size:", "or polygon"},
    {"MirrorUnknownKey", mirrorText + "reflectence = 1\n", "6: mirror[0].reflectence:", "'reflectance'"},
    {"MirrorSizeNegative", "[[mirror]]\nsize = [-1, 1]\n", "5: mirror[0].size[0]:", "above 0"},
    {"MirrorSizeOfThree", "[[mirror]]\nsize = [1, 1, 1]\n", "5: mirror[0].size:", "array of 2 numbers"},
    {"MirrorSizeBelowArithmetic", "[[mirror]]\nsize = [1e-200, 1e-200]\n", "5: mirror[0].size:", "has no area"},
    {"MirrorPolygonAndSize", mirrorText + "polygon = [[0,0,0],[1,0,0],[0,1,0]]\n", "5: mirror[0].size:", "polygon"},
    {"MirrorPolygonAndPosition", polygonMirrorText + "position = [0,0,0]\n", "6: mirror[0].position:", "polygon"},
    {"MirrorPolygonAndRotation", polygonMirrorText + "rotation = [0,0,0]\n", "6: mirror[0].rotation:", "polygon"},
    {"MirrorPolygonAndSpin", polygonMirrorText + "spin = [0,0,0]\n", "6: mirror[0].spin:", "polygon"},
    {"MirrorPolygonOfTwo", "[[mirror]]\npolygon = [[0,0,0],[1,0,0]]\n", "5: mirror[0].polygon:", "fewer than 3"},
    {"MirrorPolygonNotConvex", "[[mirror]]\npolygon = [[0,0,0],[2,0,0],[0.5,0.5,0],[0,2,0]]\n",
     "5: mirror[0].polygon:", "not convex"},
    {"MirrorPolygonNan", "[[mirror]]\npolygon = [[0,0,0],\n[1,0,nan],[0,1,0]]\n",
     "6: mirror[0].polygon[1][2]:", "finite"},
    {"MirrorPolygonOfNumbers", "[[mirror]]\npolygon = [1, 2, 3]\n", "5: mirror[0].polygon[0]:", "an array of 3"},
    {"MirrorReflectanceAboveOne", mirrorText + "reflectance = [1, 1.01, 1]\n",
     "6: mirror[0].reflectance[1]:", "0 .. 1"},
    {"MirrorReflectanceIsNumber", mirrorText + "reflectance = 1\n", "6: mirror[0].reflectance:", "array of 3 numbers"},
    {"ObjectVisibleUnknown", objectText + "visible = 'mirror'\n", "6: object[0].visible:", "did you mean 'mirrors'?"},
    {"ObjectUpUnknown", objectText + "up = 'x'\n", "6: object[0].up:", "did you mean 'y'?"},
    {"MirrorMapMissing", mirrorText + "reflectance_map = 'dirt.png'\n", "6: mirror[0].reflectance_map:", "dirt.png"},
    {"MirrorMapNoPicture", mirrorText + "reflectance_map = 'triangle.obj'\n",
     "6: mirror[0].reflectance_map:", "a PNG or JPEG file"},
    {"MirrorFresnelUnknown", mirrorText + "fresnel = 'shlick'\n", "6: mirror[0].fresnel:", "did you mean 'schlick'?"},
    {"MirrorNameCannotBreakTheLine", mirrorText + "name = \"a\\nb\"\nfresnel = 1\n",
     "7: mirror[a\\x0ab].fresnel:", "is an integer"},
    {"BookmarkWithoutName", "[[bookmark]]\nposition = [0, 0, 1]\n", "4: bookmark[0].name:", "is missing"},
    {"BookmarkNameIsEmpty", "[[bookmark]]\nname = ''\n", "5: bookmark[0].name:", "is empty"},
    {"BookmarkNameOfAnother", doorText + doorText, "9: bookmark[door].name:", "another bookmark's"},
    {"BookmarkWithoutPosition", bookmarkText + "target = [0, 0, 1]\n", "4: bookmark[door].position:", "is missing"},
    {"BookmarkWithoutTarget", bookmarkText + "position = [0, 0, 1]\n", "4: bookmark[door].target:", "is missing"},
    {"BookmarkTargetIsPosition", bookmarkText + "position = [0, 0, 1]\ntarget = [0, 0, 1]\n",
     "7: bookmark[door].target:", "away from position"},
    {"BookmarkAlongTheUpOfTheCamera", bookmarkText + "position = [0, 5, 1]\ntarget = [0, 0, 1]\n",
     "7: bookmark[door].target:", "parallel"},
    {"BookmarkUpIsZero", doorText + "up = [0, 0, 0]\n", "8: bookmark[door].up:", "has no direction"},
    {"BookmarkUnknownKey", doorText + "fov = 40\n", "8: bookmark[door].fov:", "one of: name"},
};

INSTANTIATE_TEST_SUITE_P(All, SceneFault, testing::ValuesIn(faults),
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
  expectFault(std::string(100'000, '['), "1: toml:",
              "in '" + std::string(29, '[') + "..." + std::string(28, '[') + "' (a TOML 1.0 file is needed");
  expectFault("a = " + std::string(100'000, '['), "1: toml:", "a TOML 1.0 file is needed");
}

TEST(SceneFaults, ModelsOfOtherFormatsAreNamed) {
  const TemporaryFolder folder;
  for (const auto& [name, content, kind] :
       {std::tuple("a.stl", "solid a\n", "is an STL file (save it as a "),
        std::tuple("a.ply", "ply\nformat", "is a PLY file"), std::tuple("a.x3d", "<?xml version", "is an XML file"),
        std::tuple("a.dae", "<?xml version='1.0'?>\n<COLLADA>", "is a COLLADA file"),
        std::tuple("a.txt", "# a cube\nmtllib a.mtl\n", "is a Wavefront OBJ file (let its name end with .obj)"),
        std::tuple("b.txt", "v 0 0 0\nv 1 0 0\n", "is a Wavefront OBJ file"),
        std::tuple("a.fbx", "Kaydara FBX Binary", "is an FBX file"),
        std::tuple("a.usdz", "PK\x03\x04", "is a ZIP archive (unpack it)"),
        std::tuple("a.mtl", "# made by hand\nnewmtl m\n", "is a material file (name the OBJ file that uses it)")}) {
    const std::string message = messageOf<InputError>([&, file = folder.write(name, content)] { loadScene(file); });
    EXPECT_TRUE(contains(message, std::string(name) + ":1: file: " + kind)) << message;
  }
  EXPECT_TRUE(contains(messageOf<InputError>([&] { loadScene(folder.write("a.scene", "camera = 3\n")); }), "camera:"));
}

TEST(SceneFaults, ModelErrorsNameTheModelFile) {
  const TemporaryFolder folder;
  folder.write("models/bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
  const auto scene = folder.write("scenes/a.toml", usualCamera + "[[object]]\nmodel = '../models/bad.obj'\n");
  const std::string message = messageOf<InputError>([&] { loadScene(scene); });
  EXPECT_TRUE(startsWith(message, (folder / "models/bad.obj").string() + ":4: f: "));
}

}  // namespace
}  // namespace speculum
