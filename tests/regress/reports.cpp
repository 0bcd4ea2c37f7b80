// Reports of `regress`: JUnit, GitHub, and the size of the page. tests/accuracy/report_page.py opens the page.
#include "image/picture_files.hpp"
#include "regress/picture_check.hpp"
#include "regress/report_page.hpp"
#include "temporary_folder.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

RegressRun exampleRun() {
  RegressRun run{.file = "tests/cases.toml", .version = "1"};
  const auto add = [&](const std::string& name, Outcome outcome) {
    run.cases.push_back({.name = name, .line = 10 * static_cast<int>(run.cases.size() + 1), .size = {64, 36}});
    run.outcomes.push_back(std::move(outcome));
  };
  add("fine", {.seconds = 0.5});
  add("wrong", {.verdict = Verdict::failed,
                .message = "50 % differ, \"a\" < 1 & | more",
                .replaceable = true,
                .figures = {{"pixels over 3/255", "50 %", "0.1 %", true}}});
  add("gone", {.verdict = Verdict::error, .message = "ended by signal 11", .log = {"last\x01 words"}});
  add("left out", {.verdict = Verdict::skipped, .message = "no such driver"});
  return run;
}

TEST(Reports, SummaryCountsEachVerdict) {
  EXPECT_EQ(summary(exampleRun()), "4 cases: 1 passed, 1 failed, 1 error, 1 skipped");
  EXPECT_FALSE(exampleRun().passed());
}

TEST(Reports, JUnitIsXml) {
  const std::string xml = junitXml(exampleRun());
  EXPECT_TRUE(contains(xml, "tests=\"4\" failures=\"1\" errors=\"1\" skipped=\"1\" time=\"0.5"));
  EXPECT_TRUE(
      contains(xml,
               "<failure message=\"50 % differ, &quot;a&quot; &lt; 1 &amp; | more\">pixels over 3/255: 50 % (limit "
               "0.1 %)\n</failure>"));
  EXPECT_TRUE(contains(xml, "<error message=\"ended by signal 11\">last\\x01 words"));
  EXPECT_TRUE(contains(xml, "name=\"left out\" time=\"0.000000\"><skipped message=\"no such driver\"/>"));
}

// Characters that XML 1.0 forbids, bytes that are no characters, and commands of runners, anywhere in a run.
TEST(Reports, ForeignTextStaysText) {
  const std::vector<std::string> pieces{"\n",
                                        "\r",
                                        "\x1b",
                                        "\x01",
                                        "\xef\xbf\xbe",
                                        "\xef\xbf\xbf",
                                        "\xed\xa0\x80",
                                        "\xff",
                                        "\xc2\x85",
                                        "\xe2\x80\xa8",
                                        "::error::x",
                                        "##[error]x",
                                        "::add-mask::",
                                        "a",
                                        "]]>",
                                        "<",
                                        "|",
                                        "&"};
  std::mt19937 random(1);
  const auto text = [&] {
    std::string made;
    for (size_t k = random() % 6; k > 0; --k) {
      made += pieces[random() % pieces.size()];
    }
    return made;
  };
  const auto linesThat = [](const std::string& lines, const auto& match) {
    std::istringstream stream(lines);
    int count = 0;
    for (std::string line; std::getline(stream, line);) {
      count += match(line) ? 1 : 0;
    }
    return count;
  };
  const auto isError = [](const std::string& line) {
    const bool absolute = line.starts_with("::error file=/") || line.substr(0, 17).ends_with("%3A");  // a drive
    return line.starts_with("::error file=") && absolute;
  };
  for (int i = 0; i < 500; ++i) {
    RegressRun run{.file = "cases" + text() + ".toml"};
    for (const Verdict verdict : {Verdict::failed, Verdict::error, Verdict::skipped}) {
      run.cases.push_back({.name = text()});
      run.outcomes.push_back(
          {.verdict = verdict, .message = text(), .figures = {{text(), text(), text()}}, .log = {text(), text()}});
    }
    const std::string xml = junitXml(run);
    EXPECT_NO_THROW(nlohmann::json(xml).dump()) << "not UTF-8";
    EXPECT_TRUE(std::ranges::none_of(xml, [](char c) { return c >= 0 && c < 0x20 && c != '\n'; }));
    EXPECT_FALSE(contains(xml, "\xef\xbf\xbe"));
    EXPECT_FALSE(contains(xml, "\xef\xbf\xbf"));
    const std::string errors = githubErrors(run);
    EXPECT_EQ(linesThat(errors, isError), 2);
    EXPECT_EQ(std::ranges::count(errors, '\n'), 2) << errors;
    const std::string table = githubSummary(run);
    EXPECT_EQ(linesThat(table, [](const std::string& line) { return line.starts_with("| "); }), 4) << table;
    EXPECT_EQ(std::ranges::count(table, '\n'), 7) << table;
    for (const std::string& report : {xml, errors, table.substr(table.find('\n'))}) {
      EXPECT_FALSE(contains(report, "##["));
      EXPECT_FALSE(contains(report, "\x1b"));
    }
  }
}

TEST(Reports, GithubGetsErrorsAndATable) {
  std::string path = std::filesystem::absolute("tests/cases.toml").make_preferred().string();
  for (size_t at = 0; (at = path.find(':', at)) != std::string::npos;) {
    path.replace(at, 1, "%3A");  // the colon of a drive
  }
  const std::string file = "::error file=" + path;
  EXPECT_EQ(githubErrors(exampleRun()), file + ",line=20,title=wrong::50 %25 differ, \"a\" < 1 & | more\n" + file +
                                            ",line=30,title=gone::ended by signal 11\n");
  EXPECT_TRUE(contains(githubSummary(exampleRun()), "| wrong | failed | 50 % differ, \"a\" \\< 1 & \\| more |\n"));
}

TEST(Reports, PageKeepsToItsBudget) {
  const TemporaryFolder folder;
  RegressRun run;
  Image8 noise(64, 36);
  std::mt19937 random(1);
  for (uint8_t& value : noise.rgba) {
    value = static_cast<uint8_t>(random());
  }
  for (int i = 0; i < 20; ++i) {
    const std::string name = "case" + std::to_string(i);
    run.cases.push_back({.name = name, .size = {64, 36}});
    run.outcomes.push_back({.verdict = i < 10 ? Verdict::failed : Verdict::passed, .hasFiles = true});
    for (const std::filesystem::path& file : CaseFiles(folder.path(), name).all()) {
      writePng(file, noise);
    }
  }
  const size_t bare = regressHtml(run, folder.path(), 0.0).size();
  EXPECT_EQ(occurrences(regressHtml(run, folder.path()), "data:image/png"), 40) << "none of cases that passed";
  for (const double budget : {1e5, 3e5, 5e5}) {
    EXPECT_LE(regressHtml(run, folder.path(), budget).size(), bare + static_cast<size_t>(budget));
  }
  EXPECT_GT(occurrences(regressHtml(run, folder.path(), 2e5), "data:image/jpeg"), 0);
}

}  // namespace
}  // namespace speculum
