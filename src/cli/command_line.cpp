#include "cli/commands.hpp"

#include <spdlog/fmt/fmt.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "platform/files.hpp"
#include "scene/input_error.hpp"
#include "scene/model_files.hpp"
#include "scene/scene_loader.hpp"
#include "scene/value_range.hpp"
#include "session/output_files.hpp"
#include "session/version.hpp"
#include "settings/setting_fields.hpp"

namespace speculum {

namespace {

// Arguments as text. They are checked after parsing, where messages can say what would be right.
struct Raw {
  std::string size;
  std::string camera;
  std::vector<std::string> settings;
  std::string renderPath = "auto";
  std::string presentMode = "fifo";
};

// Checks that a text names something; `what` says what it may name.
auto named(const std::string& what) {
  return [what](const std::string& text) { return text.empty() ? "an empty name, not " + what : std::string(); };
}

void addCommon(CLI::App& app, Options& options, Raw& raw) {
  app.add_option("--set", raw.settings, "key=value; any setting, repeatable")->take_all()->allow_extra_args(false);
  app.add_option("--gpu", options.gpu, "index or part of the name, see `speculum info`")
      ->check(named("an index or part of a GPU's name"));
  app.add_option("--render-path", raw.renderPath, "auto | dynamic | renderpass");
  app.add_flag("--validation", options.validation, "validation layer with synchronisation validation");
  app.add_option("--log-level", options.logLevel, "trace | debug | info | warn | error | off")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}));
  app.add_option("--shader-dir", options.shaderDir, "GLSL to compile, and again whenever it changes")
      ->check(CLI::ExistingDirectory);
}

void addScene(CLI::App& app, Options& options, Raw& raw, const std::string& usualSize = "1280x720") {
  app.add_option("--scene", options.scene,
                 "scene file, model (" + modelFormatNames() + "), or the name of a scene of `speculum scenes`")
      ->check(named("a file or a scene's name"));
  app.add_option("--size", raw.size, "WIDTHxHEIGHT in pixels, " + usualSize + " unless given");
}

void addSweepResults(CLI::App& app, Options& options) {
  app.add_option("--sweep-results", options.sweepResults,
                 "results.json of `speculum accuracy`: what quality.budget_ms and quality.max_error choose from");
}

void addDemo(CLI::App& app, Options& options, Raw& raw) {
  addScene(app, options, raw);
  app.add_option("--frames", options.frames, "end after so many frames")->check(CLI::Range(1, 1000000000));
  addSweepResults(app, options);
  app.add_option("--present-mode", raw.presentMode, "fifo | mailbox | immediate")
      ->check(CLI::IsMember({"fifo", "mailbox", "immediate"}));
  app.add_option("--platform", options.window.platform, "x11 | wayland; GLFW before 3.4 is installed for one of them")
      ->check(CLI::IsMember({"x11", "wayland"}));
}

void addTime(CLI::App& app, Options& options) {
  app.add_option("--time", options.time, "seconds of animation")->check(CLI::Number);
}

void addView(CLI::App& app, Options& options, Raw& raw) {
  addScene(app, options, raw);
  addTime(app, options);
  app.add_option("--camera", raw.camera,
                 "X,Y,Z:X,Y,Z[:X,Y,Z[:DEG]]: position, target, up and vertical field of view in the place of the "
                 "scene's; or a bookmark of the scene")
      ->check(named("a camera or a bookmark"));
}

void addStrict(CLI::App& app, Options& options) {
  app.add_flag("--strict", options.strict, "warnings about models and their files are errors");
}

void addRender(CLI::App& app, Options& options, Raw& raw) {
  addView(app, options, raw);
  addStrict(app, options);
  app.add_option("--out", options.out, "F.png, F.exr, or a pattern such as dir/%04d.png with --frames")->required();
  addSweepResults(app, options);
  app.add_option("--stats", options.render.stats,
                 "JSON: passes, skipped mirrors, effects, totals; - is standard output");
  app.add_option("--capture", options.render.capture, "F.rdc: the first picture for RenderDoc, which must be loaded");
  CLI::Option* frames = app.add_option("--frames", options.frames, "a sequence of so many pictures");
  frames->check(CLI::Range(1, 1000000));
  app.add_option("--fps", options.fps, "pictures per second of animation")->check(CLI::Range(1e-6, 1e6))->needs(frames);
}

