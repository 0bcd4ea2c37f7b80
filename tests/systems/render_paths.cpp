// Dynamic rendering and VkRenderPass give the same bytes for golden pictures. Reused images are compared beside
// their own tests.
#include "cli/case_drawer.hpp"
#include "plan/reuse_support.hpp"
#include "sampling.hpp"

namespace speculum {
namespace {

using namespace testing_support;

using Cases = std::map<std::string, std::vector<RegressCase>>;

// Golden cases by scene. In the short suite: the main view alone, mirrors side by side with textures, mirrors in
// mirrors, all effects at once, environment maps, and rough mirrors that look up images.
Cases goldenCases() {
  static const std::set<std::string> sampled{"no_mirror", "gallery",     "facing_mirrors",
                                             "effects",   "mirror_ball", "rough"};
  Cases cases;
  for (const RegressCase& golden : readCases(sourceFile("tests/golden/cases.toml"))) {
    const std::string scene = golden.scene.stem();
    if (fullTests() || sampled.contains(scene)) {
      cases[scene].push_back(golden);
    }
  }
  return cases;
}

class RenderPaths : public testing::TestWithParam<Cases::value_type> {};

TEST_P(RenderPaths, GiveTheSameBytes) {
  const std::vector<RegressCase>& cases = GetParam().second;
  for (const RegressCase& golden : std::span(cases).first(fullTests() ? cases.size() : 1)) {
    SCOPED_TRACE(golden.name);
    Options options = caseOptions(golden, headless(golden.scene));
    options.size = fullTests() ? golden.size : PictureSize{64, 36};
    expectSameOnBothPaths(options, {golden.time});
  }
}

INSTANTIATE_TEST_SUITE_P(Golden, RenderPaths, testing::ValuesIn(goldenCases()),
                         [](const auto& info) { return info.param.first; });

}  // namespace
}  // namespace speculum
