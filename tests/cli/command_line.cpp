// The program as scripts call it: exit codes, errors of one line, files and figures.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <numbers>

#include "command_support.hpp"
#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "instrumented.hpp"
#include "picture_support.hpp"
#include "scene_text.hpp"

namespace speculum {
namespace {

using namespace testing_support;
namespace fs = std::filesystem;

std::string smallScene() {
  return replaced(wallScene, "name = \"wall\"", "name = \"wall\", spin = [0, 0, 20]") + R"(
[[mirror]] position = [0, 1, 9], size = [1, 1]
[[bookmark]] name = "aside", position = [1, 2, 4], target = [0, 1, 0]
[[bookmark]] name = "near, with a wide view", position = [0, 1, 2], target = [0, 1, 0], vertical_fov = 90
)";
}

class CommandLine : public testing::Test {
 protected:
  std::string scene_ = writeScene("command_line", smallScene()).string();
  TemporaryDirectory out_;
  std::string out(const std::string& name) const { return (out_.path() / name).string(); }
  // Renders a small picture of the scene.
  void render(const std::string& name, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"render", "--scene", scene_, "--size", "64x36", "--out", out(name)});
    succeed(more);
  }
  Image8 rendered(const std::vector<std::string>& more) {
    render("p.png", more);
    return readImage8(out("p.png"));
  }
};

struct UsageCase {
  std::vector<std::string> arguments;
  std::string says;
};

class UsageErrors : public testing::TestWithParam<UsageCase> {};

