// `speculum regress` as scripts call it.
#include <sys/stat.h>

#include "command_support.hpp"
#include "image/picture_files.hpp"
#include "made_pictures.hpp"
#include "picture_support.hpp"
#include "platform/files.hpp"
#include "scene_text.hpp"
#include "temporary_folder.hpp"

namespace speculum {
namespace {

using namespace testing_support;

const std::string side = R"(
[[light]] position = [-2, 1, 2], intensity = 3
[[mirror]] name = "side", position = [2.5, 1, 0], rotation = [0, -60, 0], size = [2, 2]
)";

const std::string roomCase = "[[case]]\nscene = 'room.toml'\n";

class RegressCommand : public testing::Test {
 protected:
  RegressCommand() { writeRoom("room.toml"); }

  ProcessResult regress(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"regress", (folder_ / "cases.toml").string(), "--out",
                                         (folder_ / "out").string(), "--jobs", "1", "--validation"});
    return speculum(std::move(arguments));
  }
  void writeCases(const std::string& text) {
    folder_.write("cases.toml",
                  "[defaults]\nsize = '320x180'\nsettings = { debug.check_finite = true }\n"
                  "tolerance = { flip = 0.005 }\n" +
                      tomlOf(text));
  }
  void writeRoom(const std::string& name, const std::string& from = "", const std::string& to = "") {
    folder_.write(name, replaced(tomlOf(wallScene + side), from, to));
  }
  // Says what became of a case, as the command prints it.
  static std::string lineOf(const std::string& name, const std::string& output) {
    const size_t at = output.find(" " + name + ": ");
    return at == std::string::npos
               ? ""
               : output.substr(output.rfind('\n', at) + 1, output.find('\n', at) - output.rfind('\n', at) - 1);
  }
  TemporaryFolder folder_;
};

TEST_F(RegressCommand, GoesFromRedToGreen) {
  writeCases("[[case]]\nscene = 'room.toml'\n[[case]]\nname = 'later'\nscene = 'room.toml'\ntime = 1\n");
  ProcessResult result = regress({});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_TRUE(contains(lineOf("room", result.output), "there is no expected picture")) << result.output;
  EXPECT_TRUE(contains(readText(folder_ / "out/index.html"), R"("--filter","room","--validation","--update"])"));
  result = regress({"--update", "room"});
  EXPECT_EQ(result.exitCode, 1) << "the other one is still missing: " << result.output;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "room.png"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "later.png"));
  result = regress({"--update"});
  EXPECT_EQ(result.exitCode, 0) << result.output;
  EXPECT_TRUE(contains(result.output, "2 cases: 1 passed, 1 updated"));
  result = regress({"--repeat", "3", "--junit", (folder_ / "junit.xml").string()});
  EXPECT_EQ(result.exitCode, 0) << result.output;
  EXPECT_TRUE(contains(readText(folder_ / "junit.xml"), "tests=\"2\" failures=\"0\""));
  EXPECT_FALSE(contains(readText(folder_ / "out/index.html"), "data:image/png"));
}