void addReference(CLI::App& app, Options& options, Raw& raw) {
  addView(app, options, raw);
  addStrict(app, options);
  app.add_option("--out", options.out, "F.png or F.exr")->required();
  app.add_option("--samples", options.referenceSamples, "rays a pixel, a square number")->check(CLI::Range(1, 65536));
}

void addBench(CLI::App& app, Options& options, Raw& raw) {
  addView(app, options, raw);
  app.add_option("--frames", options.frames, "measured frames")->check(CLI::Range(1, 1000000));
  app.add_option("--warmup", options.bench.warmup, "frames before")->check(CLI::Range(0, 1000000));
  app.add_option("--json", options.json, "write the figures to F; - is standard output");
  addSweepResults(app, options);
  app.add_flag("--prices", options.bench.prices, "GPU ms of each effect as well, by leaving it out in turn");
  app.add_flag("--reference", options.bench.tracer, "the ray tracer instead: rays per second and core");
}

void addAccuracy(CLI::App& app, Options& options, Raw& raw) {
  addScene(app, options, raw, "640x360");
  addTime(app, options);
  app.add_option("--out", options.out, "folder of the report; a sweep that was interrupted goes on there")->required();
  app.add_option("--sweep", options.sweep, "quick | full | F.toml; with --motion also motion, its default")
      ->check(named("quick, full or a file"));
  CLI::Option* motion = app.add_option(
      "--motion", options.motion,
      "error and flicker of a movement: scene, for its animation, or F.toml, a camera path (docs/accuracy.md)");
  motion->check(named("scene or a file"));
  app.add_option("--frames", options.frames, "frames of the movement, 24 unless given")
      ->check(CLI::Range(2, 1000))
      ->needs(motion);
  app.add_option("--fps", options.fps, "frames per second of the movement, 30 unless given")
      ->check(CLI::Range(1e-6, 1e6))
      ->needs(motion);
}

void addCompare(CLI::App& app, Options& options) {
  app.add_option("reference", options.compare.reference, "PNG or EXR")->required();
  app.add_option("test", options.compare.test, "PNG or EXR of the same size")->required();
  app.add_option("--mask", options.compare.mask,
                 "PNG; figures again for its pixels of at least 128, which alone the limits then judge");
  app.add_option("--heatmap", options.compare.heatmap, "PNG of the FLIP error");
  app.add_option("--json", options.json, "write the figures to F; - is standard output");
  app.add_option("--max-flip", options.compare.maxFlip, "exit 1 above this mean FLIP")->check(CLI::Range(0.0, 1e6));
  app.add_option("--max-diff", options.compare.maxDiff, "exit 1 if a channel differs by more than N/255")
      ->check(CLI::Range(0, 1'000'000));
}

void addRegress(CLI::App& app, Options& options) {
  app.add_option("cases", options.regress.cases, "TOML: scenes, times, cameras, settings, tolerances");
  app.add_option("--out", options.out, "folder of the report, regress-report unless given");
  app.add_option("--filter", options.regress.filter, "only cases with a name like this, such as 'gallery*'");
  app.add_option("--jobs", options.regress.jobs, "worker processes, up to 4 by the processor unless given")
      ->check(CLI::Range(1, 256));
  app.add_option_function<std::vector<std::string>>(
         "--update",
         [&](const std::vector<std::string>& glob) {
           options.regress.update = glob.empty() || glob.front().empty() ? "*" : glob.front();
         },
         "take over the pictures of failed cases, all or those with a name like this")
      ->expected(0, 1)
      ->allow_extra_args(false)  // else `--update GLOB cases.toml` takes both
      ->type_name("[GLOB]");
  addStrict(app, options);
  app.add_option("--junit", options.regress.junit, "write the results to F as JUnit XML; - is standard output");
  app.add_option("--repeat", options.regress.repeat, "draw each case so often; the pictures must be equal")
      ->check(CLI::Range(1, 1000000));
  app.add_flag("--worker", options.regress.worker)->group("");
}

