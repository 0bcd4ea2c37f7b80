// Names that do not fit.
#include <gtest/gtest.h>

#include "ui/elide.hpp"

namespace speculum {
namespace {

// Ten units a byte.
float widthOf(std::string_view text) {
  return 10.0f * static_cast<float>(text.size());
}

TEST(Elide, WhatFitsStays) {
  EXPECT_EQ(endThatFits("left > right", 120.0f, widthOf), "left > right");
  EXPECT_EQ(endThatFits("", 0.0f, widthOf), "");
}

TEST(Elide, TheEndStays) {
  EXPECT_EQ(endThatFits("left > right > left", 119.0f, widthOf), "...t > left");
  EXPECT_EQ(endThatFits("left > right > left", 40.0f, widthOf), "...t");
  EXPECT_EQ(endThatFits("left", 30.0f, widthOf), "...");
  EXPECT_EQ(endThatFits("left", 0.0f, widthOf), "...");
}

TEST(Elide, CharactersAreNotCut) {
  EXPECT_EQ(endThatFits("left > \u00e4\u00e4", 60.0f, widthOf), "...\u00e4");
  EXPECT_EQ(endThatFits("left > \u00e4\u00e4", 40.0f, widthOf), "...");
}

}  // namespace
}  // namespace speculum
