// Positions of the panel's windows.
#include <gtest/gtest.h>

#include "ui/panel_layout.hpp"

namespace speculum {
namespace {

bool overlap(const WindowRect& a, const WindowRect& b) {
  const glm::vec2 low = glm::max(a.corner, b.corner);
  const glm::vec2 high = glm::min(a.corner + a.size, b.corner + b.size);
  return low.x < high.x && low.y < high.y;
}

const std::vector<WindowWish> threeWindows{{{375, 690}, 180}, {{405, 330}, 180}, {{405, 330}, 180}};

TEST(PanelLayout, WindowsShareTheirEdgeWithoutOverlap) {
  const WindowRoom room{.display = {1280, 720}, .margin = 12, .taken = 432, .right = true};
  for (size_t count = 1; count <= threeWindows.size(); ++count) {
    const std::vector<WindowRect> places = arrangeWindows(std::span(threeWindows).first(count), room);
    for (size_t i = 0; i < count; ++i) {
      EXPECT_GE(places[i].size.y, 180.0f);
      EXPECT_GE(places[i].corner.x, 432.0f);
      EXPECT_LE(places[i].corner.x + places[i].size.x, 1268.0f);
      EXPECT_LE(places[i].corner.y + places[i].size.y, 708.0f);
      for (size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(overlap(places[i], places[j])) << i << " " << j;
      }
    }
  }
  EXPECT_EQ(arrangeWindows(std::span(threeWindows).first(1), room)[0].size, glm::vec2(375, 690)) << "as wished";
}

TEST(PanelLayout, ManyWindowsGoBesideThenGetLower) {
  const std::vector<WindowWish> wishes(6, {{405, 330}, 180});
  for (const float width : {1280.0f, 900.0f, 2560.0f}) {
    const WindowRoom room{.display = {width, 720}, .margin = 12, .taken = 432, .right = true};
    const std::vector<WindowRect> places = arrangeWindows(wishes, room);
    float lowest = 1e9f;
    for (size_t i = 0; i < places.size(); ++i) {
      lowest = std::min(lowest, places[i].size.y);
      EXPECT_LE(places[i].corner.y + places[i].size.y, 720.0f);
      for (size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(overlap(places[i], places[j])) << width << ": " << i << " " << j;
      }
    }
    EXPECT_EQ(lowest < 180.0f, width < 1000.0f) << width;
  }
}

TEST(PanelLayout, RoomBelowIsKeptFree) {
  const WindowRoom room{.display = {900, 700}, .margin = 12, .bottom = 40};
  const WindowRect place = arrangeWindows(std::vector<WindowWish>{{{420, 900}, 180}}, room)[0];
  EXPECT_EQ(place.corner, glm::vec2(12, 12));
  EXPECT_EQ(place.size, glm::vec2(420, 636));
}

TEST(PanelLayout, WindowIsMovedIntoTheDisplay) {
  EXPECT_EQ(fitWindow({{100, 50}, {300, 200}}, {900, 700}), (WindowRect{{100, 50}, {300, 200}}));
  EXPECT_EQ(fitWindow({{850, 650}, {300, 200}}, {900, 700}), (WindowRect{{600, 500}, {300, 200}}));
  EXPECT_EQ(fitWindow({{-40, -9}, {300, 900}}, {200, 100}), (WindowRect{{0, 0}, {200, 100}}));
}

}  // namespace
}  // namespace speculum
