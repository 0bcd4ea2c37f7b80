// scripts/speculum-completion.bash offers what the program takes, no more and no less.
#include "cli/commands.hpp"
#include "command_support.hpp"
#include "picture_support.hpp"
#include "settings/setting_fields.hpp"
#include "temporary_folder.hpp"

namespace speculum {
namespace {

using namespace testing_support;

using Words = std::set<std::string>;

Words words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

// Returns what bash offers for the last of the words.
Words completions(const std::vector<std::string>& line) {
  std::string quoted;
  for (const std::string& word : line) {
    quoted += " '" + word + "'";
  }
  const std::string script = "source '" + sourceFile("scripts/speculum-completion.bash").string() + "'\nCOMP_WORDS=(" +
                             quoted + ")\nCOMP_CWORD=" + std::to_string(line.size() - 1) +
                             "\n_speculum\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n";
  const ProcessResult result = runProcess({"bash", "-c", script});
  EXPECT_EQ(result.exitCode, 0) << result.output;
  return words(result.output);
}

// Returns the words at the start of a help text's lines, up to a comma, between the titles `from` and `to`.
Words listed(const std::string& help, const std::string& from, const std::string& to) {
  const size_t start = help.find(from);
  EXPECT_NE(start, std::string::npos) << help;
  std::istringstream lines(help.substr(start, help.find(to, start) - start));
  Words found;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    if (line.rfind("  ", 0) == 0 && line.size() > 2 && line[2] != ' ') {
      const std::string name = *words(line.substr(0, line.find(' ', 2))).begin();
      const size_t comma = name.find(",--");
      found.insert(comma == std::string::npos ? name : name.substr(comma + 1));
    }
  }
  return found;
}

Words commands() {
  return listed(speculum({"--help"}).output, "Subcommands:", "Settings (");
}

TEST(Completion, OffersTheCommands) {
  EXPECT_TRUE(commands().contains("render"));
  EXPECT_EQ(completions({program, ""}), commands());
  EXPECT_EQ(completions({program, "ren"}), Words{"render"});
}

TEST(Completion, OffersTheOptionsOfEachCommand) {
  EXPECT_EQ(completions({program, "--"}), listed(speculum({"--help"}).output, "Options:", "Subcommands:"));
  for (const std::string& command : commands()) {
    const std::string help = runProcess({program, command, "--help"}).output;
    EXPECT_EQ(completions({program, command, "--"}), listed(help, "Options:", "Examples:")) << command;
  }
  EXPECT_EQ(completions({program, "render", "--st"}), (Words{"--stats", "--strict"}));
}

TEST(Completion, OffersTheSettings) {
  Words settings;
  for (const SettingField& field : settingFields()) {
    settings.insert(std::string(field.key) + "=");
  }
  EXPECT_EQ(completions({program, "render", "--set", ""}), settings);
}

TEST(Completion, OffersTheScenesAndTheChoices) {
  const Words scenes = completions({program, "render", "--scene", "gal"});
  EXPECT_TRUE(scenes.contains("gallery")) << scenes.size();
  for (const char* option : {"--render-path", "--log-level"}) {
    const Words choices = completions({program, "info", option, ""});
    EXPECT_GE(choices.size(), 3u);
    for (const std::string& choice : choices) {
      EXPECT_NO_THROW(parseOptions(4, std::array{"speculum", "info", option, choice.c_str()}.data())) << choice;
    }
  }
}

TEST(Completion, OffersFilesWithTheirFolders) {
  const TemporaryFolder folder;
  for (const char* file : {"house.toml", "my_room.obj", "notes.txt", "sub/inner.glb"}) {
    folder.write(file, "");
  }
  std::filesystem::current_path(folder.path());
  EXPECT_EQ(completions({program, "hou"}), Words{"house.toml"});
  EXPECT_EQ(completions({program, "m"}), Words{"my_room.obj"});
  EXPECT_EQ(completions({program, "demo", "hou"}), Words{"house.toml"});
  EXPECT_EQ(completions({program, "notes"}), Words{});
  EXPECT_EQ(completions({program, "--scene", "su"}), Words{"sub"});
  EXPECT_EQ(completions({program, "--scene", "sub/"}), Words{"sub/inner.glb"});
  EXPECT_EQ(completions({program, "regress", "--update", "h"}), Words{"house.toml"});
  EXPECT_EQ(completions({program, "compare", "notes"}), Words{"notes.txt"});
  std::filesystem::current_path(sourceFile("."));
}

// bash then ends folders in a slash, and escapes blanks.
TEST(Completion, SaysThatFilesAreFiles) {
  const auto options = [](const std::string& line) {
    const std::string script = "source '" + sourceFile("scripts/speculum-completion.bash").string() +
                               "'\ncompopt() { echo \"$@\"; }\nCOMP_WORDS=('" + program + "' " + line +
                               ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_speculum";
    return runProcess({"bash", "-c", script}).output;
  };
  for (const char* line : {"hou", "--scene su", "render --out su", "compare a su", "regress su", "--shader-dir su",
                           "accuracy --sweep su", "accuracy --motion su"}) {
    EXPECT_EQ(options(line), "-o filenames\n") << line;
  }
  for (const char* line : {"render --size 8", "render --st", "--render-path a"}) {
    EXPECT_EQ(options(line), "") << line;
  }
}

TEST(Help, EndsWithExamplesThatParse) {
  std::filesystem::current_path(sourceFile("."));  // folder that relative paths start from
  for (const std::string& command : commands()) {
    const std::string help = runProcess({program, command, "--help"}).output;
    const size_t start = help.find("Examples:\n");
    ASSERT_NE(start, std::string::npos) << help;
    std::istringstream lines(help.substr(start + std::string("Examples:\n").size()));
    int count = 0;
    for (std::string line; std::getline(lines, line);) {
      std::erase(line, '\'');
      std::istringstream stream(line);
      const std::vector<std::string> arguments{std::istream_iterator<std::string>(stream), {}};
      if (arguments.empty()) {
        continue;
      }
      std::vector<const char*> argv;
      for (const std::string& argument : arguments) {
        argv.push_back(argument.c_str());
      }
      ASSERT_EQ(arguments[0], "speculum") << line;
      const std::optional<Options> options = parseOptions(static_cast<int>(argv.size()), argv.data());
      ASSERT_TRUE(options) << line;
      EXPECT_EQ(options->command, command) << line;
      if (!options->scene.empty() && options->scene != "yours.toml") {
        EXPECT_NO_THROW(findScene(options->scene)) << line;
      }
      ++count;
    }
    EXPECT_GE(count, 1) << command;
  }
}

// Output has no colors even on a terminal, so that NO_COLOR has nothing to switch off.
TEST(Output, HasNoColors) {
  for (const char* arguments : {"--help", "info", "--bogus", "render --scene no_mirror --size 8x8 --log-level trace"}) {
    const ProcessResult result =
        runProcess({"script", "-qec", program + " " + arguments + " --out x.jpg", "/dev/null"});
    EXPECT_FALSE(result.output.empty());
    EXPECT_FALSE(contains(result.output, "\x1b"));
  }
}

}  // namespace
}  // namespace speculum