TEST_P(UsageErrors, AreOneLineAndExitTwo) {
  EXPECT_TRUE(contains(mistake(GetParam().arguments), GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(
    All, UsageErrors,
    testing::Values(
        UsageCase{{"paint"}, "paint"}, UsageCase{{"render"}, "--out"}, UsageCase{{"render", "--out"}, "--out"},
        UsageCase{{"regress"}, "cases is required (see speculum regress --help)"},
        UsageCase{{"regress", "--update"}, "cases is required (see"},
        UsageCase{{"regress", "--update=room"}, "cases is required, and 'room' is no file (see"},
        UsageCase{{"regress", "--update", "a", "b.toml", "c.toml"}, "'c.toml' is not expected of regress"},
        UsageCase{{"render", "--out", "x.png", "--out", "y.png"}, "--out: is given more than once (see"},
        UsageCase{{"render", "--out", "x.png", "--camera", ""}, "--camera: an empty name"},
        UsageCase{{"render", "--out", "x.png", "--gpu", ""}, "--gpu: an empty name"},
        UsageCase{{"info", "--gpu", "No Such GPU"}, "--gpu: no GPU 'No Such GPU'"},
        UsageCase{{"accuracy", "--out", "x", "--scene", "no_mirror", "--sweep", "fast"},
                  "--sweep: 'fast' is no file (quick, full, or a TOML file)"},
        UsageCase{{"render", "--out", "x.jpg"}, "'x.jpg' has no known ending (.png or .exr)"},
        UsageCase{{"render", "--out", "x.png", "--frames", "2"}, "a pattern such as dir/%04d.png"},
        UsageCase{{"render", "--out", "x.png", "--size", "0x10"}, "--size: '0x10' is not a size"},
        UsageCase{{"render", "--out", "x.png", "--size", "640"}, "--size: '640' is not a size"},
        UsageCase{{"render", "--out", "x.png", "--size", "640x-3"}, "--size: '640x-3' is not a size"},
        UsageCase{{"render", "--out", "x.png", "--size", "99999x9"}, "--size: '99999x9' is not a size"},
        UsageCase{{"render", "--out", "x.png", "--time", "soon"}, "--time: 'soon' is not a number (see"},
        UsageCase{{"render", "--scene", "gallery", "--out"}, "--out: needs a value (see"},
        UsageCase{{"render", "--out", "/tmp"}, "'/tmp' is a folder (name a file"},
        UsageCase{{"render", "--out", "x.png", "--time", "nan"}, "--time"},
        UsageCase{{"render", "--out", "x.png", "--time", "1e300"}, "--time: 1e+300 is out of range (-1e15 .. 1e15"},
        UsageCase{{"render", "--out", "x.png", "--camera", "0,1,4"}, "--camera: '0,1,4' is not a camera"},
        UsageCase{{"render", "--out", "x.png", "--camera", "1e100,1,4:0,1,0"}, "--camera: 1e+100 is out of range"},
        UsageCase{{"render", "--out", "x.png", "--camera", "0,1,4:0,1,nan"}, "such as 0,1,4:0,1,0"},
        UsageCase{{"render", "--out", "x.png", "--camera", "0,1,4:0,1,0:"}, "is not a camera"},
        UsageCase{{"render", "--out", "x.png", "--camera", "0,1,4:0,1,0:0,1,0:171"}, "is not a camera"},
        UsageCase{{"render", "--out", "x.png", "--camera", "0,1,4:0,1,4"}, "--camera: the camera's target is its"},
        UsageCase{{"reference", "--out", "x.png", "--camera", "0,1,4:0,2,4"}, "lies along its up vector"},
        UsageCase{{"render", "--out", "x.png", "--camera", "door", "--scene", "single_plane"},
                  "--camera: the scene has no bookmark 'door' (it has none; position:target"},
        UsageCase{{"render", "--out", "x.png", "--fps", "0", "--frames", "1"}, "--fps"},
        UsageCase{{"reference", "--out", "x.png", "--samples", "5"}, "square"},
        UsageCase{{"render", "--out", "x.png", "--scene", ""}, "--scene: an empty name"},
        UsageCase{{"render", "--out", "x.png", "--scene", "nowhere.toml"}, "there is no file 'nowhere.toml'"},
        UsageCase{{"render", "--out", "x.png", "--scene", "/"}, "--scene: '/' is a folder (a scene file"},
        UsageCase{{"render", "--out", "x.png", "--set", "view.exposure"}, "has no value (key=value)"},
        UsageCase{{"render", "--out", "x.png", "--set", "view.exposre=1"}, "did you mean 'view.exposure'?"},
        UsageCase{{"render", "--out", "x.png", "--set", "reflection.scale=9"}, "(0.125 .. 4)"},
        UsageCase{{"render", "--out", "x.png", "--set", "debug.omit_barrier=x"}, "there is no barrier 'x'"},
        UsageCase{{"render", "--out", "x.png", "--render-path", "raster"}, "auto | dynamic | renderpass"},
        UsageCase{{"render", "--out", "x.png", "--log-level", "loud"}, "--log-level"},
        UsageCase{{"render", "--out", "x.png", "--gpu", "No Such GPU"}, "No Such GPU"},
        UsageCase{{"render", "--out", "x.png", "--shader-dir", "/nowhere"}, "/nowhere"},
        UsageCase{{"render", "--out", "x.png", "--bogus"}, "'--bogus' is not an option of render (see speculum render"},
        UsageCase{{"render", "--out", "x.png", "--szie", "9x9"}, "'--szie' is not an option of render (did you mean"},
        UsageCase{{"render", "--szie", "9x9", "--out", "x.png"}, "did you mean '--size'?"},
        UsageCase{{"render", "--outt=x.png"}, "did you mean '--out'?"},
        UsageCase{{"--secne", "gallery"}, "'--secne' is not an option of speculum (did you mean '--scene'?)"},
        UsageCase{{"rendr", "--out", "x.png"}, "'rendr' is not a command (did you mean 'render'?)"},
        UsageCase{{"LICENSE"}, "'LICENSE' is not a command (one of"},
        UsageCase{{"galery"}, "'galery' is not a command (did you mean 'gallery'?)"},
        UsageCase{{"gallery", "mirror_maze"},
                  "'mirror_maze' is not expected there (did you mean '--scene mirror_maze'?)"},
        UsageCase{{"demo", "gallery", "mirror_maze"}, "not expected of demo (did you mean '--scene mirror_maze'?)"},
        UsageCase{{"render", std::string(300, 'a')}, "is not expected of render"},
        UsageCase{{"demo", "galery"}, "'galery' is neither a scene nor a file (did you mean 'gallery'?)"},
        UsageCase{{"demo", "garden.tmol"},
                  "'garden.tmol' is neither a scene nor a file (speculum scenes lists scenes)"},
        UsageCase{{"render", "gallery", "--out", "x.png"}, "not expected of render (did you mean '--scene gallery'?)"},
        UsageCase{{"bench", "hard/grazing"}, "not expected of bench (did you mean '--scene hard/grazing'?)"},
        UsageCase{{"info", "gallery"}, "'gallery' is not expected of info (see speculum info --help)"},
        UsageCase{{"render", "--scene", "galery", "--out", "x.png"}, "no file 'galery' (did you mean 'gallery'?)"},
        UsageCase{{"render", "--scene", "galery.toml", "--out", "x.png"}, "(did you mean 'gallery'?)"},
        UsageCase{{"frobnicate"}, "'frobnicate' is not a command (one of: demo render"},
        UsageCase{{"render", "--out", "/nowhere/at/all.png", "--size", "8x8", "--scene", "no_mirror"},
                  "/nowhere/at/all.png"},
        UsageCase{{"render", "--out", "x.png", "--size", "8x8", "--capture", "x.rdc"}, "RenderDoc is not loaded"},
        UsageCase{{"demo", "--platform", "mir"}, "--platform"}, UsageCase{{"bench", "--frames", "0"}, "--frames"},
        UsageCase{{"compare", "a.png", "b.png", "--max-diff", "-1"}, "-1 not in range 0 to 1000000 ("},
        UsageCase{{"compare", "a.png", "b.png", "--max-flip", "-1"}, "-1 not in range 0.000000 to 1000000.000000 ("},
        UsageCase{{"bench", "--warmup", "-1"}, "--warmup"},
        UsageCase{{"bench", "--reference", "--prices"}, "--reference: measures alone"},
        UsageCase{{"bench", "--reference", "--scene", "nosuch"}, "--reference: measures alone (leave out --scene)"},
        UsageCase{{"render", "--out", "x.png", "--fps", "3"}, "--fps requires --frames"},
        UsageCase{{"render", "--out", "x.png", "--scene", "no_mirror", "--sweep-results", "nosuch.json"},
                  "--sweep-results: chooses nothing without a bound (--set quality.budget_ms=MS or"},
        UsageCase{{"compare", "a.png", "b.png", "--heatmap", "error.exr"}, "'error.exr' must end in .png"},
        UsageCase{{"compare", "a.png", "b.png", "--heatmap", "error.jpg"}, "'error.jpg' must end in .png"}));

TEST_F(CommandLine, StrictRefusesModelsWithDefects) {
  const std::string good = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  replaceFile(out("good.OBJ"), good);
  replaceFile(out("bad.Obj"), good + "f 1 2 9\n");
  for (const char* command : {"render", "reference"}) {
    const auto arguments = [&](const char* model, bool strict) {
      std::vector<std::string> all{command, "--scene", out(model), "--size", "8x8", "--out", out("p.png")};
      if (strict) {
        all.insert(all.end(), {"--strict", "--log-level", "error"});
      }
      return all;
    };
    succeed(arguments("good.OBJ", true));
    succeed(arguments("bad.Obj", false));
    EXPECT_TRUE(contains(mistake(arguments("bad.Obj", true)),
                         "bad.Obj:5: f: has a vertex that is not there, the face is left out (strict: "));
  }
}

// No device has images of 2^20 texels a side.
TEST_F(CommandLine, StrictRefusesPicturesBeyondTheDevice) {
  writePng(out("line.png"), Image8(1 << 20, 1));
  replaceFile(out("m.mtl"), std::string("newmtl m\nmap_Kd line.png\n"));
  replaceFile(out("line.obj"), std::string("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n"));
  std::vector<std::string> arguments{"render", "--scene", out("line.obj"), "--size", "8x8", "--out", out("p.png")};
  EXPECT_TRUE(contains(succeed(arguments), "texels, the device's largest side is"));
  arguments.emplace_back("--strict");
  EXPECT_TRUE(contains(mistake(arguments), "line.png: has 1048576x1 texels, the device's largest side is"));
}

TEST_F(CommandLine, MessagesCanBeReadWhateverTheyName) {
  for (const std::string& text : {std::string("\x1b[2J\n\x7f"), std::string(100'000, 'x')}) {
    const std::string file = out(text + ".toml");
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--size", text},
                                                      {"--camera", text},
                                                      {"--set", text},
                                                      {"--set", text + "=1"},
                                                      {"--set", "view.exposure=" + text},
                                                      {"--scene", file},
                                                      {"--gpu", text},
                                                      {"--" + text},
                                                      {"--fps", text}}) {
      std::vector<std::string> all{"render", "--scene", scene_, "--size", "8x8", "--out", out("x.png")};
      // An option may stand only once.
      if (const auto same = std::ranges::find(all, arguments.front()); same != all.end()) {
        all.erase(same, same + 2);
      }
      all.insert(all.end(), arguments.begin(), arguments.end());
      mistake(all);
    }
    mistake({"compare", file, file});
    mistake({"regress", file});
    mistake({text});
  }
}

TEST_F(CommandLine, WarningsCanBeReadWhateverTheyName) {
  const std::string model = out("triangle.obj");
  replaceFile(model, "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\x1b[2J" + std::string(100'000, 'x') + "\nf 1 2 3\n");
  const std::string warnings = succeed({"reference", "--scene", model, "--size", "2x2", "--out", out("x.png")});
  EXPECT_TRUE(contains(warnings, R"('a\x1b[2Jxxx)")) << warnings;
  EXPECT_LT(warnings.size(), 10'000u);
}

TEST_F(CommandLine, TablesCanBeReadWhateverTheyName) {
  const std::string scene =
      writeScene("foreign", wallScene + std::string("[[mirror]] name = \"a\\u001b[2J\\n::error::b\\u202e##[error]c\", "
                                                    "position = [0.2, 1, 0.3], size = [1, 1]\n"));
  const std::string table =
      succeed({"bench", "--scene", scene, "--size", "16x9", "--frames", "1", "--warmup", "0", "--log-level", "error"});
  EXPECT_TRUE(contains(table, R"(a\x1b[2J\x0a::error::b\u202e#\x23[error]c)"));
  EXPECT_FALSE(contains(table, "\n::"));
}

// Too little for a device, for its compiler, for the pictures, and enough.
TEST_F(CommandLine, LimitedMemoryEndsInOneLine) {
  if (instrumented > 1) {
    GTEST_SKIP() << "sanitizers reserve terabytes of addresses";
  }
  replaceFile(out("cases.toml"), "[[case]]\nscene = '" + scene_ + "'\nsize = '64x36'\n");
  const auto limited = [&](int mebibytes, const std::vector<std::string>& arguments) {
    std::vector<std::string> command{"sh", "-c", "ulimit -v $0 && exec \"$@\"", std::to_string(mebibytes << 10),
                                     program};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return runProcess(command);
  };
  int failed = 0;
  for (const int mebibytes : {100, 200, 250, 300, 350}) {
    const ProcessResult result =
        limited(mebibytes, {"render", "--scene", scene_, "--size", "1280x720", "--out", out("x.png")});
    EXPECT_TRUE(result.exitCode == 0 || result.exitCode == 2) << mebibytes << ": " << result.output;
    if (result.exitCode == 2) {
      ++failed;
      EXPECT_TRUE(contains(result.output, std::to_string(mebibytes) + " MiB of address space: raise ulimit -v"));
      EXPECT_FALSE(contains(result.output, "bad_alloc"));
      EXPECT_FALSE(contains(result.output, "terminate"));
      EXPECT_FALSE(fs::exists(out("x.png")));
    }
  }
  EXPECT_GE(failed, 3);
  const ProcessResult regress = limited(200, {"regress", out("cases.toml"), "--out", out("report"), "--jobs", "1"});
  EXPECT_EQ(regress.exitCode, 2);
  EXPECT_EQ(occurrences(regress.output, "\n"), 1) << regress.output;
  EXPECT_TRUE(contains(regress.output, "200 MiB of address space: raise ulimit -v"));
  const ProcessResult reference =
      limited(200, {"reference", "--scene", scene_, "--size", "8192x8192", "--samples", "1", "--out", out("x.png")});
  EXPECT_EQ(reference.exitCode, 2);
  EXPECT_TRUE(startsWith(reference.output, "there is not enough memory (use smaller models"));
  EXPECT_EQ(occurrences(reference.output, "\n"), 1) << reference.output;
}

// The threads' stacks of 64 MiB do not fit, as smaller ones on a machine of many cores. Without the last one, lavapipe
// would never finish a draw.
TEST_F(CommandLine, LimitedMemoryForThreadsIsSaidAtOnce) {
  if (instrumented > 1) {
    GTEST_SKIP() << "sanitizers reserve terabytes of addresses";
  }
  for (const int mebibytes : {700, 1000}) {
    const ProcessResult result =
        runProcess({"sh", "-c", "ulimit -s 65536 && ulimit -v $0 && LP_NUM_THREADS=16 exec \"$@\"",
                    std::to_string(mebibytes << 10), program, "render", "--scene", scene_, "--size", "64x36", "--out",
                    out("x.png")});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_EQ(occurrences(result.output, "\n"), 1) << result.output;
    EXPECT_TRUE(contains(result.output, std::to_string(mebibytes) + " MiB of address space: raise ulimit -v"))
        << result.output;
  }
}

// Beyond the user's limit of file sizes a signal would end the program.
TEST_F(CommandLine, FileSizeLimitKeepsTheOldFiles) {
  replaceFile(out("x.png"), "old");
  const ProcessResult result =
      runProcess({"sh", "-c", "ulimit -f 0; exec \"$0\" \"$@\"", program, "reference", "--scene", scene_, "--size",
                  "2x2", "--samples", "1", "--out", out("x.png")});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_EQ(result.output,
            out("x.png") + ": cannot be written: File too large (check the folder's permissions and free space)\n");
  EXPECT_EQ(readText(out("x.png")), "old");
  EXPECT_FALSE(fs::exists(out("x.png.part0")));
}

// A ring of mirrors, each of which shows most others.
TEST_F(CommandLine, StatsOfManyMirrorsAreBounded) {
  std::string ring =
      "[camera] position = [0, 1, 0.1], target = [0.5, 1, 0]\n[settings] \"reflection.max_passes\" = 1000,"
      " \"reflection.max_depth\" = 32, \"reflection.min_pixels\" = 0\n";
  for (int i = 0; i < 150; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 150;
    ring += "[[mirror]] " +
            rectangleText({2.0 * std::sin(angle), 1.0, 2.0 * std::cos(angle)}, {0, 180.0 + 2.4 * i, 0}, 0.075, 2.0) +
            "reflectance = [1, 1, 1]\n";
  }
  const ProcessResult result = speculum({"render", "--scene", writeScene("ring", ring).string(), "--size", "32x18",
                                         "--out", out("a.png"), "--stats", out("a.json"), "--log-level", "warn"});
  EXPECT_EQ(result.exitCode, 0);
  const nlohmann::json stats = nlohmann::json::parse(readText(out("a.json")));
  EXPECT_EQ(stats["skipped"].size(), 100'000u);
  EXPECT_GT(stats["totals"]["skipped_mirrors"], 100'000);
}

// A scene and files whose names are not UTF-8.
TEST_F(CommandLine, EveryOutputKeepsLinksAndPipes) {
  const auto link = [&](const std::string& name) {
    replaceFile(out("behind " + name), "old");
    fs::permissions(out("behind " + name), fs::perms(0640));
    fs::create_symlink("behind " + name, out(name));
    return out(name);
  };
  std::map<std::string, int> pipes;
  const auto pipe = [&](const std::string& name) {
    EXPECT_EQ(::mkfifo(out(name).c_str(), 0600), 0);
    pipes[name] = ::open(out(name).c_str(), O_RDONLY | O_NONBLOCK);
    return out(name);
  };
  fs::create_symlink(scene_, out("\xff.toml"));
  const std::vector<std::string> small{"--scene", out("\xff.toml"), "--size", "2x2"};
  const auto draw = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin() + 1, small.begin(), small.end());
    succeed(arguments);
  };
  draw({"reference", "--samples", "1", "--out", link("\xff.png")});
  draw({"reference", "--samples", "1", "--out", pipe("p.exr")});
  draw({"render", "--out", pipe("\xff p.png"), "--stats", link("s.json")});
  succeed({"compare", out("\xff.png"), out("\xff.png"), "--json", link("c.json"), "--heatmap", pipe("h.png")});
  succeed({"compare", out("\xff.png"), out("\xff.png"), "--json", pipe("c p.json"), "--heatmap", link("h l.png")});
  for (const std::string name : {"\xff.png", "s.json", "c.json", "h l.png"}) {
    EXPECT_TRUE(fs::is_symlink(out(name))) << name;
    EXPECT_NE(readText(out(name)), "old") << name;
    EXPECT_EQ(fs::status(out(name)).permissions(), fs::perms(0640)) << name;
  }
  for (const auto& [name, descriptor] : pipes) {
    char first = 0;
    EXPECT_EQ(::read(descriptor, &first, 1), 1) << name;
    ::close(descriptor);
    EXPECT_TRUE(fs::is_fifo(out(name))) << name;
  }
  EXPECT_TRUE(contains(readJson(out("s.json"))["scene"].get<std::string>(), "\xef\xbf\xbd.toml"));
}

// The folder is checked before the scene is read.
TEST_F(CommandLine, PlacesOfPicturesAreCheckedFirst) {
  for (const std::string command : {"render", "reference"}) {
    EXPECT_TRUE(
        contains(mistake({command, "--scene", "no-such-scene", "--out", out("none/a.png")}), "there is no folder"));
  }
}

TEST_F(CommandLine, LinkLoopsAreNamedInOneLine) {
  const std::string loop = out("loop");
  std::filesystem::create_symlink("loop", loop);
  replaceFile(out("lost.toml"), "[[case]]\nscene = 'loop'\n");
  replaceFile(out("masked.toml"), "[[case]]\nscene = 'no_mirror'\nmask = 'loop'\n");
  replaceFile(out("cases.toml"), "[[case]]\nscene = 'no_mirror'\n");
  const std::string links = ": cannot be read: Too many levels of symbolic links (";
  for (const auto& [arguments, says] : std::vector<UsageCase>{
           {{"render", "--out", out("x.png"), "--scene", loop}, loop + ":1: file" + links},
           {{"render", "--out", out("x.png"), "--scene", loop + "/x.toml"}, loop + "/x.toml:1: file" + links},
           {{"compare", loop, loop}, loop + links},
           {{"regress", out("lost.toml")}, "scene: is 'loop' (a file beside this one"},
           {{"regress", out("masked.toml")}, "mask: is 'loop' (a PNG file"},
           {{"regress", out("cases.toml"), "--out", loop}, loop + " cannot be made (a folder for the report)"}}) {
    EXPECT_TRUE(contains(mistake(arguments), says));
  }
}

// Runs scripts/bench-against with the program.
ProcessResult benchAgainst(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{(sourceDir() / "scripts/bench-against").string(), "--program", program};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return runProcess(command);
}

// Compares with a run of 64 pictures a frame, which is slower by more than any noise.
TEST_F(CommandLine, BenchComparesRunsInTurn) {
  const ProcessResult result = benchAgainst({"--scene", scene_, "--size", "32x18", "--frames", "3", "--warmup", "1",
                                             "--set=view.accumulate=64", "--rounds", "1", "--json", out("r.json")});
  ASSERT_EQ(result.exitCode, 0) << result.output;
  const double ratio = readJson(out("r.json"))["ratios"]["gpu_ms"]["median"];
  EXPECT_GT(ratio, 0.0);
  EXPECT_LT(ratio, 0.5);
  for (const auto& [other, says] : {std::pair("/nowhere", "/nowhere: No such file or directory"),
                                    std::pair("/bin/false", "/bin/false: bench ended with exit code 1"),
                                    std::pair("/bin/true", "/bin/true: bench --json wrote no times")}) {
    const ProcessResult refused = benchAgainst({"--scene", scene_, "--binary", other});
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_TRUE(contains(refused.output, says)) << refused.output;
  }
}

// Runs bench and interrupts it, and no other process, so many seconds after it catches the signal (the last digit of
// SigCgt holds SIGINT), however slow the machine is. Without job control it would ignore the signal in the background.
ProcessResult interruptedBench(const std::string& seconds, const std::vector<std::string>& arguments) {
  const std::string script = R"(set -m; "$0" bench --size 96x54 "${@:2}" & pid=$!
    while ! grep -q '^SigCgt:.*[2367abef]$' /proc/$pid/status; do sleep 0.05; done
    sleep $1; kill -INT $pid; wait $pid)";
  std::vector<std::string> command{"timeout", "60", "bash", "-c", script, program, seconds};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return runProcess(command);
}

// A second later the prices are being measured, which takes many more.
TEST_F(CommandLine, InterruptEndsMeasurementOfPrices) {
  const ProcessResult result = interruptedBench("1", {"--scene", scene_, "--frames", "1", "--warmup", "0", "--prices",
                                                      "--set", "view.accumulate=1024", "--json", out("r.json")});
  EXPECT_EQ(result.exitCode, 1) << result.output;
  EXPECT_TRUE(contains(result.output, "interrupted\n")) << result.output;
  EXPECT_FALSE(std::filesystem::exists(out("r.json")));
}

TEST_F(CommandLine, NoOutputReplacesFilesOfTheScene) {
  const std::filesystem::path folder = out_.path();
  writePng(folder / "wood.png", Image8(2, 2));
  for (const auto& [name, content] :
       {std::pair("a.mtl", "newmtl a\nmap_Kd wood.png\n"),
        std::pair("a.obj", "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n"),
        std::pair("a.toml", "[camera]\nposition = [0, 0, 3]\ntarget = [0, 0, 0]\n[[object]]\nmodel = 'a.obj'\n")}) {
    std::ofstream(folder / name) << content;
  }
  for (const auto& [name, kind] :
       {std::pair("a.obj", "model"), std::pair("a.mtl", "material"), std::pair("wood.png", "texture")}) {
    EXPECT_TRUE(contains(
        mistake({"render", "--scene", out("a.toml"), "--size", "4x4", "--out", out("b.png"), "--stats", out(name)}),
        "--stats: " + out(name) + " is a " + kind + " of the scene too"));
  }
  EXPECT_TRUE(contains(mistake({"reference", "--scene", out("a.toml"), "--size", "4x4", "--out", out("wood.png")}),
                       "--out: " + out("wood.png")));
}

TEST_F(CommandLine, NoOutputReplacesASceneFoundByName) {
  const std::filesystem::path scene = out_.path() / "scenes/a.toml";
  std::filesystem::create_directory(scene.parent_path());
  std::filesystem::copy_file(scene_, scene);
  // The program looks for scenes in the folder that holds it.
  std::filesystem::copy_file(program, out_.path() / "speculum");
  const ProcessResult result = runProcess(
      {out("speculum"), "render", "--scene", "a", "--size", "4x4", "--out", out("a.png"), "--stats", scene.string()});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_TRUE(contains(result.output, "--stats: " + scene.string() + " is the file of --scene too")) << result.output;
}

TEST_F(CommandLine, NoOutputReplacesAnotherOptionsFile) {
  const std::string picture = out("a.png");
  const std::string scene = out("scene.toml");
  std::filesystem::copy_file(scene_, scene);
  for (const auto& [arguments, says] :
       std::vector<UsageCase>{{{"render", "--scene", scene, "--out", picture, "--stats", scene},
                               "--stats: " + scene + " is the file of --scene"},
                              {{"render", "--scene", scene, "--out", picture, "--stats", picture},
                               "--stats: " + picture + " is the file of --out"}}) {
    EXPECT_TRUE(contains(mistake(arguments), says));
  }
  succeed({"render", "--scene", scene, "--size", "4x4", "--out", picture});
  EXPECT_TRUE(contains(mistake({"compare", picture, picture, "--json", picture}), "--json: " + picture));
  const std::string frames = out("f%d.png");
  EXPECT_TRUE(
      contains(mistake({"render", "--scene", scene, "--frames", "3", "--out", frames, "--stats", out("f2.png")}),
               "--out: " + out("f2.png") + " is the file of --stats"));
  std::filesystem::copy_file(scene, out("index.html"));
  EXPECT_TRUE(contains(mistake({"accuracy", "--scene", out("index.html"), "--out", out_.path().string()}),
                       "--out: " + out("index.html") + " is the file of --scene"));
  // A name of a shipped scene is no file.
  EXPECT_FALSE(contains(runProcess({"sh", "-c", R"(cd "$0" && "$1" render --scene none --out a.png --stats none)",
                                    out_.path().string(), program})
                            .output,
                        "--stats"));
  const std::string script = R"(cd "$0" && "$1" render --scene "$2" --out new.png --stats ./new.png)";
  EXPECT_EQ(runProcess({"sh", "-c", script, out_.path().string(), program, scene}).exitCode, 2);
  succeed({"compare", picture, picture, "--json", "/dev/null", "--heatmap", "/dev/null"});
}

TEST_F(CommandLine, DashIsStandardOutput) {
  render("a.png");
  const auto printed = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"sh", "-c", R"(cd "$0" && "$@" 2>messages)", out_.path().string(), program});
    return nlohmann::json::parse(runProcess(arguments).output, nullptr, false);
  };
  EXPECT_EQ(printed({"compare", "a.png", "a.png", "--json", "-"})["max_diff"], 0.0);
  EXPECT_TRUE(contains(readText(out("messages")), "SSIM"));
  EXPECT_EQ(printed({"render", "--scene", scene_, "--size", "64x36", "--out", "b.png", "--stats", "-"})["size"],
            nlohmann::json({64, 36}));
  replaceFile(out("turned.toml"), readText(scene_) + "[[mirror]]\nname = \"\u009b\u202e\"\nsize = [1, 1]\n");
  const std::string stats = runProcess({program, "render", "--scene", out("turned.toml"), "--size", "64x36", "--out",
                                        out("c.png"), "--stats", "-", "--log-level", "error"})
                                .output;
  EXPECT_TRUE(contains(stats, "\\u009b\\u202e")) << "no control characters";
  EXPECT_EQ(printed({"bench", "--scene", scene_, "--size", "64x36", "--frames", "2", "--json", "-"})["frames"], 2);
  EXPECT_TRUE(contains(readText(out("messages")), "interval_ms"));
  EXPECT_FALSE(std::filesystem::exists(out("-")));
}

TEST_F(CommandLine, OutputThatCannotBeWrittenExitsTwo) {
  for (const char* arguments : {"--help", "scenes"}) {
    const ProcessResult result = runProcess({"sh", "-c", "\"$0\" $1 >/dev/full", program, arguments});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_EQ(result.output, "standard output: cannot be written (check the disk that it goes to)\n");
  }
}

TEST_F(CommandLine, HelpAndVersionExitZero) {
  EXPECT_TRUE(contains(succeed({"--help"}), "reflection.max_depth"));
  succeed({"render", "--help"});
  EXPECT_TRUE(startsWith(succeed({"--version"}), "speculum "));
}

// The system's Vulkan loader is hidden by an empty file of its name.
TEST_F(CommandLine, WhatNeedsNoDeviceWorksWithoutVulkan) {
  replaceFile(out("libvulkan.so.1"), "");
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"env", "LD_LIBRARY_PATH=" + out_.path().string(), program});
    return runProcess(arguments);
  };
  const std::string picture = out("r.png");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"},
        {"--version"},
        {"scenes"},
        {"regress", "--help"},
        {"reference", "--scene", scene_, "--size", "16x9", "--samples", "1", "--out", picture},
        {"compare", picture, picture}}) {
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.exitCode, 0) << arguments.front() << ": " << result.output;
  }
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"info"}, {"render", "--scene", scene_, "--out", out("x.png")}}) {
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.exitCode, 2) << result.output;
    EXPECT_TRUE(startsWith(result.output, "Vulkan is missing: ")) << result.output;
    EXPECT_TRUE(contains(result.output, "install libvulkan1")) << result.output;
    EXPECT_EQ(occurrences(result.output, "\n"), 1) << result.output;
  }
}

