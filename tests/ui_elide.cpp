// Shortened names and broken lines.
#include "test_headers.hpp"
#include "ui/elide.hpp"

namespace speculum {
namespace {

// Ten units a byte.
float widthOf(std::string_view text) {
  return 10.0f * static_cast<float>(text.size());
}

TEST(Elide, FittingTextStays) {
  EXPECT_EQ(startThatFits("left > right", 120.0f, widthOf), "left > right");
  EXPECT_EQ(startThatFits("", 0.0f, widthOf), "");
}

TEST(Elide, TheStartStays) {
  EXPECT_EQ(startThatFits("left > right > left", 119.0f, widthOf), "left > r...");
  EXPECT_EQ(startThatFits("left > right > left", 40.0f, widthOf), "l...");
  EXPECT_EQ(startThatFits("left", 30.0f, widthOf), "...");
  EXPECT_EQ(startThatFits("left", 0.0f, widthOf), "...");
}

TEST(Elide, CharactersAreNotCut) {
  EXPECT_EQ(startThatFits("\u00e4\u00e4 > left", 60.0f, widthOf), "\u00e4...");
  EXPECT_EQ(startThatFits("\u00e4\u00e4 > left", 40.0f, widthOf), "...");
}

TEST(Elide, LinesBreakAtSpacesOnly) {
  EXPECT_EQ(brokenAtSpaces("about 0.2. Space pauses", 100.0f, widthOf), "about 0.2.\nSpace\npauses");
  EXPECT_EQ(brokenAtSpaces("about 0.2. Space pauses", 90.0f, widthOf), "about\n0.2.\nSpace\npauses");
  EXPECT_EQ(brokenAtSpaces("about 0.2", 90.0f, widthOf), "about 0.2");
  EXPECT_EQ(brokenAtSpaces("a word\nof 3", 60.0f, widthOf), "a word\nof 3") << "lines are counted anew";
  EXPECT_EQ(brokenAtSpaces("reflections of", 50.0f, widthOf), "reflections\nof");
}

}  // namespace
}  // namespace speculum
