// Lessons: the files that ship, as both halves show them, and files that are refused.
#include "accuracy/ground_truth.hpp"
#include "picture_support.hpp"
#include "platform/files.hpp"
#include "sampling.hpp"
#include "session/lesson.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;

int lessonFiles() {
  return static_cast<int>(std::distance(std::filesystem::directory_iterator(sourceFile("lessons")), {}));
}

// Returns the number of pixels that differ in a part of the width.
int differing(const std::array<Image8, 2>& pictures, double from, double to) {
  const Image8& a = pictures[0];
  int count = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = static_cast<int>(from * a.width); x < static_cast<int>(to * a.width); ++x) {
      const uint8_t* code = a.at(x, y);
      const uint8_t* other = pictures[1].at(x, y);
      count += std::max({std::abs(code[0] - other[0]), std::abs(code[1] - other[1]), std::abs(code[2] - other[2])}) > 8;
    }
  }
  return count;
}

class LessonPictures : public testing::TestWithParam<int> {};

TEST_P(LessonPictures, RightHalfIsNearerToTheReference) {
  const PictureSize size = fullTests() ? PictureSize{160, 90} : PictureSize{112, 63};
  const Lesson lesson = shippedLessons().at(static_cast<size_t>(GetParam()));
  Options options = headless(lesson.scene, size);
  options.camera = lesson.camera;
  QuietSession session(options);
  const Settings ofScene = session.settings();
  const SceneState state = [&] {
    SceneState evaluated = evaluate(session.scene(), lesson.time);
    evaluated.camera = cameraOf(options, session.scene()).value_or(evaluated.camera);
    return evaluated;
  }();
  session.setCamera(state.camera);
  const auto truth = traceGroundTruth(session.scene(), state,
                                      {.width = size.width,
                                       .height = size.height,
                                       .samples = fullTests() ? 16 : 9,
                                       .floorSamples = 0,
                                       .settings = ofScene},
                                      [](double) { return true; });
  ASSERT_TRUE(truth);
  std::array<Image8, 2> pictures;
  std::array<double, 2> errors{};
  for (const int half : {0, 1}) {
    Settings settings = lesson.settingsOf(half, ofScene);
    settings.view.accumulate = std::min(settings.quality.stillPictures, fullTests() ? 16 : 8);
    session.setSettings(settings);
    pictures[half] = draw(session, lesson.time);
    errors[half] = errorsAgainst(*truth, pictures[half], settings).whole.flip;
  }
  EXPECT_GT(difference(pictures[0], pictures[1], 8).over, 20) << lesson.title;
  EXPECT_LT(errors[1], 0.9 * errors[0]) << lesson.title;
  // A window of 1280x720 has its panels on the left third and the divider in the middle of the rest.
  constexpr double panels = 0.35;
  constexpr double divider = 0.5 * (panels + 1.0);
  const int left = differing(pictures, panels, divider);
  const int right = differing(pictures, divider, 1.0);
  EXPECT_GT(std::min(left, right), 0.15 * std::max(left, right))
      << lesson.title << ": the divider is beside what is to be seen, " << left << " and " << right;
}

INSTANTIATE_TEST_SUITE_P(Shipped, LessonPictures, testing::Range(0, lessonFiles()));

TEST(Lessons, AllFilesAreRead) {
  for (const auto& entry : std::filesystem::directory_iterator(sourceFile("lessons"))) {
    const Lesson lesson = readLesson(entry.path());
    EXPECT_TRUE(lesson.lookFor.ends_with('.')) << entry.path();
  }
  const std::vector<Lesson> lessons = shippedLessons();
  EXPECT_EQ(static_cast<int>(lessons.size()), lessonFiles());
  EXPECT_EQ(lessons.front().title, "A mirror has the pixels of the picture") << "by the names of their files";
  EXPECT_EQ(lessons.front().settingsOf(0, {}).reflection.scale, 0.25);
  EXPECT_EQ(lessons.front().settingsOf(1, {}), Settings());
}

TEST(Lessons, BadFilesAreRefusedInOneLine) {
  const std::string head = "title = 't'\nscene = 'gallery'\ntext = 'a'\nlook_for = 'b'\n";
  const std::string good = head + "[a]\nview.samples = 1\n";
  const std::filesystem::path file = sceneDirectory() / "lesson.toml";
  const auto faultOf = [&](const std::string& text) {
    replaceFile(file, std::string_view(text));
    try {
      readLesson(file);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(faultOf(good), "");
  EXPECT_EQ(faultOf(good + "[b]\nreflection.samples = 8\n"), "");
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"scene = 'gallery'\n", ":1: title: is missing"},
      {"title = ''\nscene = 'gallery'\ntext = 'a'\nlook_for = 'b'\n", ":1: title: is empty"},
      {head, ":1: b: has the settings of a"},
      {head + "[a]\nview.sample = 1\n", ":6: view.sample: "},
      {head + "[a]\nview.samples = 3\n", ":6: view.samples: "},
      {head + "[c]\n", ":5: c: "},
      {head + "time = -1\n", ":5: time: "},
      {head + "camera = 'door'\n", ":5: camera: "},
      {"title = 't'\nscene = 'galery'\ntext = 'a'\nlook_for = 'b'\n", ":2: scene: is 'galery'"},
      {"title = 't'\nscene = [\n", ":"},
  };
  for (const auto& [text, expected] : faults) {
    const std::string fault = faultOf(text);
    EXPECT_TRUE(startsWith(fault, file.string() + expected)) << fault << "\nexpected " << expected;
    EXPECT_FALSE(contains(fault, "\n"));
    EXPECT_TRUE(fault.ends_with(')')) << fault;
  }
}

}  // namespace
}  // namespace speculum