TEST_F(CommandLine, InfoAndScenesList) {
  EXPECT_TRUE(contains(succeed({"info"}), "llvmpipe"));
  EXPECT_EQ(succeed({"info", "--gpu", "LLVM"}), succeed({"info"}));
  const std::string scenes = succeed({"scenes"});
  for (const char* name : {"gallery", "single_plane", "facing_mirrors", "many_mirrors", "mirror_maze", "no_mirror"}) {
    EXPECT_TRUE(contains(scenes, name)) << name;
  }
  EXPECT_TRUE(contains(scenes, "\nhard/corner ")) << "by the name that --scene takes";
  EXPECT_EQ(findScene("hard/corner"), sceneFile("hard/corner"));
}

TEST_F(CommandLine, BrokenSceneNamesFileAndLine) {
  const std::string broken =
      writeScene("broken", "[camera]\nposition = [0, 0, 0]\ntarget = [0, 0, 1]\nvertical_fow = 3\n");
  const std::string line = mistake({"render", "--scene", broken, "--out", out("x.png")});
  EXPECT_TRUE(startsWith(line, broken + ":4: camera.vertical_fow:"));
  EXPECT_TRUE(contains(line, "vertical_fov"));
  EXPECT_FALSE(fs::exists(out("x.png")));
}

