#include "app/usage.hpp"

#include <CLI/CLI.hpp>
#include <map>

#include "scene/nearest_key.hpp"

namespace speculum {

namespace {

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

std::string advice(const std::string& argument, const std::vector<std::string>& known) {
  return nearestKeyAdvice(argument, std::vector<std::string_view>(known.begin(), known.end()));
}

}  // namespace

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
      {"accuracy", {"--scene gallery --out report", "--scene gallery --size 320x180 --sweep full --out report"}},
      {"regress",
       {"cases.toml --out report", "cases.toml --filter 'gallery*' --jobs 2 --junit report/junit.xml",
        "cases.toml --update gallery", "cases.toml --repeat 10"}},
      {"bench",
       {"--scene many_mirrors --set reflection.max_depth=2 --frames 200 --json bench.json", "--scene gallery --prices",
        "--scene gallery --against-set view.samples=1", "--reference"}},
      {"info", {""}},
      {"scenes", {""}},
  };
  std::string text = "Examples:\n";
  for (const std::string& arguments : examples.at(command)) {
    text += "  speculum " + command + (arguments.empty() ? "" : " ") + arguments + "\n";
  }
  return text;
}

std::string unknownArgument(const CLI::App& app) {
  const std::vector<std::string> left = app.remaining(true);
  if (left.empty()) {
    return {};
  }
  const bool commanded = !app.get_subcommands().empty();
  const CLI::App& used = commanded ? *app.get_subcommands().front() : app;
  // Takes the first word for a misspelt command, and the following ones for its arguments.
  if (!commanded && !isOption(left.front())) {
    return "'" + left.front() + "' is not a command (" + advice(left.front(), commandNames(app)) + ")";
  }
  const auto option = std::ranges::find_if(left, isOption);
  const std::string name = option == left.end() ? left.front() : option->substr(0, option->find('='));
  const std::string help = commanded ? "speculum " + used.get_name() + " --help" : "speculum --help";
  const std::string meant = advice(name, optionNames(used));
  return "'" + name + "' is not " + (option == left.end() ? "expected" : "an option") + " of " +
         (commanded ? used.get_name() : "speculum") + " (" +
         (meant.rfind("did you mean", 0) == 0 ? meant : "see " + help) + ")";
}

}  // namespace speculum
