// Cases of `regress`: the file, expectations of drivers, limits, worker processes.
#include <csignal>
#include <regex>

#include "error_message.hpp"
#include "image/picture_files.hpp"
#include "instrumented.hpp"
#include "made_pictures.hpp"
#include "platform/process.hpp"
#include "regress/case_file.hpp"
#include "regress/picture_check.hpp"
#include "regress/worker_pool.hpp"
#include "scene/input_error.hpp"
#include "settings/settings.hpp"
#include "temporary_folder.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

constexpr const char* mesa22 = "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)";
constexpr const char* nvidia = "NVIDIA 550.54.15";

class CaseFile : public testing::Test {
 protected:
  std::vector<RegressCase> read(const std::string& text) {
    folder_.write("room.toml", "");
    folder_.write("hall.toml", "");
    return readCases(folder_.write("cases.toml", text));
  }
  // Returns the error message about the file, without the file's folder.
  std::string mistake(const std::string& text) {
    return messageOf<InputError>([&] { read(text); }).substr(folder_.path().string().size() + 1);
  }
  TemporaryFolder folder_;
};

TEST_F(CaseFile, GivesDefaultsToEveryCase) {
  const auto cases = read(R"(
[defaults]
size = "320x180"
settings = { "view.samples" = 1, reflection.scale = 0.5 }
tolerance = { share = 0.01, flip = 0.02 }
timeout = 5
[[case]]
scene = "room.toml"
[[case]]
name = "far"
scene = "gallery"
time = 2.5
camera = "0,1,4:0,1,0"
picture = "old/{name}.png"
settings = { "reflection.scale" = 2 }
tolerance = { share = 0.5 }
)");
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].name, "room");
  EXPECT_EQ(cases[0].line, 7);
  EXPECT_EQ(cases[0].scene, folder_ / "room.toml");
  EXPECT_EQ(cases[0].picture, folder_ / "room.png");
  EXPECT_EQ(cases[0].size, (PictureSize{320, 180}));
  EXPECT_EQ(cases[0].timeout, 5.0);
  EXPECT_EQ(cases[0].tolerance, (Tolerance{.maxDiff = 3, .share = 0.01, .block = true, .flip = 0.02}));
  EXPECT_EQ(cases[0].settings, (decltype(cases[0].settings){{"reflection.scale", "0.5"}, {"view.samples", "1"}}));
  EXPECT_EQ(cases[1].name, "far");
  EXPECT_EQ(cases[1].scene.filename(), "gallery.toml");
  EXPECT_EQ(cases[1].time, 2.5);
  EXPECT_EQ(cases[1].camera, "0,1,4:0,1,0");
  EXPECT_EQ(cases[1].picture, folder_ / "old/far.png");
  EXPECT_EQ(cases[1].tolerance.share, 0.5);
  EXPECT_EQ(cases[1].settings, (decltype(cases[0].settings){{"reflection.scale", "2.0"}, {"view.samples", "1"}}));
}

TEST_F(CaseFile, GridsMultiply) {
  const auto cases = read(R"(
[[case]]
grid = { scene = ["room.toml", "hall.toml"], time = [0, 2.5], "reflection.max_depth" = [1, 4] }
)");
  ASSERT_EQ(cases.size(), 8u);
  EXPECT_EQ(cases[0].name, "room_reflection.max_depth=1_time=0");
  EXPECT_EQ(cases[7].name, "hall_reflection.max_depth=4_time=2.5");
  EXPECT_EQ(cases[7].time, 2.5);
  EXPECT_EQ(cases[7].settings, (decltype(cases[0].settings){{"reflection.max_depth", "4"}}));
}

TEST_F(CaseFile, ColorsHaveTheSameFormsEverywhere) {
  const auto cases = read(R"(
[defaults]
scene = "room.toml"
settings."view.clear_color" = [0, 0, 1]
[[case]]
grid."view.clear_color" = [[1, 0, 0], "0,1,0", [], ""]
name = "grid"
[[case]]
settings."view.clear_color" = ""
name = "sky"
[[case]]
settings."view.clear_color" = "0,1,0"
name = "green"
)");
  std::vector<std::optional<glm::dvec3>> colors;
  for (const RegressCase& one : cases) {
    Settings settings;
    for (const auto& [key, value] : one.settings) {
      EXPECT_EQ(setSetting(settings, key, value), std::nullopt);
    }
    colors.push_back(settings.view.clearColor);
  }
  const std::optional<glm::dvec3> sky;
  const glm::dvec3 green(0, 1, 0);
  EXPECT_EQ(colors, (std::vector<std::optional<glm::dvec3>>{glm::dvec3(1, 0, 0), green, sky, sky, sky, green}));
}