// Refuses what `bench --reference` would not look at.
void requireTracerAlone(const CLI::App& bench) {
  for (const char* option :
       {"--scene", "--size", "--time", "--camera", "--frames", "--warmup", "--sweep-results", "--prices"}) {
    if (bench.count(option) > 0) {
      throw UsageError(fmt::format("--reference: measures alone (leave out {})", option));
    }
  }
}

// Gives back the file of cases that --update took for its GLOB: `regress --update cases.toml`.
void takeCases(RegressArguments& regress) {
  if (!regress.cases.empty()) {
    return;
  }
  const std::string taken = regress.update.value_or("*");
  if (taken == "*" || !isFile(taken)) {
    throw UsageError("cases is required" + (taken == "*" ? "" : ", and '" + taken + "' is no file") +
                     " (see speculum regress --help)");
  }
  regress.cases = taken;
  regress.update = "*";
}

std::vector<std::pair<std::string, std::string>> parseSettings(const std::string& option,
                                                               const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, std::string>> settings;
  Settings scratch;
  for (const std::string& text : texts) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos) {
      throw UsageError(option + ": '" + text + "' has no value (key=value)");
    }
    settings.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    if (const auto problem = setSetting(scratch, settings.back().first, settings.back().second)) {
      throw UsageError(option + ": " + *problem);
    }
  }
  return settings;
}

void applyRaw(const Raw& raw, Options& options) {
  if (!raw.size.empty()) {
    const std::optional<PictureSize> size = pictureSize(raw.size);
    if (!size) {
      throw UsageError("--size: '" + raw.size + "' is not a size (" + std::string(pictureSizes) + ")");
    }
    options.size = *size;
  } else if (options.command == "accuracy") {
    options.size = {640, 360};
  }
  if (options.sweep.empty()) {
    options.sweep = options.motion.empty() ? "quick" : "motion";
  }
  if (!raw.camera.empty()) {
    setCamera(options, raw.camera);
  }
  if (!timeRange.contains(options.time)) {
    throw UsageError(fmt::format("--time: {} is out of range ({} seconds of animation, such as 2.5)", options.time,
                                 timeRange.shortText()));
  }
  // Finds NaN, which passes range checks because no comparison with it holds.
  if (!std::isfinite(options.fps)) {
    throw UsageError("--fps: not a finite number (pictures per second, such as 30)");
  }
  if (options.compare.maxFlip && !std::isfinite(*options.compare.maxFlip)) {
    throw UsageError("--max-flip: not a finite number (a mean FLIP, such as 0.05)");
  }
  options.settings = parseSettings("--set", raw.settings);
  const std::optional<RenderPath> path = renderPathFromName(raw.renderPath);
  if (!path) {
    throw UsageError("--render-path: '" + raw.renderPath + "' is not a choice (auto | dynamic | renderpass)");
  }
  options.renderPath = *path;
  for (const PresentMode mode : {PresentMode::fifo, PresentMode::mailbox, PresentMode::immediate}) {
    options.window.presentMode = presentModeName(mode) == raw.presentMode ? mode : options.window.presentMode;
  }
}

std::string settingsText() {
  std::string text = "Settings (--set key=value):\n";
  for (const SettingField& field : settingFields()) {
    text += fmt::format("  {:<29} {} ({})\n", field.key, field.text, settingRangeWithUnit(field));
  }
  return text;
}

bool isOption(const std::string& argument) {
  return argument.size() > 1 && argument.front() == '-';
}

// Lists option names in the order of the help.
std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      names.push_back("--" + name);
    }
  }
  return names;
}

std::vector<std::string> commandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::string advice(const std::string& argument, const std::vector<std::string>& known,
                   std::string_view otherwise = {}) {
  return nearestKeyAdvice(argument, std::vector<std::string_view>(known.begin(), known.end()), otherwise);
}