TEST_F(RegressCommand, FoldersOfOtherRunsAreRefused) {
  writeCases("[[case]]\nscene = 'room.toml'\n");
  std::filesystem::create_directory(folder_ / "out");
  const auto lock = lockFolder(folder_ / "out");
  const ProcessResult result = regress({"--update"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_TRUE(contains(result.output, "is in use (another command writes there")) << result.output;
}

TEST_F(RegressCommand, JunitMayBeStandardOutput) {
  writeCases("[[case]]\nscene = 'room.toml'\n");
  const ProcessResult result = runProcess({"sh", "-c", R"("$0" regress "$1" --out "$2" --update --junit - 2>/dev/null)",
                                           program, (folder_ / "cases.toml").string(), (folder_ / "out").string()});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(result.output.rfind("<?xml", 0), 0u) << result.output;
  EXPECT_FALSE(contains(result.output, "wrote ")) << result.output;
}

// The words of --update stand anywhere, also for the workers.
TEST_F(RegressCommand, UpdateStandsInAnyPlace) {
  const std::string cases = (folder_ / "cases.toml").string();
  const std::string other = (folder_ / "other.png").string();
  writeCases(roomCase + "[[case]]\nname = 'other'\nscene = 'room.toml'\n");
  const std::vector<std::vector<std::string>> ofAll{{"--update", cases, "--out", "O"},
                                                    {"--out", "O", "--update", cases},
                                                    {"--out", "O", "--update", "--", cases},
                                                    {"--out", "O", cases, "--update"},
                                                    {"--update", "", cases, "--out", "O"}};
  const std::vector<std::vector<std::string>> ofOne{{"--update", "room", cases, "--out", "O"},
                                                    {"--update=room", cases, "--out", "O"},
                                                    {"--out", "O", "--update=room", "--", cases},
                                                    {cases, "--out", "O", "--update", "room"}};
  for (const bool all : {true, false}) {
    for (std::vector<std::string> words : all ? ofAll : ofOne) {
      std::ranges::replace(words, std::string("O"), (folder_ / "out").string());
      words.insert(words.begin(), "regress");
      std::filesystem::remove(folder_ / "room.png");
      std::filesystem::remove(other);
      const ProcessResult result = speculum(words);
      EXPECT_EQ(result.exitCode, all ? 0 : 1) << testing::PrintToString(words) << result.output;
      EXPECT_TRUE(contains(result.output, all ? "2 cases: 2 updated" : "1 updated")) << result.output;
      EXPECT_TRUE(std::filesystem::exists(folder_ / "room.png"));
      EXPECT_EQ(std::filesystem::exists(other), all);
    }
  }
}

TEST_F(RegressCommand, NamesOfAnyScriptNameFiles) {
  for (const std::string name : {"Büro", "Bäro", "部屋 2"}) {
    writeRoom(name + ".toml");
  }
  writeCases("[[case]]\ngrid = { scene = ['Büro.toml', 'Bäro.toml', '部屋 2.toml'] }\n");
  const std::string junit = (folder_ / "junit.xml").string();
  EXPECT_EQ(regress({"--update", "--junit", junit}).exitCode, 0);
  const ProcessResult result = regress({"--filter", "B?ro", "--junit", junit});
  EXPECT_EQ(result.exitCode, 0) << result.output;
  EXPECT_TRUE(contains(result.output, "2 cases: 2 passed"));
  for (const char* name : {"Büro", "Bäro"}) {
    EXPECT_TRUE(contains(readText(junit), std::string("name=\"") + name + "\"")) << readText(junit);
    EXPECT_TRUE(contains(readText(folder_ / "out/index.html"), std::string("\"name\":\"") + name + "\""));
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "部屋_2.png"));
}

TEST_F(RegressCommand, UpdateReplacesNoMask) {
  writePng(folder_ / "room.png", Image8(320, 180));
  writeCases("[[case]]\nscene = 'room.toml'\nmask = 'room.png'\n");
  const ProcessResult result = regress({"--update"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_TRUE(
      contains(result.output, "--update: " + (folder_ / "room.png").string() + " is the mask of case 'room' too"));
  EXPECT_EQ(readImage8(folder_ / "room.png").rgba, Image8(320, 180).rgba);
}

// A model's texture has the name that its picture would have.
TEST_F(RegressCommand, UpdateReplacesNoTexture) {
  folder_.write("room.obj", "mtllib room.mtl\nusemtl all\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
  folder_.write("room.mtl", "newmtl all\nmap_Kd room.png\n");
  writePng(folder_ / "room.png", greyPicture(4, 4, 100));
  writeCases("[[case]]\nname = 'other'\nscene = 'room.toml'\npicture = 'room.png'\n[[case]]\nscene = 'room.obj'\n");
  for (const char* name : {"*", "other"}) {
    const ProcessResult result = regress({"--update", name});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_TRUE(contains(result.output, "room.png is a file that case 'room' draws too")) << result.output;
    EXPECT_EQ(readImage8(folder_ / "room.png").width, 4) << name;
  }
}

TEST_F(RegressCommand, StrictCasesRefuseDefects) {
  folder_.write("room.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n");
  for (const auto& [strict, arguments] : {std::pair("", std::vector<std::string>{"--strict"}),
                                          std::pair("strict = true\n", std::vector<std::string>{})}) {
    writeCases(std::string("[[case]]\nscene = 'room.obj'\n[[case]]\nname = 'second'\nscene = 'room.obj'\n") + strict);
    const ProcessResult result = regress(arguments);
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_TRUE(contains(result.output, "room.obj:5: f: has a vertex that is not there")) << result.output;
  }
}

// Files of cases that this run leaves out, or cannot draw, however their models name them.
TEST_F(RegressCommand, UpdateReplacesNoFileOfAnyCase) {
  const std::map<std::string, std::string> materials{{"map_Kd t0.png", "t0.png"},
                                                     {"map_Kd -s 2 2 1 -clamp on t1.png", "t1.png"},
                                                     {"map_Kd with blanks 2.png", "with blanks 2.png"},
                                                     {"map_Kd below\\\\..\\\\t3.png", "t3.png"},
                                                     {"Kd none\nmap_Kd t4.png", "t4.png"},
                                                     {"newmtl unused\nmap_d t5.png", "t5.png"},
                                                     {"map_Kd link.png", "behind.png"}};
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
  std::string cases;
  std::vector<std::string> pictures;
  const auto add = [&](const std::string& scene, const std::string& picture) {
    const std::string i = std::to_string(pictures.size());
    writePng(folder_ / picture, greyPicture(4, 4, 100));
    cases += "[[case]]\nname = 'left" + i + "'\nscene = '" + scene + "'\npicture = 'no.png'\n";
    cases += "[[case]]\nname = 'drawn" + i + "'\nscene = 'room.toml'\npicture = '" + picture + "'\n";
    pictures.push_back(picture);
  };
  std::filesystem::create_directory(folder_ / "below");
  std::filesystem::create_symlink("behind.png", folder_ / "link.png");
  for (const auto& [text, picture] : materials) {
    const std::string name = "m" + std::to_string(pictures.size());
    folder_.write(name + ".mtl", "newmtl a\n" + text + "\n");
    folder_.write(name + ".obj", "mtllib none.mtl \\\n " + name + ".mtl\nusemtl a\n" + corners);
    add(name + ".obj", picture);
  }
  folder_.write("my own.mtl", "newmtl a\nmap_Kd blank.png\n");
  folder_.write("blank.obj", "mtllib my own.mtl\n" + corners);
  folder_.write("broken.toml", "[camera]\nposition = 1\n[[object]]\nmodel = './below/../blank.obj'\nscale = 'x'\n");
  add("broken.toml", "blank.png");
  folder_.write("escaped.obj", "mtllib my\\ other.mtl\n" + corners);
  folder_.write("my other.mtl", "newmtl a\nmap_Kd escaped.png\n");
  add("escaped.obj", "escaped.png");
  folder_.write("several.obj", "mtllib none.mtl my third one.mtl\n" + corners);
  folder_.write("my third one.mtl", "newmtl a\nmap_Kd several.png\n");
  add("several.obj", "several.png");
  writeCases(cases);
  const ProcessResult result = regress({"--filter", "drawn*", "--update"});
  EXPECT_EQ(result.exitCode, 2);
  for (size_t i = 0; i < pictures.size(); ++i) {
    const std::string name = "drawn" + std::to_string(i);
    EXPECT_TRUE(
        contains(lineOf(name, result.output), " is a file that case 'left" + std::to_string(i) + "' draws too"));
    EXPECT_EQ(readImage8(folder_ / pictures[i]).width, 4) << pictures[i];
  }
  EXPECT_TRUE(contains(result.output, std::to_string(pictures.size()) + " error"));
}

TEST_F(RegressCommand, UpdateRefusesWhatIsNoFile) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.png").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/null", folder_ / "device.png");
  writeCases("[[case]]\nname = 'pipe'\nscene = 'room.toml'\n[[case]]\nname = 'device'\nscene = 'room.toml'\n");
  const ProcessResult result = regress({"--update"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_TRUE(contains(lineOf("pipe", result.output), "pipe.png: is a device or pipe (a file is needed)"));
  EXPECT_TRUE(contains(lineOf("device", result.output), "device.png: is a device or pipe (a file is needed)"));
  EXPECT_TRUE(contains(result.output, "2 cases: 2 error"));
}

// Runs the report's commands beside the cases, where they could meet every file of them.
TEST_F(RegressCommand, CommandsOfTheReportLeaveOtherFiles) {
  writePng(folder_ / "room.png", Image8(320, 180));
  writePng(folder_ / "room.again.png", Image8(320, 180));
  writeCases(roomCase + "[[case]]\nscene = 'room.toml'\nname = 'room.again'\n");
  ASSERT_EQ(regress({}).exitCode, 1);
  const std::string page = readText(folder_ / "out/index.html");
  const std::string start = "<script type=\"application/json\" id=\"data\">";
  ASSERT_TRUE(contains(page, start));
  const size_t at = page.find(start) + start.size();
  const nlohmann::json data = nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
  std::map<std::string, std::string> before;
  const auto files = [&] {
    std::map<std::string, std::string> contents;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
      if (entry.is_regular_file()) {
        contents[entry.path().string()] = readText(entry.path());
      }
    }
    return contents;
  };
  before = files();
  std::set<std::string> drawn;
  for (const nlohmann::json& one : data["cases"]) {
    std::vector<std::string> words = one["drawCommand"];
    drawn.insert(words.back());
    words.front() = program;
    words.insert(words.begin(), {"sh", "-c", "cd \"$0\" && exec \"$@\"", folder_.path().string()});
    EXPECT_EQ(runProcess(words).exitCode, 0);
  }
  EXPECT_EQ(drawn.size(), 2u);
  std::vector<std::string> words = data["cases"][0]["acceptCommand"];
  words.front() = program;
  EXPECT_EQ(runProcess(words).exitCode, 0);
  const std::map<std::string, std::string> after = files();
  for (const auto& [file, content] : before) {
    EXPECT_EQ(after.at(file) == content, file != (folder_ / "room.png")) << file << " is only written by the second";
  }
  EXPECT_EQ(readImage8(folder_ / *drawn.begin()).rgba, readImage8(folder_ / "room.png").rgba);
}

TEST_F(RegressCommand, ForeignTextIsOneHarmlessLine) {
  writeCases(
      "[[case]]\nscene = 'room.toml'\nexpect = [{ driver = '', result = 'skip', reason = "
      "\"a\\n::error::b\\r##[error]c\\u001b[2J\\u202e\\nreply {}\" }]\n[[case]]\nname = 'lost'\nscene = 'room.toml'\n"
      "picture = \"::add-mask::\\n::add-mask::x.png\"\n");
  const std::string cases = (folder_ / "::stop::\n::x.toml").string();
  std::filesystem::rename(folder_ / "cases.toml", cases);
  ::setenv("GITHUB_ACTIONS", "true", 1);
  const ProcessResult result = runProcess({"sh", "-c", R"(cd "$0" && exec "$1" regress "$2" --out ::out --jobs 1)",
                                           folder_.path().string(), program, std::filesystem::path(cases).filename()});
  ::unsetenv("GITHUB_ACTIONS");
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_EQ(lineOf("room", result.output),
            R"(skipped room: a\x0a::error::b\x0d#\x23[error]c\x1b[2J\u202e\x0areply {})");
  EXPECT_EQ(occurrences(result.output, "\n"), 4) << result.output;
  EXPECT_EQ(occurrences(result.output, "\n::"), 1) << "GitHub's command for the lost picture: " << result.output;
  EXPECT_TRUE(contains(result.output, "\n::error file=/"));
  EXPECT_FALSE(contains(result.output, "##["));
}

TEST_F(RegressCommand, FoldersNeedNoNamesInUtf8) {
  const std::filesystem::path folder = folder_ / "d\xe9";
  std::filesystem::create_directory(folder);
  std::filesystem::rename(folder_ / "room.toml", folder / "room.toml");
  writeCases(roomCase);
  std::filesystem::rename(folder_ / "cases.toml", folder / "cases.toml");
  for (const bool update : {true, false}) {
    std::vector<std::string> arguments{"regress", (folder / "cases.toml").string(), "--out", (folder / "out").string(),
                                       "--junit", (folder / "junit.xml").string()};
    if (update) {
      arguments.push_back("--update");
    }
    const ProcessResult result = speculum(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.output;
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "room.png"));
}

TEST_F(RegressCommand, AddsToTheSummaryOfAJob) {
  writeCases(roomCase);
  folder_.write("summary.md", "first\n");
  ::setenv("GITHUB_STEP_SUMMARY", (folder_ / "summary.md").c_str(), 1);
  regress({});
  const std::string summary = readText(folder_ / "summary.md");
  EXPECT_TRUE(startsWith(summary, "first\n"));
  EXPECT_TRUE(contains(summary, "there is no expected picture"));
  ::setenv("GITHUB_STEP_SUMMARY", (folder_ / "none" / "summary.md").c_str(), 1);
  folder_.write("none", "");  // a file where the folder should be
  const ProcessResult result = regress({});
  ::unsetenv("GITHUB_STEP_SUMMARY");
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_TRUE(contains(result.output, "none/summary.md: cannot be written")) << result.output;
}

TEST_F(RegressCommand, FindsSeededFaults) {
  writeRoom("dark.toml", "[[light]]\nposition = [-2, 1, 2]\nintensity = 3\n");
  writeRoom("swapped.toml", "position = [2.5, 1, 0]\nrotation = [0, -60, 0]",
            "position = [-2.5, 1, 0]\nrotation = [0, 60, 0]");
  writeCases(roomCase);
  ASSERT_EQ(regress({"--update"}).exitCode, 0);
  const Image8 right = readImage8(folder_ / "room.png");
  Image8 shifted = right;
  Image8 tinted = right;
  Image8 seam = right;
  for (int y = 0; y < right.height; ++y) {
    for (int x = 0; x < right.width; ++x) {
      std::copy_n(right.at(std::max(0, x - 1), y), 4, shifted.at(x, y));
      tinted.at(x, y)[0] = static_cast<uint8_t>(std::min(255, right.at(x, y)[0] + 2));
      if (x == 200 && y > 40 && y < 140) {
        seam.at(x, y)[2] = static_cast<uint8_t>(255 - seam.at(x, y)[2]);
      }
    }
  }
  writePng(folder_ / "shifted.png", shifted);
  writePng(folder_ / "tinted.png", tinted);
  writePng(folder_ / "seam.png", seam);
  std::string cases = roomCase;
  for (const std::string name : {"shifted", "tinted", "seam"}) {
    cases += "[[case]]\nname = '" + name + "'\nscene = 'room.toml'\n";
  }
  for (const std::string name : {"dark", "swapped"}) {
    cases += "[[case]]\nscene = '" + name + ".toml'\npicture = 'room.png'\n";
  }
  writeCases(cases);
  const ProcessResult result = regress({});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_TRUE(contains(result.output, "6 cases: 1 passed, 5 failed;"));
  EXPECT_TRUE(contains(lineOf("tinted", result.output), "mean FLIP is")) << result.output;
  for (const char* name : {"shifted", "seam", "dark", "swapped"}) {
    EXPECT_TRUE(contains(lineOf(name, result.output), "differ")) << result.output;
  }
}

TEST_F(RegressCommand, FindsValuesThatAreNotFinite) {
  writeCases(roomCase);
  ASSERT_EQ(regress({"--update"}).exitCode, 0);
  const std::filesystem::path shaders = folder_ / "shaders";
  std::filesystem::create_directories(shaders);
  writeShaders(shaders, "scene_shading.glsl", "  color.r = gl_FragCoord.x < 160.0 ? color.r : sqrt(-1.0 - color.r);\n");
  const ProcessResult result = regress({"--shader-dir", shaders.string()});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_TRUE(contains(lineOf("room", result.output), "values that are not finite, first")) << result.output;
  EXPECT_EQ(regress({"--shader-dir", shaders.string(), "--update"}).exitCode, 1) << "such a picture is not taken over";
}

TEST_F(RegressCommand, KeepsToExpectationsOfDrivers) {
  writePng(folder_ / "wrong.png", Image8(320, 180));
  writeCases(R"(
[[case]] scene = 'room.toml', name = 'known', picture = 'wrong.png'
expect = [{ driver = 'nothing like it', result = 'skip', reason = 'other' }, { driver = '', result = 'fail', reason = 'bug 7' }]
[[case]] scene = 'room.toml', name = 'skipped', expect = [{ driver = '', result = 'skip', reason = 'too slow' }]
[[case]] scene = 'room.toml', name = 'surprise', picture = 'wrong.png', tolerance = { max_diff = 255, flip = 1 }
expect = [{ driver = '', result = 'fail', reason = 'bug 8' }]
)");
  const ProcessResult result = regress({"--update"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_EQ(lineOf("known", result.output), "passed  known: fails as expected: bug 7");
  EXPECT_EQ(lineOf("skipped", result.output), "skipped skipped: too slow");
  EXPECT_EQ(lineOf("surprise", result.output), "failed  surprise: passes, but is expected to fail: bug 8");
  EXPECT_EQ(readImage8(folder_ / "wrong.png").rgba, Image8(320, 180).rgba) << "nothing of this may be updated";
}

TEST_F(RegressCommand, UpdateLeavesCasesExpectedToFail) {
  const std::string fails = ", expect = [{ driver = '', result = 'fail', reason = 'bug 7' }]\n";
  writePng(folder_ / "small.png", Image8(16, 9));
  writeCases("[[case]] scene = 'room.toml', name = 'missing'" + fails +
             "[[case]] scene = 'room.toml', name = 'resized', picture = 'small.png'" + fails +
             "[[case]] scene = 'room.toml', name = 'shared', picture = 'both.png'" + fails +
             "[[case]] scene = 'room.toml', name = 'writer', picture = 'both.png'\n");
  const ProcessResult result = regress({"--update"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_TRUE(lineOf("missing", result.output)
                  .ends_with("there is no expected picture " + (folder_ / "missing.png").string() +
                             " (make it where the case passes)"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "missing.png"));
  EXPECT_EQ(readImage8(folder_ / "small.png").width, 16);
  EXPECT_TRUE(contains(lineOf("writer", result.output), "updated writer")) << "'shared' writes nothing";
}

TEST_F(RegressCommand, SceneFaultsAndTimeoutsLeaveTheRest) {
  folder_.write("broken.toml", "[camera]\nposition = 1\n");
  writeCases(R"(
[[case]] scene = 'broken.toml'
[[case]] scene = 'room.toml', name = 'slow', size = '1920x1080', settings = { view.accumulate = 1024 }, timeout = 1
[[case]] scene = 'room.toml', name = 'typo', settings = { debug.omit_barrier = 'x' }
[[case]] scene = 'room.toml', name = 'view', camera = 'door'
[[case]] scene = 'room.toml'
)");
  const ProcessResult result = regress({"--update"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_TRUE(contains(lineOf("broken", result.output), "broken.toml:2: camera.position")) << result.output;
  EXPECT_EQ(lineOf("slow", result.output), "error   slow: no picture within 1 s");
  EXPECT_TRUE(contains(lineOf("typo", result.output), "typo: debug.omit_barrier: there is no barrier 'x'"))
      << "nobody typed --set: " << result.output;
  EXPECT_TRUE(contains(lineOf("view", result.output), "case[view].camera: the scene has no bookmark 'door'"))
      << result.output;
  EXPECT_TRUE(
      contains(readText(folder_ / "out/index.html"), R"("--set","view.accumulate=1024","--validation","--out")"))
      << "the command that draws it";
  EXPECT_EQ(lineOf("room", result.output), "updated room: wrote " + (folder_ / "room.png").string());
}

TEST_F(RegressCommand, FirstOfCasesWritesTheirPicture) {
  writeCases(R"(
[[case]] name = 'first', scene = 'room.toml', picture = 'same.png'
[[case]] name = 'second', scene = 'room.toml', settings = { view.exposure = 0.25 }, picture = 'same.png'
)");
  const ProcessResult result = regress({"--update"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_EQ(lineOf("first", result.output), "updated first: wrote " + (folder_ / "same.png").string());
  EXPECT_TRUE(lineOf("second", result.output).ends_with("; case 'first' writes this picture")) << result.output;
  const std::string written = readText(folder_ / "same.png");
  EXPECT_EQ(regress({"--filter", "second", "--update"}).exitCode, 1);
  EXPECT_EQ(readText(folder_ / "same.png"), written) << "the case that writes it is not drawn";
  EXPECT_FALSE(contains(readText(folder_ / "out/index.html"), R"("--update"],"device)"));
}

TEST_F(RegressCommand, ReportsReplaceNothingThatCasesRead) {
  writeRoom("room.toml");
  std::filesystem::create_directory(folder_ / "out");
  writePng(folder_ / "out/room.flip.png", Image8(320, 180));
  for (const char* read : {"picture = 'out/room.expected.png'", "mask = 'out/room.flip.png'",
                           "expect = [{ driver = 'other', picture = 'out/{name}.actual.png' }]"}) {
    writeCases(std::string("[[case]]\nscene = 'room.toml'\n") + read + "\n");
    const ProcessResult result = regress({});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_TRUE(contains(result.output, "--out: ") && contains(result.output, " is a file of case 'room' too"))
        << result.output;
  }
  writeCases(roomCase);
  for (const auto& [junit, words] :
       {std::pair("room.toml", "a file of case 'room'"), std::pair("out/room.actual.png", "a file of the report")}) {
    const std::string file = (folder_ / junit).string();
    const ProcessResult result = regress({"--junit", file});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_TRUE(contains(result.output, "--junit: " + file + " is " + words + " too")) << result.output;
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/room.flip.png"));
}

TEST_F(RegressCommand, MistakesExitTwo) {
  writeCases(roomCase);
  const std::string file =
      mistake({"regress", (folder_ / "cases.toml").string(), "--out", (folder_ / "room.toml").string()});
  EXPECT_TRUE(contains(file, "room.toml cannot be made (a folder for the report)"));
  EXPECT_EQ(regress({"--filter", "hall*"}).exitCode, 2);
  EXPECT_EQ(regress({"--update", "hall*"}).exitCode, 2);
  EXPECT_EQ(speculum({"regress"}).exitCode, 2);
  writeCases("[[case]]\nscene = 'hall.toml'\n");
  const ProcessResult result = regress({});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_EQ(std::ranges::count(result.output, '\n'), 1) << result.output;
}

}  // namespace
}  // namespace speculum
