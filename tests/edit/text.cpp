// The writer keeps what a user wrote and changes only values.
#include <charconv>

#include "edit/support.hpp"
#include "random.hpp"
#include "scene/toml_file.hpp"

namespace speculum {
namespace {

// Expects the edit to replace `from` by `to` in the text and nothing else; with an empty `from`, to append.
void expectEdit(const std::string& text, const std::string& from, const std::string& to,
                const std::function<void(Scene&)>& edit) {
  TextScene scene(text);
  scene.document.change("edit", {}, edit);
  ASSERT_TRUE(scene.document.modified()) << "the edit changed nothing";
  EXPECT_EQ(scene.saved(), from.empty() ? text + to : replaced(text, from, to));
  scene.document.undo();
  EXPECT_EQ(scene.saved(), text);
}

TEST(TomlNumbers, ShortTextsReadBackExactly) {
  EXPECT_EQ(tomlText(0.0), "0");
  EXPECT_EQ(tomlText(-0.0), "-0.0");
  EXPECT_EQ(tomlText(0.1), "0.1");
  EXPECT_EQ(tomlText(100000.0), "100000");
  EXPECT_EQ(tomlText(0.0005), "0.0005");
  EXPECT_EQ(tomlText(1e15), "1e+15");
  EXPECT_EQ(tomlText(-2.5e-7), "-2.5e-07");
  std::mt19937_64 random(7);
  for (int i = 0; i < 100000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) {
      const std::string text = tomlText(value);
      double back = 0.0;
      std::from_chars(text.data(), text.data() + text.size(), back);
      ASSERT_EQ(std::bit_cast<uint64_t>(back), std::bit_cast<uint64_t>(value)) << text;
    }
  }
}

TEST(EditedText, OnlyTheChangedNumberIsRewritten) {
  const std::string text = usualCamera +
                           "# a light\n[[light]]   # of the hall\n"
                           "position = [ 0x10, +3.50, 1e0 ] # where it hangs\nintensity=2_0\n\n";
  expectEdit(text, "+3.50", "3.25", [](Scene& s) { s.lights[0].position.y = 3.25; });
  expectEdit(text, "2_0", "21.5", [](Scene& s) { s.lights[0].intensity = 21.5; });
  expectEdit(text, "2_0\n", "2_0\ncasts_shadow = true\n", [](Scene& s) { s.lights[0].castsShadow = true; });
}

TEST(EditedText, PolygonsKeepTheirLines) {
  const std::string text =
      usualCamera + "[[mirror]]\npolygon = [\n  [0, 0, 0], # left\n  [1, 0, 0],\n  [1.0, 1, 0], # top\n]\n";
  expectEdit(text, "[1.0, 1, 0]", "[1.0, 2, 0]", [](Scene& s) { s.mirrors[0].polygon[2].y = 2; });
  expectEdit(text, "[\n  [0, 0, 0], # left\n  [1, 0, 0],\n  [1.0, 1, 0], # top\n]",
             "[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]", [](Scene& s) {
               s.mirrors[0].polygon = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
             });
}

TEST(EditedText, OptionalKeysGo) {
  const std::string keys = "color = [1, 0, 0] # red\nspecular = [0, 0, 0]\nshininess = 9\n";
  expectEdit(usualCamera + "[[object]]\nmodel = 'triangle.obj'\n" + keys, keys, "",
             [](Scene& s) { s.objects[0] = {.model = s.objects[0].model, .mesh = 0}; });
  const std::string table = "mirror = { fresnel = 'schlick' } # shiny\n";
  expectEdit(usualCamera + "[[object]]\nmodel = 'triangle.obj'\n" + table, table, "",
             [](Scene& s) { s.objects[0] = {.model = s.objects[0].model, .mesh = 0}; });
}

TEST(EditedText, PolygonBecomesRectangle) {
  const std::string text =
      usualCamera + "[[mirror]]\nname = 'a'\npolygon = [[0,0,0],[1,0,0],[1,1,0]]\nroughness = 0.1 # r\n";
  expectEdit(text, "polygon = [[0,0,0],[1,0,0],[1,1,0]]\nroughness = 0.1 # r\n",
             "roughness = 0.1 # r\nposition = [0, 0, -1]\nsize = [2, 1]\n", [](Scene& s) {
               s.mirrors[0].polygon.clear();
               s.mirrors[0].size = {2, 1};
               s.mirrors[0].position.z = -1;
             });
}

TEST(EditedText, InnerTablesComeAndGo) {
  const std::string text = usualCamera + "[[mirror]]\nsize = [1, 1]\nripple = { amplitude = 0.01 } # waves\n" +
                           "[[light]]\nposition = [0, 1, 0]\n";
  expectEdit(text, "0.01", "0.02", [](Scene& s) { s.mirrors[0].ripple->amplitude = 0.02; });
  expectEdit(text, "0.01 }", "0.01, speed = 1.5 }", [](Scene& s) { s.mirrors[0].ripple->speed = 1.5; });
  expectEdit(text, "ripple = { amplitude = 0.01 } # waves\n", "", [](Scene& s) { s.mirrors[0].ripple.reset(); });
  expectEdit(text, "", "orbit = { speed = 20 }\n", [](Scene& s) { s.lights[0].orbit = Orbit{.speed = 20}; });
}

TEST(EditedText, InnerTablesInEveryForm) {
  const auto waves = [](Scene& s) { s.mirrors[0].ripple->wavelength = 0.25; };
  const auto still = [](Scene& s) { s.mirrors[0].ripple.reset(); };
  const std::string mirror = usualCamera + "[[mirror]]\nsize = [1, 1]\n";
  const std::string dotted = mirror + "ripple.amplitude = 0.5\nname = 'x'\n";
  expectEdit(dotted, "0.5\n", "0.5\nripple.wavelength = 0.25\n", waves);
  expectEdit(dotted, "ripple.amplitude = 0.5\n", "", still);
  const std::string headed =
      mirror + "\n# waves\n[mirror.ripple]\namplitude = 0.5\n\n[[light]]\nposition = [0, 1, 0]\n";
  expectEdit(headed, "0.5\n", "0.5\nwavelength = 0.25\n", waves);
  expectEdit(headed, "\n# waves\n[mirror.ripple]\namplitude = 0.5\n", "", still);
  const std::string inlined = "mirror = [{size = [1, 1], ripple = {amplitude = 0.5}}, {size = [2, 2]}]\n" + usualCamera;
  expectEdit(inlined, "0.5}", "0.5, wavelength = 0.25}", waves);
  expectEdit(inlined, ", ripple = {amplitude = 0.5}", "", still);
  const std::string both = "mirror = [{ripple.amplitude = 0.5, size = [1, 1]}]\n" + usualCamera;
  expectEdit(both, "size = [1, 1]", "size = [1, 1], ripple.wavelength = 0.25", waves);
  expectEdit(both, "ripple.amplitude = 0.5, ", "", still);
  const std::string flat = mirror + "ripple.amplitude = 0\n";
  expectEdit(flat, "amplitude = 0\n", "amplitude = 0.1\n",
             [](Scene& s) { s.mirrors[0].ripple = Ripple{.amplitude = 0.1}; });
}

TEST(EditedText, EnvironmentInEveryForm) {
  const auto dim = [](Scene& s) { s.environment.ambient = glm::dvec3(0.5); };
  const std::string line = "ambient = [0.5, 0.5, 0.5]\n";
  expectEdit(usualCamera, "", "\n[environment]\n" + line, dim);
  expectEdit("[environment] # none\n" + usualCamera, "# none\n", "# none\n" + line, dim);
  expectEdit("environment = {background = [1, 1, 1]}\n" + usualCamera, "[1, 1, 1]}",
             "[1, 1, 1], ambient = [0.5, 0.5, 0.5]}", dim);
  expectEdit("environment.background = [1, 1, 1]\n" + usualCamera, "[1, 1, 1]\n", "[1, 1, 1]\nenvironment." + line,
             dim);
  const std::string sky = "[environment.sky]\nzenith = [1, 1, 1]\nhorizon = [1, 1, 1]\nground = [1, 1, 1]\n";
  expectEdit("title = 'x'\n" + sky + usualCamera, "'x'\n", "'x'\nenvironment." + line, dim);
  expectEdit("title = 'x'\n" + sky + usualCamera, sky, "", [](Scene& s) { s.environment.sky.reset(); });
  expectEdit("[environment]\nambient = [0, 0, 0]\n" + usualCamera, "ambient = [0, 0, 0]\n",
             "ambient = [0, 0, 0]\nsky = { zenith = [0.25, 0.25, 0.25], horizon = [0.5, 0.5, 0.5], "
             "ground = [1, 1, 1] }\n",
             [](Scene& s) {
               s.environment.sky = Sky{glm::dvec3(0.25), glm::dvec3(0.5), glm::dvec3(1)};
             });
}

TEST(EditedText, NewTableFollowsKeysAddedAboveIt) {
  expectEdit(usualCamera, "", "vertical_fov = 40\n\n[environment]\nambient = [0.5, 0.5, 0.5]\n", [](Scene& s) {
    s.environment.ambient = glm::dvec3(0.5);
    s.camera.verticalFov = 40;
  });
}

TEST(EditedText, KeepsDosLineBreaksAndMissingLast) {
  const std::string dos =
      "[camera]\r\nposition = [0, 0, 4] # eye\r\ntarget = [0, 0, 0]\r\n\r\n[[light]]\r\nposition = [0, 1, 0]";
  const auto shadow = [](Scene& s) { s.lights[0].castsShadow = true; };
  expectEdit(dos, "", "\r\ncasts_shadow = true", shadow);
  expectEdit(dos, "4]", "5]", [](Scene& s) { s.camera.position.z = 5; });
  TextScene scene(dos);
  scene.document.addLight({1, 2, 3}, {1, 2, 4});
  EXPECT_EQ(scene.saved(), dos + "\r\n\r\n[[light]]\r\nname = \"light\"\r\nposition = [1, 2, 3]\r\nradius = 0.01");
  scene.document.undo();
  EXPECT_EQ(scene.saved(), dos);
}

TEST(EditedText, NamesOfEveryKind) {
  const std::string text = "\xef\xbb\xbf# Größe: 3 µm, \"quoted\" [not] = a key\n" + usualCamera +
                           "[[ \"light\" ]]\n\"na\\u006De\" = 'Stehlampe \"grün\"' # ☀\n'position' = [0, 1, 0]\n";
  expectEdit(text, "[0, 1, 0]", "[7, 1, 0]", [](Scene& s) { s.lights[0].position.x = 7; });
  expectEdit(text, "'Stehlampe \"grün\"'", "\"a \\\"b\\\" \\\\ c\\td\\u0001 ☃\"",
             [](Scene& s) { s.lights[0].name = "a \"b\" \\ c\td\x01 ☃"; });
  expectEdit(text, "[0, 1, 0]\n", "[0, 1, 0]\nglow = 0\n", [](Scene& s) { s.lights[0].glow = 0; });
}

// The parser counts columns in code points, the text is edited in bytes.
TEST(EditedText, CharactersOfSeveralBytesBeforeTheValue) {
  const std::string inlined =
      "light = [{name = '😀 ä, {', position = [0, 1, 0], orbit.\"speed\" = 3}, {position = [0, 2, 0]}] # ☃\n" +
      usualCamera;
  expectEdit(inlined, "[0, 1, 0]", "[0, 7, 0]", [](Scene& s) { s.lights[0].position.y = 7; });
  expectEdit(inlined, "= 3}", "= 4}", [](Scene& s) { s.lights[0].orbit->speed = 4; });
  expectEdit(inlined, ", orbit.\"speed\" = 3", "", [](Scene& s) { s.lights[0].orbit.reset(); });
  expectEdit(inlined, "[0, 2, 0]}", "[0, 2, 0], glow = 0}", [](Scene& s) { s.lights[1].glow = 0; });
  const std::string several = usualCamera + "[[light]]\nname = \"\"\"Größe\n  😀\"\"\" # ä\nposition = [0, 1, 0]\n";
  expectEdit(several, "\"\"\"Größe\n  😀\"\"\"", "\"a\"", [](Scene& s) { s.lights[0].name = "a"; });
}

TEST(EditedText, AlignedKeysStayAligned) {
  const std::string text = usualCamera + "[[light]]\n  name     = 'a'\n  position = [0, 1, 0]\n\n# last words\n";
  expectEdit(text, "[0, 1, 0]\n", "[0, 1, 0]\n  glow     = 0\n", [](Scene& s) { s.lights[0].glow = 0; });
  TextScene scene(text);
  scene.document.addBookmark({.name = "door", .position = {1, 2, 3}, .target = {0, 0, 0}, .verticalFov = 40.0});
  EXPECT_EQ(scene.saved(), text +
                               "\n[[bookmark]]\nname         = \"door\"\nposition     = [1, 2, 3]\n"
                               "target       = [0, 0, 0]\nvertical_fov = 40\n");
}

TEST(EditedText, RemovedNodesTakeTheirComments) {
  const std::string head = usualCamera + "\n# ---- lights ----\n\n";
  const std::string first = "# the first\n# of two\n[[light]]\nname = 'a'\nposition = [0, 1, 0] # up\n";
  const std::string second = "\n# the second\n[[light]]\nname = 'b'\nposition = [0, 2, 0]\n# that was it\n";
  const std::string tail = "\n# mirrors\n\n[[mirror]]\nsize = [1, 1]\n";
  TextScene scene(head + first + second + tail);
  scene.document.remove({{Selection::Kind::light, 0}});
  EXPECT_EQ(scene.saved(), head.substr(0, head.size() - 1) + second + tail);
  scene.document.remove({{Selection::Kind::light, 0}});
  EXPECT_EQ(scene.saved(), head.substr(0, head.size() - 1) + tail);
  scene.document.undo();
  scene.document.undo();
  scene.document.remove({{Selection::Kind::light, 1}});
  scene.document.addLight({5, 0, 0}, {5, 0, 1});
  EXPECT_EQ(scene.saved(),
            head + first + "\n[[light]]\nname = \"light\"\nposition = [5, 0, 0]\nradius = 0.01\n" + tail);
}

TEST(EditedText, AddedAndRemovedInBrackets) {
  const std::string text = "mirror = [\n  {size = [1, 1]}, # one\n  {size = [2, 2]},\n]\n" + usualCamera;
  TextScene scene(text);
  scene.document.remove({{Selection::Kind::mirror, 1}});
  EXPECT_EQ(scene.saved(), replaced(text, ", # one\n  {size = [2, 2]},\n]", ",\n]"));
  scene.document.undo();
  scene.document.addMirror({0, 0, 0}, {0, 0, 10});
  EXPECT_EQ(scene.saved(),
            replaced(text, "{size = [2, 2]},", "{size = [2, 2]}, { name = \"mirror\", size = [3, 4] },"));
  scene.document.remove({{Selection::Kind::mirror, 0}});
  scene.document.remove({{Selection::Kind::mirror, 0}});
  EXPECT_EQ(scene.scene.mirrors.size(), 1u);
  EXPECT_TRUE(contains(scene.saved(), "size = [3, 4]"));
}

TEST(EditedText, EmptiedBracketsLoseTheirComma) {
  const std::string text = "light = [ {position = [0, 1, 0]}, ] # lamps\n" + usualCamera;
  TextScene scene(text);
  scene.document.remove({{Selection::Kind::light, 0}});
  EXPECT_EQ(scene.saved(), replaced(text, "{position = [0, 1, 0]},", ""));
  scene.document.addLight({1, 2, 3}, {1, 2, 4});
  EXPECT_TRUE(contains(scene.saved(), "position = [1, 2, 3], radius = 0.01 }, ] # lamps\n"));
}

// document.text() throws unless the text reads back as the scene.
TEST(EditedText, BlanksAndCommentsDoNotDisturbItems) {
  const std::array gaps{"", " ", "\n", "\r\n\t", " # a, ]\n", "\n # {b}\r\n  # ,\n\n "};
  testing_support::Random random(3);
  const auto gap = [&] { return random.pick(gaps); };
  for (int i = 0; i < 2000; ++i) {
    const int count = 1 + i % 3;
    std::string list = "[" + gap();
    for (int n = 0; n < count; ++n) {
      list += "{position = [" + std::to_string(n) + ", 1, 0]}" + gap();
      list += n + 1 < count || i % 2 == 0 ? "," + gap() : "";
    }
    const std::string text = "light = " + list + "] # end\n" + usualCamera;
    Scene scene = parseScene("scene.toml", text);
    SceneDocument document(scene);
    for (int n = count; n-- > 0;) {
      if (i % 5 == 0 || random.chance(0.5)) {
        document.remove({{Selection::Kind::light, n}});
      }
    }
    std::string saved;
    ASSERT_NO_THROW(saved = document.text("scene.toml", {})) << text;
    EXPECT_TRUE(contains(saved, "] # end\n"));
    document.addLight({7, 2, 3}, {7, 2, 4});
    ASSERT_NO_THROW(document.text("scene.toml", {})) << text;
    while (document.canUndo()) {
      document.undo();
    }
    ASSERT_EQ(document.text("scene.toml", {}), text);
  }
}

TEST(EditedText, SettingsInEveryForm) {
  const auto saved = [](const std::string& text, const std::vector<SettingChange>& changes) {
    return TextScene(text).saved(changes);
  };
  const std::string quoted = usualCamera + "[settings]\n\"view.exposure\" = 1.50 # bright\n";
  EXPECT_EQ(saved(quoted, {{"view.exposure", "1.5"}}), quoted);
  EXPECT_EQ(saved(quoted, {{"view.exposure", "2.0"}}), replaced(quoted, "1.50", "2.0"));
  EXPECT_EQ(saved(quoted, {{"view.tone_map", "aces"}, {"effects.shadows", "false"}}),
            quoted + "\"view.tone_map\" = \"aces\"\n\"effects.shadows\" = false\n");
  EXPECT_EQ(saved(quoted, {{"view.samples", "4"}}), quoted) << "a default that was not there";
  const std::string nested = usualCamera + "[settings.view]\nexposure = 2\nclear_color = [1, 1, 1]\n";
  EXPECT_EQ(saved(nested, {{"view.exposure", "3.0"}}), replaced(nested, "2", "3.0"));
  EXPECT_EQ(saved(nested, {{"view.clear_color", ""}}), replaced(nested, "clear_color = [1, 1, 1]\n", ""));
  EXPECT_EQ(saved(usualCamera + "[[light]]\nposition = [0, 1, 0]\n", {{"view.clear_color", "[0.5,0.0,1.0]"}}),
            usualCamera + "\n[settings]\n\"view.clear_color\" = [0.5, 0.0, 1.0]\n\n[[light]]\nposition = [0, 1, 0]\n");
}

}  // namespace
}  // namespace speculum