TEST_F(CommandLine, StatsFollowTheirContract) {
  succeed({"render", "--scene", scene_, "--out", out("a.png"), "--size", "160x90", "--stats", out("s.json"), "--set",
           "reflection.max_depth=2", "--validation"});
  const nlohmann::json stats = readJson(out("s.json"));
  EXPECT_EQ(stats["scene"], scene_);
  EXPECT_EQ(stats["size"], nlohmann::json({160, 90}));
  EXPECT_EQ(stats["render_path"], "dynamic");
  EXPECT_EQ(stats["settings"]["reflection.max_depth"], 2);
  ASSERT_EQ(stats["passes"].size(), 3u);
  const nlohmann::json& mirror = stats["passes"][0];
  EXPECT_EQ(mirror["mirror"], "wall");
  EXPECT_EQ(mirror["path"], nlohmann::json::array({"wall"}));
  EXPECT_EQ(mirror["path_indices"], nlohmann::json::array({0}));
  EXPECT_EQ(mirror["depth"], 0);
  EXPECT_GT(mirror["gpu_ms"], 0.0);
  EXPECT_GT(mirror["draws"], 0);
  EXPECT_GT(mirror["triangles"], 0);
  EXPECT_GT(mirror["fragments"], 0);
  EXPECT_GT(mirror["area_px"], 100.0);
  EXPECT_EQ(mirror["samples"], 1);
  EXPECT_GE(mirror["size"][0].get<int>() * mirror["size"][1].get<int>(), mirror["area_px"].get<double>());
  EXPECT_EQ(stats["passes"][1]["size"], nlohmann::json({160, 90}));
  EXPECT_TRUE(stats["passes"][2]["size"].is_null());
  const nlohmann::json& resolution = mirror["depth_resolution"];
  EXPECT_GT(resolution["distance_m"], 0.0);
  EXPECT_GT(resolution["clip_distance_m"], 1e-7 * resolution["distance_m"].get<double>());
  EXPECT_LT(resolution["clip_distance_m"], 1e-3 * resolution["distance_m"].get<double>());
  EXPECT_GE(resolution["oblique_m"], resolution["clip_distance_m"]);
  EXPECT_EQ(resolution["none_m"], resolution["clip_distance_m"]);
  EXPECT_EQ(resolution["in_use_m"], resolution["clip_distance_m"]);
  EXPECT_TRUE(stats["passes"][1]["depth_resolution"].is_null());
  EXPECT_TRUE(stats["passes"][1]["mirror"].is_null());
  EXPECT_TRUE(stats["passes"][1]["depth"].is_null());
  ASSERT_EQ(stats["skipped"].size(), 2u);
  EXPECT_EQ(stats["skipped"][0]["mirror"], 1) << "a mirror without a name is its index";
  EXPECT_EQ(stats["skipped"][0]["path"], nlohmann::json::array({1}));
  EXPECT_EQ(stats["skipped"][0]["depth"], 0);
  EXPECT_EQ(stats["skipped"][0]["reason"], "behind");
  EXPECT_EQ(stats["skipped"][1]["path"], nlohmann::json({"wall", 1}));
  EXPECT_EQ(stats["skipped"][1]["path_indices"], nlohmann::json({0, 1}));
  EXPECT_EQ(stats["effects"].size(), 12u);
  for (const char* key : {"cpu_ms", "gpu_ms", "frame_ms", "device_bytes", "peak_rss_bytes", "pipelines"}) {
    EXPECT_GT(stats["totals"][key], 0) << key;
  }
  EXPECT_EQ(stats["totals"]["validation_messages"], 0);
  EXPECT_EQ(stats["totals"]["non_finite"], 0);
}