TEST_F(CaseFile, NamesKeepWhatFilesCanBeCalled) {
  const auto named = [&](const std::string& name) {
    return read("[[case]]\nscene = 'room.toml'\nname = \"" + name + "\"\n")[0].name;
  };
  EXPECT_EQ(named("Büro-1,a=b+c.d_e"), "Büro-1,a=b+c.d_e");
  EXPECT_EQ(named("комната 部屋 😀"), "комната_部屋_😀");
  EXPECT_EQ(named("a/b\\\\c:d*e?f<g>h|i\\\"j"), "a_b_c_d_e_f_g_h_i_j");
  EXPECT_EQ(named("a\\u001bb\\u0085c\\u202ed\\u2028e\\uffff"), "a_b_c_d_e_");
}

TEST_F(CaseFile, EveryNameInAPictureIsReplaced) {
  EXPECT_EQ(read("[[case]]\nscene = 'room.toml'\npicture = '{name}/{name}.png'\n")[0].picture,
            folder_ / "room/room.png");
}

TEST_F(CaseFile, GridsOfLongCasesAreBounded) {
  const auto numbers = [](int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
      text += std::to_string(i) + ", ";
    }
    return "[" + text + "]";
  };
  const std::string grid = "\ngrid = { time = " + numbers(100) + ", 'view.exposure' = " + numbers(100) + " }\n";
  std::string expectations;
  std::string folders;
  for (int i = 0; i < 1000; ++i) {
    expectations += "{ driver = 'llvmpipe' }, ";
    folders += "a/a/a/a/a/a/a/a/a/a/";
  }
  const std::string text = "[[case]]\nscene = 'room.toml'\n";
  for (const std::string& more : {"expect = [" + expectations + "]", "camera = '" + std::string(30'000, 'c') + "'",
                                  "picture = '" + folders + "{name}.png'"}) {
    EXPECT_TRUE(contains(mistake(text + more + grid), "grid: makes cases of more than 256 MiB")) << more.substr(0, 20);
  }
  EXPECT_EQ(read(text + "expect = [" + expectations + "]").size(), 1u);
}

