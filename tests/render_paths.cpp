// Dynamic rendering and VkRenderPass give the same bytes, for every golden picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>

#include "app/case_drawer.hpp"
#include "picture_support.hpp"
#include "sampling.hpp"

namespace speculum {
namespace {

using namespace testing_support;

std::vector<RegressCase> goldenCases() {
  std::vector<RegressCase> cases = readCases(sourceFile("tests/golden/cases.toml"));
  // Leaves out, for time, cases that share the picture of another.
  std::erase_if(cases, [](const RegressCase& golden) { return golden.picture.stem() != golden.name; });
  for (RegressCase& golden : cases) {
    if (!fullTests() && golden.size.width > 160) {
      golden.size = {160, 90};
    }
  }
  std::stable_sort(cases.begin(), cases.end(), [](const auto& a, const auto& b) { return a.scene < b.scene; });
  return cases;
}

// The session of the last scene on each path; the next case may be of the same scene.
std::map<RenderPath, std::unique_ptr<Session>> kept;

Image8 drawCase(const RegressCase& golden, RenderPath path) {
  Options options = caseOptions(golden, headless(golden.scene));
  options.renderPath = path;
  std::unique_ptr<Session>& session = kept[path];
  if (!session || session->scene().file != golden.scene) {
    session = std::make_unique<Session>(options);
  }
  Settings settings = settingsOf(session->scene());
  for (const auto& [key, value] : options.settings) {
    EXPECT_EQ(setSetting(settings, key, value), std::nullopt);
  }
  session->setSettings(settings);
  session->restart();
  session->draw(golden.time, true);
  Image8 picture = session->picture();
  expectQuiet(*session);
  return picture;
}

class RenderPaths : public testing::TestWithParam<RegressCase> {
 protected:
  static void TearDownTestSuite() { kept.clear(); }
};

TEST_P(RenderPaths, GiveTheSameBytes) {
  EXPECT_EQ(drawCase(GetParam(), RenderPath::renderPass).rgba, drawCase(GetParam(), RenderPath::dynamic).rgba);
}

INSTANTIATE_TEST_SUITE_P(Golden, RenderPaths, testing::ValuesIn(goldenCases()), [](const auto& info) {
  std::string name = info.param.name;
  std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0 && c != '_'; });
  return name;
});

}  // namespace
}  // namespace speculum