// Returns the end of a command's --help: examples of useful calls, a line each.
std::string examplesText(const std::string& command) {
  static const std::map<std::string, std::vector<std::string>> examples = {
      {"demo",
       {"--scene mirror_maze", "--scene gallery --set reflection.max_depth=8 --size 1920x1080",
        "--scene yours.toml --shader-dir shaders"}},
      {"render",
       {"--scene gallery --size 1920x1080 --time 3 --out gallery.png --stats gallery.json",
        "--scene outdoors --frames 120 --fps 30 --out 'frames/%04d.png'",
        "--scene gallery --camera 0,1.5,3:0,1,0 --set view.samples=8 --out radiance.exr"}},
      {"reference", {"--scene gallery --size 640x360 --samples 64 --out truth.png"}},
      {"compare",
       {"truth.png gallery.png", "truth.png gallery.png --heatmap error.png --json error.json --max-flip 0.05"}},
      {"accuracy",
       {"--scene gallery --out report", "--scene gallery --size 320x180 --sweep full --out report",
        "--scene gallery --size 320x180 --motion scene --out report"}},
      {"regress",
       {"cases.toml --out report", "cases.toml --filter 'gallery*' --jobs 2 --junit report/junit.xml",
        "cases.toml --update gallery", "cases.toml --repeat 10"}},
      {"bench",
       {"--scene many_mirrors --set reflection.max_depth=2 --frames 200 --json bench.json", "--scene gallery --prices",
        "--reference"}},
      {"info", {""}},
      {"scenes", {""}},
  };
  std::string text =
      command != "regress"
          ? ""
          : "CASES holds at least two lines, [[case]] and scene = \"room.toml\"; docs/regression.md lists all keys.\n"
            "The first run needs --update, which writes the expected picture.\n\n";
  text += "Examples:\n";
  for (const std::string& arguments : examples.at(command)) {
    text += "  speculum " + command + (arguments.empty() ? "" : " ") + arguments + "\n";
  }
  return text;
}

// Returns one line about unknown arguments and what was probably meant. `app` has failed to parse; empty if it left no
// argument over.
std::string unknownArgument(const CLI::App& app) {
  const std::vector<std::string> left = app.remaining(true);
  if (left.empty()) {
    return {};
  }
  const bool commanded = !app.get_subcommands().empty();
  const CLI::App& used = commanded ? *app.get_subcommands().front() : app;
  const std::vector<std::string> scenes = shippedSceneNames();
  if (!commanded && std::ranges::count(scenes, left.front()) > 0) {
    return "'" + left.front() + "' is not expected there (did you mean '--scene " + left.front() + "'?)";
  }
  // Takes the first word for a misspelt command, and the following ones for its arguments.
  if (!commanded && !isOption(left.front())) {
    return "'" + left.front() + "' is not a command (" +
           advice(left.front(), scenes, advice(left.front(), commandNames(app))) + ")";
  }
  const auto option = std::ranges::find_if(left, isOption);
  const std::string name = option == left.end() ? left.front() : option->substr(0, option->find('='));
  const std::string help = commanded ? "speculum " + used.get_name() + " --help" : "speculum --help";
  std::error_code tooLong;
  const bool isThere = shippedScene(name) || std::filesystem::exists(name, tooLong);
  if (option == left.end() && used.get_name() == "demo" && !isThere) {
    return "'" + name + "' is neither a scene nor a file (" + advice(name, scenes, "speculum scenes lists scenes") +
           ")";
  }
  const bool takesScene = used.get_option_no_throw("--scene") != nullptr;
  if (option == left.end() && takesScene && isThere) {
    return "'" + name + "' is not expected of " + used.get_name() + " (did you mean '--scene " + name + "'?)";
  }
  return "'" + name + "' is not " + (option == left.end() ? "expected" : "an option") + " of " +
         (commanded ? used.get_name() : "speculum") + " (" + advice(name, optionNames(used), "see " + help) + ")";
}

// Returns CLI11's message on one line, in words of its users.
std::string clearMessage(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  const size_t colon = std::min(text.find(": "), text.size());
  const std::string option = text.substr(0, colon);
  const std::string_view problem = std::string_view(text).substr(std::min(colon + 2, text.size()));
  constexpr std::string_view unreadable = "Failed parsing ";
  if (problem.starts_with("At Most 1 required but received")) {
    return option + ": is given more than once";
  }
  if (problem.starts_with("1 required ") && problem.ends_with(" missing")) {
    return option + ": needs a value";
  }
  if (problem.starts_with(unreadable)) {
    const std::string_view rest = problem.substr(unreadable.size());
    return fmt::format("{}: '{}' is not a number", option, rest.substr(0, rest.rfind(" as a")));
  }
  return text;
}