TEST_F(CaseFile, PicturesAreBoundedBeforeTheyAreMade) {
  const std::string text = "[[case]]\nscene = 'room.toml'\n";
  const auto repeated = [](const std::string& part, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) {
      all += part;
    }
    return all;
  };
  const std::string names = repeated("{name}", 40'000);
  const std::string longName = "name = '" + std::string(200, 'n') + "'\n";
  for (const std::string& more :
       {longName + "picture = '" + names + "'", "picture = '" + names + "'",
        longName + "expect = [{ driver = '', picture = '" + names + ".png' }]",
        "picture = '" + repeated("a/", 40'000) + "'", "picture = '" + std::string(70'000, 'p') + "'"}) {
    EXPECT_TRUE(contains(mistake(text + more), "picture: has more than 65536 bytes")) << more.substr(0, 20);
  }
  const std::string many =
      repeated("{ driver = '', picture = '" + repeated("{name}", 320) + ".png' }, ", 5'000);  // 320 MB
  EXPECT_TRUE(contains(mistake(text + longName + "expect = [" + many + "]"), "makes cases of more than 256 MiB"));
  // Names take twice the memory where paths have wide characters.
  const bool wide = sizeof(std::filesystem::path::value_type) > 1;
  EXPECT_LT(peakResidentBytes(), testing_support::instrumented * (uint64_t{wide ? 1536u : 1024u} << 20));
  const std::string deep = repeated("a/", 40'000);
  EXPECT_TRUE(contains(mistake("[[case]]\nscene = '" + deep + "'"), "scene: is 'a/a/"));
  EXPECT_TRUE(contains(mistake(text + "mask = '" + deep + "'"), "mask: is 'a/a/"));
}

TEST_F(CaseFile, MistakesNameLineAndKey) {
  EXPECT_EQ(mistake(""), "cases.toml:1: case: is missing (write [[case]] above each case)");
  EXPECT_EQ(mistake("[[case]]\nscen = 'room.toml'"),
            "cases.toml:2: case[0].scen: is not a known key (did you mean 'scene'?)");
  EXPECT_EQ(mistake("[[case]]\ntime = 1"),
            "cases.toml:1: case[0].scene: is missing (a scene file, or a name of speculum scenes, is needed)");
  EXPECT_EQ(mistake("[[case]]\nscene = 'attic.toml'"),
            "cases.toml:2: case[0].scene: is 'attic.toml' (a file beside this one, or a name of speculum scenes, is "
            "needed)");
  const std::string room = "[[case]]\nscene = 'room.toml'\n";
  EXPECT_EQ(mistake(room + room),
            "cases.toml:3: case[1].name: 'room' is already the name of an earlier case (names must be unique)");
  EXPECT_EQ(mistake(room + "name = 'a b'\n" + room + "name = 'a_b'"),
            "cases.toml:6: case[a_b].name: 'a_b' and an earlier case, 'a b', would both have files called 'a_b' (names "
            "must be unique)");
  EXPECT_EQ(mistake(room + "name = 'a b'\n" + room + "name = 'A_b'"),
            "cases.toml:6: case[A_b].name: 'A_b' and an earlier case, 'a b', would both have files called 'A_b' where "
            "case does not count (names must be unique)");
  EXPECT_EQ(mistake(room + "name = '" + std::string(201, 'a') + "'"),
            "cases.toml:3: case[" + std::string(201, 'a') +
                "].name: makes names of more than 200 bytes (shorter ones are needed)");
  EXPECT_EQ(mistake(room + "size = '8x8'\ngrid = { time = [1, 2, 1] }"),
            "cases.toml:4: case[0].grid: 'room_time=1' is already the name of an earlier case (names must be unique)");
  EXPECT_EQ(mistake(room + "expect = { driver = 'nvidia' }"),
            "cases.toml:3: case[0].expect: is a table (write [[case.expect]] above each)");
  for (const char* picture : {"{nam}.png", "{name}", "{name}.jpg", "{name}.png.exr", "{{name}.png", "{name}/.png"}) {
    for (const std::string& keys :
         {std::string("picture = '"), std::string("expect = [{ driver = 'nvidia', picture = '")}) {
      EXPECT_TRUE(contains(mistake(room + keys + picture + (keys[0] == 'p' ? "'" : "' }]")),
                           std::string(keys[0] == 'p' ? "case[0]" : "case[0].expect[0]") + ".picture: is '" + picture +
                               "' (a PNG file is needed, such as \"{name}.png\")"));
    }
  }
  EXPECT_TRUE(startsWith(mistake(room + "size = '640'"), "cases.toml:3: case[0].size: is '640' ("));
  EXPECT_EQ(mistake(room + "size = [640, 360]"),
            "cases.toml:3: case[0].size: is an array (a string such as \"640x360\" is needed)");
  EXPECT_TRUE(startsWith(mistake(room + "camera = '1,2'"), "cases.toml:3: case[0].camera: "));
  EXPECT_TRUE(startsWith(mistake(room + "settings = { view.samples = 3 }"), "cases.toml:3: view.samples: "));
  EXPECT_EQ(mistake(room + "settings = { quality.budget_ms = 5 }"),
            "cases.toml:3: case[0].settings: quality.budget_ms and quality.max_error choose from a sweep (cases have "
            "none)");
  EXPECT_TRUE(startsWith(mistake(room + "grid = { 'view.sample' = [1] }"), "cases.toml:3: case[0].grid.view.sample: "));
  EXPECT_EQ(mistake(room + "tolerance = { share = 2 }"),
            "cases.toml:3: case[0].tolerance.share: is 2 (a number 0 .. 1 is needed)");
  EXPECT_EQ(mistake(room + "expect = [{ driver = 'nvidia', result = 'skip' }]"),
            "cases.toml:3: case[0].expect[0].reason: is missing (a sentence that says why is needed)");
  EXPECT_EQ(mistake(room + "expect = [{ driver = 'nvidia', version = '25' }]"),
            "cases.toml:3: case[0].expect[0].version: '25' is no range (comparisons such as \">=25,<26\" are needed)");
  EXPECT_EQ(mistake(room + "mask = 'mask.png'"), "cases.toml:3: case[0].mask: is 'mask.png' (a PNG file is needed)");
}

TEST(Driver, FamiliesAreWordsOfItsText) {
  EXPECT_TRUE(isOfFamily(mesa22, "lavapipe"));
  EXPECT_TRUE(isOfFamily(mesa22, "Mesa"));
  EXPECT_FALSE(isOfFamily(mesa22, "nvidia"));
  EXPECT_TRUE(isOfFamily(nvidia, "nvidia"));
}

TEST(Driver, RangesCompareThePartsTheyName) {
  for (const char* range : {"=22", "=22.3", ">=22", "<=22", "<22.4", ">22.3.5", ">=22,<23", " >= 22.3 , < 25 "}) {
    EXPECT_TRUE(isInVersions(mesa22, range)) << range;
  }
  for (const char* range : {"=23", ">22", "<22.3.6", ">=23,<26", ">22.3.6"}) {
    EXPECT_FALSE(isInVersions(mesa22, range)) << range;
  }
  EXPECT_FALSE(isInVersions("a driver without one", ">=0"));
  EXPECT_THROW(isInVersions(mesa22, ">=twenty"), std::invalid_argument);
  EXPECT_THROW(isInVersions(mesa22, ""), std::invalid_argument);
  EXPECT_THROW(isInVersions(mesa22, ">=20,"), std::invalid_argument);
}

// Compares with the grammar as a regular expression, whose library takes no long text.
TEST(Driver, RangesFollowTheirGrammar) {
  const std::regex grammar(
      " *(>=|<=|>|<|=) *[0-9]{1,9}(\\.[0-9]{1,9})* *(, *(>=|<=|>|<|=) *[0-9]{1,9}(\\.[0-9]{1,9})* *)*");
  const std::regex tenDigits("[0-9]{10}");
  std::mt19937 random(1);
  const std::vector<std::string> pieces{">", "<", "=",  ">=",   "<=",        ",", ".",  " ",
                                        "0", "7", "22", "22.3", "123456789", "x", "-1", "+1"};
  int ranges = 0;
  for (int i = 0; i < 5'000; ++i) {
    std::string range;
    for (size_t k = random() % 7; k > 0; --k) {
      range += pieces[random() % pieces.size()];
    }
    bool accepted = true;
    try {
      isInVersions(mesa22, range);
    } catch (const std::invalid_argument&) {
      accepted = false;
    }
    const bool tooLarge = std::regex_search(range, tenDigits);
    EXPECT_TRUE(tooLarge || accepted == std::regex_match(range, grammar)) << range;
    ranges += accepted;
  }
  EXPECT_GT(ranges, 50);
}

TEST(Driver, RangesOfAnyLengthAreRead) {
  for (const std::string part : {">=22,", "<=22.3,", ">22.2 , ", "=22.3.6,"}) {
    std::string range;
    for (int i = 0; i < 100'000; ++i) {
      range += part;
    }
    EXPECT_TRUE(isInVersions(mesa22, range + "<23"));
    EXPECT_FALSE(isInVersions(mesa22, range + "<22"));
    EXPECT_THROW(isInVersions(mesa22, range), std::invalid_argument);
  }
  std::string version = ">=22";
  for (int i = 0; i < 100'000; ++i) {
    version += ".0";
  }
  EXPECT_TRUE(isInVersions(mesa22, version));
  EXPECT_THROW(isInVersions(mesa22, ">=" + std::string(1'000'000, '9')), std::invalid_argument);
  EXPECT_FALSE(isInVersions(std::string(1'000'000, '1') + " " + std::string(1'000'000, '.'), ">=0"));
  EXPECT_TRUE(isInVersions("driver 3, 550.54.15", "=550.54"));
}

TEST_F(CaseFile, FirstExpectationThatMatchesWins) {
  const auto cases = read(R"(
[defaults]
expect = [{ driver = "lavapipe", version = ">=25", result = "skip", reason = "hangs" },
          { driver = "lavapipe", picture = "soft/{name}.png", tolerance = { max_diff = 9 } },
          { driver = "mesa", result = "fail", reason = "never reached" }]
[[case]]
scene = "room.toml"
)");
  EXPECT_EQ(expectedOf(cases[0], "llvmpipe Mesa 25.0.7").result, ExpectedResult::skip);
  const ExpectedCase old = expectedOf(cases[0], mesa22);
  EXPECT_EQ(old.result, ExpectedResult::pass);
  EXPECT_EQ(old.subject.picture, folder_ / "soft/room.png");
  EXPECT_EQ(old.subject.tolerance, (Tolerance{.maxDiff = 9, .share = 0.001, .block = true}));
  EXPECT_EQ(expectedOf(cases[0], nvidia).subject.picture, folder_ / "room.png");
}

class Limits : public testing::Test {
 protected:
  static Image8 grey() { return testing_support::greyPicture(100, 100, 100); }
  // The picture with a rectangle raised by `by`.
  static Image8 raised(int left, int top, int width, int height, int by) {
    Image8 picture = grey();
    for (int i = 0; i < width * height; ++i) {
      picture.at(left + i % width, top + i / width)[1] += static_cast<uint8_t>(by);
    }
    return picture;
  }
  std::string problem(const Image8& actual) const {
    return checkPicture(grey(), actual, subject_).problem.value_or("");
  }
  RegressCase subject_{.tolerance = {.maxDiff = 3, .share = 0.001, .block = true}};
};

TEST_F(Limits, AreKeptUpToTheirValue) {
  EXPECT_EQ(problem(raised(0, 0, 100, 100, 3)), "");
  EXPECT_EQ(problem(raised(20, 20, 10, 1, 4)), "");
  EXPECT_EQ(problem(raised(20, 20, 11, 1, 4)), "0.11 % of the pixels differ by more than 3/255 (limit 0.1 %)");
  EXPECT_EQ(problem(raised(20, 20, 3, 3, 4)), "every pixel of the 3x3 block at 20, 20 differs by more than 3/255");
  subject_.tolerance.block = false;
  EXPECT_EQ(problem(raised(20, 20, 3, 3, 4)), "");
}

TEST_F(Limits, FlipFindsWhatNoPixelShows) {
  const Image8 tinted = raised(0, 0, 100, 100, 2);
  EXPECT_EQ(problem(tinted), "");
  subject_.tolerance.flip = 0.005;
  EXPECT_TRUE(startsWith(problem(tinted), "mean FLIP is 0.0"));
  subject_.tolerance.flip = 1.0;
  subject_.tolerance.flipP99 = 0.005;
  EXPECT_TRUE(startsWith(problem(tinted), "FLIP, 99th percentile is 0.0"));
  EXPECT_EQ(problem(grey()), "");
}

TEST_F(Limits, CountOnlyPixelsOfTheMask) {
  const TemporaryFolder folder;
  Image8 mask = grey();
  mask.at(0, 0)[0] = 255;
  writePng(folder / "mask.png", mask);
  subject_.mask = folder / "mask.png";
  EXPECT_EQ(problem(raised(20, 20, 50, 50, 100)), "");
  EXPECT_NE(problem(raised(0, 0, 1, 1, 100)), "");
  for (const Image8& wrong : {Image8(5, 5), grey()}) {
    writePng(folder / "mask.png", wrong);
    EXPECT_THROW(problem(grey()), std::runtime_error) << "of another size, or without a pixel that counts";
  }
}

TEST_F(Limits, FaultsAreBounded) {
  const TemporaryFolder folder;
  Image8 actual = raised(40, 10, 1, 60, 90);
  actual.at(90, 90)[0] = 0;
  Outcome outcome;
  judge(grey(), actual, subject_, CaseFiles(folder.path(), "seam"), outcome);
  EXPECT_EQ(outcome.verdict, Verdict::failed);
  EXPECT_TRUE(outcome.replaceable);
  EXPECT_EQ(outcome.region, (std::vector<int>{40, 10, 1, 60}));
  const Image8 shown = readImage8(folder / "seam.difference.png");
  EXPECT_EQ(shown.at(41, 30)[1], 255) << "as wide as three pixels";
  EXPECT_EQ(shown.at(43, 30)[1], 0);
  EXPECT_EQ(readImage8(folder / "seam.actual.png").rgba, actual.rgba);
}

TEST(ExpectedFailure, TurnsTheVerdict) {
  ExpectedCase expected{.result = ExpectedResult::fail, .reason = "bug 7"};
  Outcome outcome{.verdict = Verdict::failed, .replaceable = true};
  applyExpectation(expected, outcome);
  EXPECT_EQ(outcome.verdict, Verdict::passed);
  EXPECT_FALSE(outcome.replaceable);
  EXPECT_EQ(outcome.message, "fails as expected: bug 7");
  outcome = {};
  applyExpectation(expected, outcome);
  EXPECT_EQ(outcome.verdict, Verdict::failed);
  outcome = {.verdict = Verdict::error};
  applyExpectation(expected, outcome);
  EXPECT_EQ(outcome.verdict, Verdict::error);
}

// Returns the replies of workers that are shell scripts.
std::vector<WorkerReply> replies(const std::string& script, int workers, const std::vector<WorkerJob>& jobs) {
  std::vector<WorkerReply> all(jobs.size());
  EXPECT_TRUE(
      runWorkers({"sh", "-c", script}, workers, jobs, [&](size_t i, const WorkerReply& reply) { all[i] = reply; }));
  return all;
}

TEST(Workers, AnswerAndStay) {
  std::vector<WorkerJob> jobs;
  for (int i = 0; i < 20; ++i) {
    jobs.push_back({std::to_string(i), i % 2 ? "odd" : "even", 10.0});
  }
  const auto all = replies("n=0; while read x; do n=$((n+1)); echo hello; echo reply $x $n; done", 2, jobs);
  int most = 0;
  for (size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].end, JobEnd::answered);
    EXPECT_EQ(all[i].text.substr(0, all[i].text.find(' ')), std::to_string(i));
    EXPECT_EQ(all[i].log, std::vector<std::string>{"hello"});
    most = std::max(most, std::stoi(all[i].text.substr(all[i].text.find(' '))));
  }
  EXPECT_GE(most, 10) << "one of two workers draws at least half";
}

