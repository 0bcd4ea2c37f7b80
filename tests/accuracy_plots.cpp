#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "accuracy/html_text.hpp"
#include "accuracy/plot_axis.hpp"
#include "accuracy/svg_plot.hpp"

namespace speculum {
namespace {

using Values = std::vector<double>;
using Texts = std::vector<std::string>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

TEST(Ticks, LinearOnesAreRound) {
  EXPECT_EQ(linearTicks(0.0, 10.0, 6), (Values{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(linearTicks(0.0, 1.0, 11), (Values{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1}));
  EXPECT_EQ(linearTicks(-0.3, 0.3, 3), (Values{-0.2, 0, 0.2}));
  EXPECT_EQ(linearTicks(101.0, 199.0, 4), (Values{120, 140, 160, 180}));
  EXPECT_EQ(linearTicks(3.0, 3.0, 5), (Values{3}));
}

TEST(Ticks, LogarithmicOnesAreOneTwoFive) {
  EXPECT_EQ(logarithmicTicks(0.1, 10.0, 10), (Values{0.1, 0.2, 0.5, 1, 2, 5, 10}));
  EXPECT_EQ(logarithmicTicks(0.0015, 0.03, 10), (Values{0.002, 0.005, 0.01, 0.02}));
  EXPECT_EQ(logarithmicTicks(1e-4, 1e2, 8), (Values{1e-4, 1e-3, 1e-2, 0.1, 1, 10, 100}));
  EXPECT_EQ(logarithmicTicks(1e-4, 1e4, 5), (Values{1e-4, 1e-2, 1, 100, 1e4}));
}

TEST(Ticks, ShortLogarithmicRangesGetLinearOnes) {
  EXPECT_EQ(logarithmicTicks(2.9, 4.1, 6), (Values{3, 3.5, 4}));
}

TEST(Ticks, NeverMoreThanAsked) {
  for (const double factor : {1.01, 1.5, 3.0, 40.0, 1e5, 1e12, 1e200}) {
    for (int most = 2; most < 12; ++most) {
      EXPECT_LE(logarithmicTicks(0.7e-20, 0.7e-20 * factor, most).size(), static_cast<size_t>(most)) << factor;
      EXPECT_LE(linearTicks(-0.7, -0.7 + factor, most).size(), static_cast<size_t>(most)) << factor;
    }
  }
}

TEST(Ticks, LabelsOfAnAxisHaveOneStyle) {
  EXPECT_EQ(tickLabels({0.0001, 0.01, 1, 1000}), (Texts{"0.0001", "0.01", "1", "1000"}));
  EXPECT_EQ(tickLabels({-0.2, 0, 0.2}), (Texts{"−0.2", "0", "0.2"}));
  EXPECT_EQ(tickLabels({1e-5, 2e-4, 1e-2, 1}), (Texts{"10⁻⁵", "2×10⁻⁴", "10⁻²", "10⁰"}));
  EXPECT_EQ(tickLabels({1e3, 1e6}), (Texts{"10³", "10⁶"}));
}

TEST(Scale, EqualRatiosAreEqualDistances) {
  const PlotScale scale(PlotAxis{}, {1.0, 100.0}, 50.0, 450.0);
  const double one = *scale.at(1.0);
  const double ten = *scale.at(10.0);
  EXPECT_GT(one, 50.0);
  EXPECT_NEAR(*scale.at(100.0) - ten, ten - one, 1e-9);
  EXPECT_LT(*scale.at(100.0), 450.0);
  EXPECT_FALSE(scale.hasZero());
}

TEST(Scale, WhatHasNoPlaceOnTheAxisStandsApart) {
  const PlotScale scale(PlotAxis{.apart = 1e6}, {0.0, 1.0, 100.0, 1e6}, 50.0, 450.0);
  EXPECT_TRUE(scale.hasZero());
  EXPECT_LT(*scale.at(0.0), scale.axisStart());
  EXPECT_GE(*scale.at(0.0), 50.0);
  EXPECT_EQ(scale.at(-3.0), scale.at(0.0));
  EXPECT_GT(*scale.at(1e6), scale.axisEnd());
  EXPECT_LE(*scale.at(1e6), 450.0);
  EXPECT_GT(*scale.at(1.0), scale.axisStart());
  EXPECT_LT(*scale.at(100.0), scale.axisEnd());
  EXPECT_EQ(scale.at(infinity), scale.at(1e6));
  EXPECT_FALSE(scale.at(notANumber));
  EXPECT_FALSE(scale.unclampedAt(0.0));
}

TEST(Scale, OneValueIsARangeToo) {
  for (const AxisScale kind : {AxisScale::linear, AxisScale::logarithmic}) {
    for (const double value : {1e-300, 0.02, 7.0, 1e300}) {
      const PlotScale scale(PlotAxis{.scale = kind}, {value}, 400.0, 0.0);
      EXPECT_GE(*scale.at(value), 0.0);
      EXPECT_LE(*scale.at(value), 400.0);
    }
    const PlotScale none(PlotAxis{.scale = kind}, {}, 0.0, 100.0);
    EXPECT_FALSE(none.ticks(6.0, 10.0).empty());
  }
}

TEST(Scale, GivenTicksKeepTheirPlacesAndCrowdedLabelsGo) {
  const PlotAxis axis{.scale = AxisScale::linear, .ticks = {0, 1, 1.01, 2}};
  const auto ticks = PlotScale(axis, {0.0, 2.0}, 0.0, 200.0).ticks(6.0, 10.0);
  ASSERT_EQ(ticks.size(), 4u);
  EXPECT_EQ(ticks[0].label, "0");
  EXPECT_EQ(ticks[1].label, "1");
  EXPECT_EQ(ticks[2].label, "");
  EXPECT_EQ(ticks[3].label, "2");
}

TEST(SvgPlot, LinesEndAtTheFrame) {
  Plot plot{.x = {.label = "x"}, .y = {.label = "y"}};
  plot.marks = {{.at = {1.0, 1.0}}, {.at = {10.0, 2.0}}};
  plot.lines = {{.style = "steep", .points = {{1.0, 1.0}, {10.0, 1e9}}}, {.points = {{1.0, 1e7}, {10.0, 1e9}}}};
  const std::string svg = plotSvg(plot);
  EXPECT_NE(svg.find("<g class=\"steep\"><path"), std::string::npos);
  EXPECT_EQ(svg.find("<g class=\"\"><path"), std::string::npos) << "wholly outside";
}

TEST(SvgPlot, LabelsThatFindNoRoomAreLeftOut) {
  Plot plot;
  for (int i = 0; i < 40; ++i) {
    plot.marks.push_back({.at = {1.0 + 1e-4 * i, 1.0}, .label = "label " + std::to_string(i)});
  }
  plot.marks.push_back({.at = {50.0, 1.0}, .label = "alone"});
  const std::string svg = plotSvg(plot);
  EXPECT_NE(svg.find(">label 39<"), std::string::npos);
  EXPECT_EQ(svg.find(">label 10<"), std::string::npos);
  EXPECT_NE(svg.find(">alone<"), std::string::npos);
}

TEST(HtmlText, EscapesWhatHtmlReads) {
  EXPECT_EQ(escapeHtml("<a href=\"x\">&'</a>"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;&lt;/a&gt;");
  EXPECT_EQ(escapeHtml("für ∞ 😀\n"), "für ∞ 😀\n");
  EXPECT_EQ(escapeHtml("a\xff\xc3(\x01\xed\xa0\x80"), "a\uFFFD\uFFFD(\uFFFD\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(escapeHtml(std::string_view("\xe2\x88", 2)), "\uFFFD\uFFFD");
}

TEST(HtmlText, Base64OfTheRfc) {
  const auto encoded = [](const std::string& text) { return base64(std::vector<uint8_t>(text.begin(), text.end())); };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded("\xfb\xff\xfe"), "+//+");
}

TEST(HtmlText, NumbersForPeople) {
  EXPECT_EQ(numberText(0.0), "0");
  EXPECT_EQ(numberText(0.012345), "0.0123");
  EXPECT_EQ(numberText(9.996), "10.0");
  EXPECT_EQ(numberText(12345.6), "12346");
  EXPECT_EQ(numberText(-1.5, 2), "−1.5");
  EXPECT_EQ(numberText(3.21e-5), "3.21×10⁻⁵");
  EXPECT_EQ(numberText(2.5e12, 2), "2.5×10¹²");
  EXPECT_EQ(numberText(infinity), "∞");
  EXPECT_EQ(numberText(notANumber), "–");
  EXPECT_EQ(fixedText(infinity, 2), "∞");
  EXPECT_EQ(fixedText(-0.125, 1), "−0.1");
  EXPECT_EQ(columnDecimals({0.0, 0.0123, 4.0, infinity}), 4);
  EXPECT_EQ(columnDecimals({}), 0);
}

TEST(HtmlText, ShellWordsSurviveTheShell) {
  EXPECT_EQ(setOptions({{"reflection.scale", "0.5"}, {"view.clear_color", "1,0,0"}}),
            "--set reflection.scale=0.5 --set view.clear_color=1,0,0");
  EXPECT_EQ(shellWord("it's $5"), "'it'\\''s $5'");
  EXPECT_EQ(shellWord(""), "''");
  EXPECT_EQ(exactText(0.1), "0.1");
}

}  // namespace
}  // namespace speculum
