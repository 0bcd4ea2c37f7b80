// Positions of the panel's windows.
#include "test_headers.hpp"
#include "ui/panel_dock.hpp"

namespace speculum {
namespace {

bool overlap(const WindowRect& a, const WindowRect& b) {
  const glm::vec2 low = glm::max(a.corner, b.corner);
  const glm::vec2 high = glm::min(a.corner + a.size, b.corner + b.size);
  return low.x < high.x && low.y < high.y;
}

constexpr float title = 20.0f;

WindowWish wish(float width, float height, int rank = 0) {
  return {width, {180, 180, height}, rank};
}

int countFolded(const std::vector<WindowPlace>& places) {
  return static_cast<int>(std::ranges::count(places, true, &WindowPlace::folded));
}

const std::vector<WindowWish> threeWindows{wish(375, 690), wish(405, 330), wish(405, 330)};

TEST(PanelLayout, WindowsShareTheirEdgeWithoutOverlap) {
  const WindowRoom room{.display = {1280, 720}, .margin = 12, .title = title, .taken = 432, .right = true};
  for (size_t count = 1; count <= threeWindows.size(); ++count) {
    const std::vector<WindowPlace> places = arrangeWindows(std::span(threeWindows).first(count), room);
    EXPECT_EQ(countFolded(places), 0);
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

TEST(PanelLayout, ManyWindowsGoBesideThenFold) {
  std::vector<WindowWish> wishes;
  for (const int rank : {3, 1, 6, 2, 5, 4}) {
    wishes.push_back(wish(405, 330, rank));
  }
  for (const float width : {1280.0f, 900.0f, 2560.0f}) {
    const WindowRoom room{.display = {width, 720}, .margin = 12, .title = title, .taken = 432, .right = true};
    const std::vector<WindowPlace> places = arrangeWindows(wishes, room);
    for (size_t i = 0; i < places.size(); ++i) {
      EXPECT_EQ(places[i].folded, width < 1000.0f && wishes[i].rank <= 3) << width << ": " << i;
      EXPECT_EQ(places[i].size.y < 180.0f, places[i].folded) << width << ": " << i;
      EXPECT_EQ(places[i].size.y == title, places[i].folded) << width << ": " << i;
      EXPECT_LE(places[i].corner.y + places[i].size.y, 708.0f);
      for (size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(overlap(places[i], places[j])) << width << ": " << i << " " << j;
      }
    }
  }
}

TEST(PanelLayout, LastOpenedWindowTakesWhatIsLeft) {
  const WindowRoom room{.display = {400, 200}, .margin = 10, .title = title};
  const WindowWish collapsed{300, {title, title, title}, 4};
  const std::vector<WindowPlace> places =
      arrangeWindows(std::vector<WindowWish>{wish(300, 330, 3), wish(300, 330, 2), collapsed}, room);
  EXPECT_FALSE(places[0].folded);
  EXPECT_EQ(places[0].size.y, 200 - 2 * 10 - 2 * (title + 10));
  EXPECT_TRUE(places[1].folded);
  EXPECT_FALSE(places[2].folded) << "it is a title already";
}

TEST(PanelLayout, RoomIsSharedBetweenLeastAndWished) {
  using Shares = std::vector<float>;
  const std::vector<Length> lengths{{180, 180, 280}, {180, 240, 240}};  // the user sized the second
  EXPECT_EQ(shareRoom(lengths, 900), Shares({280, 240}));
  EXPECT_EQ(shareRoom(lengths, 470), Shares({230, 240})) << "what the user gave is kept";
  EXPECT_EQ(shareRoom(lengths, 390), Shares({180, 210}));
  EXPECT_EQ(shareRoom(lengths, 100), Shares({180, 180}));
  EXPECT_EQ(shareRoom(std::vector<Length>{{180, 180, 280}, {180, 180, 230}}, 435), Shares({230, 205}));
}

TEST(PanelLayout, RoomBelowIsKeptFree) {
  const WindowRoom room{.display = {900, 700}, .margin = 12, .bottom = 40};
  const WindowPlace place = arrangeWindows(std::vector<WindowWish>{wish(420, 900)}, room)[0];
  EXPECT_EQ(place.corner, glm::vec2(12, 12));
  EXPECT_EQ(place.size, glm::vec2(420, 636));
}

TEST(PanelLayout, WindowIsMovedIntoTheDisplay) {
  EXPECT_EQ(fitWindow({{100, 50}, {300, 200}}, {900, 700}), (WindowRect{{100, 50}, {300, 200}}));
  EXPECT_EQ(fitWindow({{850, 650}, {300, 200}}, {900, 700}), (WindowRect{{600, 500}, {300, 200}}));
  EXPECT_EQ(fitWindow({{-40, -9}, {300, 900}}, {200, 100}), (WindowRect{{0, 0}, {200, 100}}));
}

TEST(PanelLayout, TitlesStayReachable) {
  const glm::vec2 display(900, 700);
  const auto reachable = [&](const WindowRect& wish) { return reachableWindow(wish, display, 20.0f, 12.0f); };
  EXPECT_EQ(reachable({{850, 650}, {300, 200}}), (WindowRect{{850, 650}, {300, 200}})) << "partly hidden, as put there";
  for (const float far : {-1e38f, -32767.0f, -300.0f, 0.0f, 890.0f, 32767.0f, 1e38f}) {
    for (const float size : {0.0f, 16.0f, 300.0f, 32767.0f, 1e38f}) {
      const WindowRect place = reachable({{far, far}, {size, size}});
      EXPECT_LE(place.corner.x, 900 - 12);
      EXPECT_GE(place.corner.x + place.size.x, 12);
      EXPECT_LE(place.corner.y, 700 - 12);
      EXPECT_GE(place.corner.y, 20);
      EXPECT_LE(std::max(place.size.x, place.size.y), 900);
    }
  }
}

}  // namespace
}  // namespace speculum