TEST(Workers, AreReplacedWhenTheyCrashOrHang) {
  const auto all = replies(
      "while read x; do case $x in crash) echo ouch; kill -SEGV $$;; hang) while :; do sleep 0.1; done;; quit) exit "
      "3;; "
      "*) echo reply $x;; esac; done",
      1,
      {{"a", "", 10.0}, {"crash", "", 10.0}, {"b", "", 10.0}, {"hang", "", 0.3}, {"quit", "", 10.0}, {"c", "", 10.0}});
  EXPECT_EQ(all[0].text, "a");
  EXPECT_EQ(all[1].end, JobEnd::crashed);
  EXPECT_EQ(all[1].text, "the worker was ended by signal 11");
  EXPECT_EQ(all[1].log, std::vector<std::string>{"ouch"});
  EXPECT_EQ(all[2].text, "b");
  EXPECT_EQ(all[3].end, JobEnd::timedOut);
  EXPECT_GE(all[3].seconds, 0.3);
  EXPECT_EQ(all[4].text, "the worker ended with exit code 3");
  EXPECT_EQ(all[5].text, "c");
}

TEST(Workers, PassOnExceptions) {
  EXPECT_THROW(runWorkers({"sh", "-c", "while read x; do echo reply $x; done"}, 2, {{"a", "", 10.0}, {"b", "", 10.0}},
                          [](size_t, const WorkerReply&) { throw std::runtime_error("disk full"); }),
               std::runtime_error);
}

TEST(Workers, InterruptAfterTheLastAnswerLosesNothing) {
  const auto run = [] {
    installInterruptHandler();
    // No destructors: they would wait for threads that the fork did not copy.
    std::_Exit(runWorkers({"sh", "-c", "while read x; do echo reply $x; done"}, 1, {{"a", "", 10.0}},
                          [](size_t, const WorkerReply&) { std::raise(SIGINT); })
                   ? 0
                   : 1);
  };
  EXPECT_EXIT(run(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace speculum