TEST_F(CommandLine, AFolderWithoutShadersIsRefused) {
  const TemporaryDirectory shaders;
  std::filesystem::copy(scene_, shaders.path());
  EXPECT_TRUE(contains(mistake({"render", "--scene", scene_, "--size", "4x4", "--out", out("a.png"), "--shader-dir",
                                shaders.path().string()}),
                       shaders.path().string() + ": holds no file with the name of a shader"));
}

TEST_F(CommandLine, AShaderThatDoesNotCompileIsRefused) {
  const TemporaryDirectory shaders;
  writeShaders(shaders.path(), "scene_shading.glsl", "  color.r = nothing;\n");
  EXPECT_TRUE(contains(mistake({"render", "--scene", scene_, "--size", "4x4", "--out", out("a.png"), "--shader-dir",
                                shaders.path().string(), "--log-level", "error"}),
                       "'nothing' : undeclared identifier"));
  EXPECT_FALSE(std::filesystem::exists(out("a.png")));
}

TEST_F(CommandLine, NegativeRadianceExitsOne) {
  const TemporaryDirectory shaders;
  writeShaders(shaders.path(), "scene_shading.glsl", "  color.r = -1.0;\n");
  const auto run = [&](std::vector<std::string> arguments, const std::string& checked) {
    arguments.insert(arguments.end(),
                     {"--shader-dir", shaders.path().string(), "--scene", scene_, "--size", "64x36", "--set",
                      "debug.check_finite=" + checked, "--set", "view.samples=4", "--set", "reflection.samples=4"});
    return speculum(arguments);
  };
  const ProcessResult render = run({"render", "--out", out("n.png"), "--stats", out("n.json")}, "true");
  EXPECT_EQ(render.exitCode, 1);
  EXPECT_TRUE(contains(render.output, "error: debug.check_finite: mirror wall: pixel "));
  EXPECT_EQ(render.output.rfind("debug.check_finite"), render.output.find("debug.check_finite")) << render.output;
  EXPECT_TRUE(contains(render.output, " samples of radiance that are not finite"));
  EXPECT_GT(readJson(out("n.json"))["totals"]["non_finite"], 100);
  EXPECT_EQ(run({"bench", "--frames", "1", "--warmup", "0"}, "true").exitCode, 1);

  EXPECT_EQ(run({"render", "--out", out("n.png"), "--stats", out("n.json")}, "false").exitCode, 0);
  EXPECT_FALSE(readJson(out("n.json"))["totals"].contains("non_finite"));
}

