// Reports of `regress`: JUnit, GitHub, and the size of the page. tests/report_page.py opens the page.
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
  EXPECT_TRUE(contains(xml, "<error message=\"ended by signal 11\">last? words"));
  EXPECT_TRUE(contains(xml, "name=\"left out\" time=\"0.000000\"><skipped message=\"no such driver\"/>"));
}

TEST(Reports, GithubGetsErrorsAndATable) {
  const std::string file = "::error file=" + (std::filesystem::current_path() / "tests/cases.toml").string();
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