// Returns the arguments with --scene before a scene or model that stands alone: `speculum FILE`, `speculum demo FILE`.
// A shipped scene may be given by its name.
std::vector<const char*> withSceneOption(int argc, const char* const* argv) {
  std::vector<const char*> arguments(argv, argv + argc);
  const size_t place = argc > 1 && argv[1] == std::string_view("demo") ? 2 : 1;
  if (place < arguments.size()) {
    const std::filesystem::path file = arguments[place];
    const std::optional<std::filesystem::path> shipped = shippedScene(file);
    if (file.extension() == ".toml" || isModelFile(file) || (shipped && shipped->extension() == ".toml")) {
      arguments.insert(arguments.begin() + static_cast<std::ptrdiff_t>(place), "--scene");
    }
  }
  return arguments;
}

}  // namespace

void setCamera(Options& options, const std::string& text) {
  options.camera.reset();
  options.bookmark.clear();
  if (!meansPoints(text)) {
    options.bookmark = text;
    return;
  }
  try {
    options.camera = parseCamera(text);
  } catch (const std::invalid_argument& error) {
    throw UsageError("--camera: " + std::string(error.what()));
  }
}

std::optional<Options> parseOptions(int argc, const char* const* argv) {
  const std::vector<const char*> arguments = withSceneOption(argc, argv);
  Options options;
  Raw raw;
  CLI::App app("Speculum: planar mirrors in Vulkan that can be trusted", "speculum");
  app.allow_windows_style_options(false);  // /home/me/scene.toml is a path
  app.set_version_flag("--version", std::string("speculum ") + versionString);
  app.require_subcommand(0, 1);
  addDemo(app, options, raw);
  addCommon(app, options, raw);
  const auto command = [&](const std::string& name, const std::string& help) {
    CLI::App* sub = app.add_subcommand(name, help);
    addCommon(*sub, options, raw);
    sub->footer(examplesText(name));
    return sub;
  };
  addDemo(*command("demo", "open the window (the default)"), options, raw);
  addRender(*command("render", "draw a picture or a sequence without a window"), options, raw);
  addReference(*command("reference", "trace the picture in double precision"), options, raw);
  addCompare(*command("compare", "error figures of a picture against a reference"), options);
  addAccuracy(*command("accuracy", "error and time of many settings, as a report"), options, raw);
  addRegress(*command("regress", "draw cases and compare them with expected pictures"), options);
  addBench(*command("bench", "measure frames"), options, raw);
  command("info", "GPUs, drivers, features");
  command("scenes", "scenes that come with the program");
  app.footer(
      "`speculum FILE` opens a scene or model in the window, `speculum NAME` a scene that comes with the program.\n\n" +
      settingsText() + "\n" + examplesText("demo") + examplesText("render").substr(std::string("Examples:\n").size()));
  try {
    app.parse(static_cast<int>(arguments.size()), arguments.data());
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      app.exit(error);
      return std::nullopt;
    }
    const std::string unknown = unknownArgument(app);
    const std::string chosen = app.get_subcommands().empty() ? "" : app.get_subcommands().front()->get_name() + " ";
    throw UsageError(unknown.empty() ? fmt::format("{} (see speculum {}--help)", clearMessage(error.what()), chosen)
                                     : clearMessage(unknown));
  }
  if (!app.get_subcommands().empty()) {
    options.command = app.get_subcommands().front()->get_name();
  }
  applyRaw(raw, options);
  if (options.bench.tracer) {
    requireTracerAlone(*app.get_subcommand("bench"));
  }
  if (options.command == "regress") {
    takeCases(options.regress);
    options.out = options.out.empty() ? "regress-report" : options.out;
  }
  requireFilesOfTheirOwn(options);
  options.arguments.assign(arguments.begin() + 1, arguments.end());
  return options;
}

}  // namespace speculum