// Otherwise a scene that stands still would measure nothing.
TEST_F(CommandLine, BenchRendersEveryImageByDefault) {
  const std::string still = writeScene("still", wallScene);
  const auto bench = [&](const std::string& skips) {
    succeed({"bench", "--scene", still, "--size", "64x36", "--frames", "5", "--warmup", "1", "--json", out("b.json"),
             skips});
    return readJson(out("b.json"));
  };
  const auto mirrorPasses = [](const nlohmann::json& json) {
    int passes = 0;
    for (const auto& pass : json["passes"]) {
      EXPECT_FALSE(pass.contains("frames")) << pass["name"] << " did not run in every frame";
      passes += pass["depth"].is_null() ? 0 : 1;
    }
    return passes;
  };
  EXPECT_EQ(mirrorPasses(bench("--set=reflection.skip_unchanged=true")), 0);
  const nlohmann::json json = bench("--validation");
  EXPECT_GT(mirrorPasses(json), 0);
  EXPECT_EQ(json["frames"], 5);
  for (const char* key : {"cpu_ms", "gpu_ms", "frame_ms", "interval_ms"}) {
    const nlohmann::json& total = json["totals"][key];
    EXPECT_LE(total["min"], total["median"]) << key;
    EXPECT_LE(total["median"], total["p95"]) << key;
    EXPECT_LE(total["p95"], total["max"]) << key;
    EXPECT_GT(total["min"], 0.0) << key;
  }
  EXPECT_TRUE(json["passes"][0]["gpu_ms"].contains("median"));
}

TEST_F(CommandLine, SequenceWritesEveryPictureAndTimeMoves) {
  render("%03d.png", {"--frames", "3", "--fps", "2", "--time", "1"});
  const Image8 single = rendered({"--time", "1.5"});
  EXPECT_EQ(readImage8(out("001.png")).rgba, single.rgba);
  EXPECT_NE(readImage8(out("000.png")).rgba, single.rgba);
  EXPECT_TRUE(fs::exists(out("002.png")));
  EXPECT_FALSE(fs::exists(out("003.png")));
}

TEST_F(CommandLine, ExrHoldsThePicturesRadiance) {
  render("a.exr");
  EXPECT_LE(difference(toDisplay(readExr(out("a.exr"))), rendered({}), 1).largest, 1);
}

TEST_F(CommandLine, CompareDistinguishesPictures) {
  Image8 image(64, 36);
  std::ranges::fill(image.rgba, uint8_t{200});
  writePng(out("a.png"), image);
  std::fill(image.at(9, 9), image.at(60, 20), uint8_t{40});
  writePng(out("b.png"), image);
  writePng(out("small.png"), Image8(32, 18));
  succeed({"compare", out("a.png"), out("a.png"), "--max-diff", "0", "--max-flip", "0"});
  Image8 black(64, 36);
  std::ranges::fill(black.rgba, uint8_t{0});
  writePng(out("black.png"), black);
  EXPECT_TRUE(contains(mistake({"compare", out("a.png"), out("a.png"), "--mask", out("black.png")}),
                       "black.png: the mask leaves out every pixel"));
  const ProcessResult differ = speculum({"compare", out("a.png"), out("b.png"), "--max-diff", "2", "--json",
                                         out("c.json"), "--heatmap", out("h.png"), "--mask", out("a.png")});
  EXPECT_EQ(differ.exitCode, 1) << differ.output;
  const nlohmann::json json = readJson(out("c.json"));
  for (const char* key : {"rmse", "relative_rmse", "psnr", "ssim", "flip", "max_diff", "p99_diff", "pixels_over"}) {
    EXPECT_TRUE(json[key].is_number()) << key;
  }
  EXPECT_GT(json["pixels_over"], 0);
  EXPECT_TRUE(fs::exists(out("h.png")));
  std::fill(black.at(0, 0), black.at(0, 9), uint8_t{255});
  writePng(out("above.png"), black);
  succeed({"compare", out("a.png"), out("b.png"), "--max-diff", "0", "--mask", out("above.png")});
  EXPECT_EQ(speculum({"compare", out("a.png"), out("small.png")}).exitCode, 2);
  EXPECT_EQ(speculum({"compare", out("a.png"), out("missing.png")}).exitCode, 2);
}

TEST_F(CommandLine, CameraReplacesTheScenes) {
  const Image8 own = rendered({});
  EXPECT_EQ(rendered({"--camera", "0,1,4:0,1,0"}).rgba, own.rgba);
  EXPECT_EQ(rendered({"--camera", "0,1,4:0,1,0:0,2,0"}).rgba, own.rgba);
  const Image8 other = rendered({"--camera", "1,2,4:0,1,0"});
  EXPECT_NE(other.rgba, own.rgba);
  succeed({"reference", "--scene", scene_, "--size", "64x36", "--samples", "1", "--camera", "1,2,4:0,1,0", "--out",
           out("traced.png")});
  expectAlike(other, readImage8(out("traced.png")), 2, "command_line_camera");
}

// A setting is named if, and only if, the tracer draws the same picture with any of its values.
TEST_F(CommandLine, ReferenceNamesSettingsItDoesNotRead) {
  const auto traced = [&](const std::string& setting, const std::string& name) {
    return succeed(
        {"reference", "--scene", scene_, "--size", "16x9", "--samples", "1", "--out", out(name), "--set", setting});
  };
  EXPECT_EQ(traced("view.exposure=1", "usual.png"), "");
  for (const auto& [setting, read] :
       {std::pair("effects.shadows=false", false), std::pair("reflection.scale=0.5", false),
        std::pair("view.samples=1", false), std::pair("view.exposure=3", true), std::pair("view.tone_map=aces", true),
        std::pair("view.clear_color=1,0,0", true), std::pair("reflection.max_depth=0", true)}) {
    const std::string key = std::string(setting).substr(0, std::string_view(setting).find('='));
    EXPECT_EQ(contains(traced(setting, "other.png"), "reference does not read " + key + " (only "), !read);
    EXPECT_EQ(readText(out("other.png")) != readText(out("usual.png")), read) << setting;
  }
}

TEST_F(CommandLine, BudgetOfASceneNamesTheOption) {
  const std::string scene =
      writeScene("budget", replaced(smallScene(), "[settings]", "[settings] \"quality.budget_ms\" = 5,"));
  const std::string warning = succeed({"render", "--scene", scene, "--size", "8x8", "--out", out("b.png")});
  EXPECT_TRUE(contains(warning, "GPU budget waits for a measurement (render and bench take --sweep-results F"));
}

TEST_F(CommandLine, BookmarkIsACamera) {
  const auto drawn = [&](const std::string& camera) { return rendered({"--camera", camera}).rgba; };
  EXPECT_EQ(drawn("aside"), drawn("1,2,4:0,1,0"));
  EXPECT_NE(drawn("near, with a wide view"), drawn("0,1,2:0,1,0"));
  EXPECT_EQ(mistake({"render", "--scene", scene_, "--camera", "asid", "--out", out("b.png")}),
            "--camera: the scene has no bookmark 'asid' (did you mean 'aside'?)\n");
  EXPECT_TRUE(contains(mistake({"render", "--scene", scene_, "--camera", "1st floor, hall", "--out", out("b.png")}),
                       "the scene has no bookmark '1st floor, hall'"));
}

TEST_F(CommandLine, TextOfSixteenBitsIsNamed) {
  replaceFile(out("utf16.toml"), std::string_view("\xff\xfe[\0c\0", 6));
  EXPECT_TRUE(contains(mistake({"render", "--scene", out("utf16.toml"), "--out", out("b.png")}), "is UTF-16 text"));
}

TEST_F(CommandLine, ShippedScenesAreFoundFromAnyDirectory) {
  for (const char* name : {"hard/corner", "hard/corner.toml", "scenes/hard/corner.toml"}) {
    const std::string command = "cd / && exec '" + program + "' reference --scene " + name +
                                " --size 8x8 --samples 1 --out '" + out("n.png") + "'";
    const ProcessResult result = runProcess({"bash", "-c", command});
    EXPECT_EQ(result.exitCode, 0) << result.output;
  }
}

TEST_F(CommandLine, BenchListsTheCostOfEffects) {
  const std::string scene =
      writeScene("effects", smallScene() +
                                "[[mirror]]\nname = 'rough'\nposition = [1, 1, -1]\nsize = [1, 1]\nroughness = 0.2\n"
                                "[[mirror]]\nname = 'glass'\nposition = [-1, 1, -1]\nsize = [1, 1]\n"
                                "fresnel = 'schlick'\n"
                                "[[object]]\nname = 'floor'\nmodel = 'MODELS/chequer.obj'\n");
  const std::string output = succeed({"bench", "--scene", scene, "--size", "32x18", "--frames", "2", "--warmup", "0",
                                      "--prices", "--set=view.samples=4", "--json", out("e.json")});
  EXPECT_TRUE(contains(output, "roughness"));
  const auto stats = readJson(out("e.json"));
  std::map<std::string, std::string> called;
  for (const auto& effect : stats["effects"]) {
    if (effect["called_for"]) {
      called[effect["name"].get<std::string>()] = effect["why"].get<std::string>();
      EXPECT_TRUE(effect["gpu_ms"].contains("median")) << effect;
    } else {
      EXPECT_TRUE(effect["gpu_ms"].is_null()) << effect;
    }
  }
  const std::map<std::string, std::string> expected = {{"roughness", "mirror 'rough'"},
                                                       {"fresnel", "mirror 'glass'"},
                                                       {"textures", "object 'floor' with chequer.obj"},
                                                       {"glyphs", "light 0"},
                                                       {"msaa", "view.samples = 4"}};
  EXPECT_EQ(called, expected);
}

}  // namespace
}  // namespace speculum
