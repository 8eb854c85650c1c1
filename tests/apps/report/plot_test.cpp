#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/report/growing_curve.h>
#include <glissade/apps/report/plot.h>
#include <glissade/apps/report/plot_axis.h>
#include <glissade/apps/report/svg_plot.h>

namespace glissade::apps {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

PlotSeries wave(std::size_t count) {
  PlotSeries series{"wave", {}, {}};
  for (std::size_t i = 0; i < count; ++i) {
    series.x.push_back(static_cast<double>(i));
    series.y.push_back(std::sin(0.01 * static_cast<double>(i)));
  }
  return series;
}

TEST(Decimation, KeepsPeaksEndsAndOrder) {
  PlotSeries series = wave(10000);
  series.y[4321] = 7.0;
  series.y[8765] = -9.0;
  const PlotSeries few = decimated(series, 200);
  EXPECT_LE(few.x.size(), 200U);
  EXPECT_EQ(*std::max_element(few.y.begin(), few.y.end()), 7.0);
  EXPECT_EQ(*std::min_element(few.y.begin(), few.y.end()), -9.0);
  EXPECT_EQ(few.x.front(), 0.0);
  EXPECT_EQ(few.x.back(), 9999.0);
  EXPECT_TRUE(std::is_sorted(few.x.begin(), few.x.end()));
}

TEST(GrowingCurve, HasEveryPointOfAShortRun) {
  GrowingCurve curve("wave");
  const PlotSeries points = wave(4000);
  for (std::size_t i = 0; i < points.x.size(); ++i)
    curve.add(points.x[i], points.y[i]);
  EXPECT_EQ(curve.series().x, points.x);
  EXPECT_EQ(curve.series().y, points.y);
  EXPECT_TRUE(GrowingCurve("nothing").series().x.empty());
}

TEST(GrowingCurve, KeepsPeaksEndsAndOrderOfALongRunInBoundedMemory) {
  PlotSeries points = wave(1'000'001);
  points.y[123'456] = 7.0;
  points.y[876'543] = -9.0;
  points.y.back() = 0.5;
  GrowingCurve curve("wave");
  std::size_t most = 0;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    curve.add(points.x[i], points.y[i]);
    if (i % 1000 == 0) most = std::max(most, curve.series().x.size());
  }
  EXPECT_LE(most, 10'000U);
  const PlotSeries few = curve.series();
  EXPECT_GT(few.x.size(), 4000U) << "finer than a page draws it";
  EXPECT_EQ(few.x.front(), 0.0);
  EXPECT_EQ(few.x.back(), 1e6);
  EXPECT_EQ(few.y.back(), 0.5);
  EXPECT_TRUE(std::is_sorted(few.x.begin(), few.x.end()));
  for (const std::size_t peak : {std::size_t{123'456}, std::size_t{876'543}}) {
    const auto at = std::find(few.x.begin(), few.x.end(), points.x[peak]);
    ASSERT_NE(at, few.x.end());
    EXPECT_EQ(few.y[static_cast<std::size_t>(at - few.x.begin())], points.y[peak]);
  }
  for (std::size_t i = 0; i < few.x.size(); ++i)
    ASSERT_EQ(few.y[i], points.y[static_cast<std::size_t>(few.x[i])]) << "points of the line itself";
}

TEST(Decimation, LeavesShortLinesAlone) {
  EXPECT_EQ(decimated(wave(200), 200).y, wave(200).y);
}

TEST(Decimation, KeepsGaps) {
  PlotSeries series = wave(10000);
  std::fill(series.y.begin() + 3000, series.y.begin() + 6000, std::numeric_limits<double>::quiet_NaN());
  const PlotSeries few = decimated(series, 200);
  EXPECT_TRUE(std::any_of(few.y.begin(), few.y.end(), [](double y) { return std::isnan(y); }));
  EXPECT_TRUE(std::isfinite(few.y.back()));
}

TEST(AxisTicks, AreRoundNumbersWithEvenLabels) {
  EXPECT_THAT(axis_ticks(0.0, 10.0, 5).labels, ElementsAre("0", "2", "4", "6", "8", "10"));
  EXPECT_THAT(axis_ticks(-0.3, 0.35, 4).labels, ElementsAre("-0.2", "0.0", "0.2"));
  EXPECT_THAT(axis_ticks(0.0, 0.05, 6).labels, ElementsAre("0.00", "0.01", "0.02", "0.03", "0.04", "0.05"));
  EXPECT_THAT(axis_ticks(0.0, 4e-8, 4).labels, ElementsAre("0e+00", "1e-08", "2e-08", "3e-08", "4e-08"));
  EXPECT_THAT(axis_ticks(0.0, 1.5e-7, 4).labels, ElementsAre("0.0e+00", "5.0e-08", "1.0e-07", "1.5e-07"));
}

TEST(AxisTicks, AFlatLineGetsRoomOnBothSides) {
  for (const double value : {0.0, 5.0, -1e-9, 1e12}) {
    const AxisRange range = rounded_range(value, value, 6);
    EXPECT_LT(range.low, value);
    EXPECT_GT(range.high, value);
  }
}

TEST(AxisTicks, NoiseOfRoundingIsFlat) {
  const AxisRange range = rounded_range(-1e-7, 1.5e-7, 6);
  EXPECT_EQ(range.low, -1.0);
  EXPECT_EQ(range.high, 1.0);
}

TEST(AxisTicks, TheRangeHoldsTheDataAndEndsAtTicks) {
  const AxisRange range = rounded_range(-0.13, 9.7, 6);
  EXPECT_DOUBLE_EQ(range.low, -2.0);
  EXPECT_DOUBLE_EQ(range.high, 10.0);
}

TEST(SvgPlot, DrawsALineForEachSeriesAndBreaksItAtGaps) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Plot plot{"force", "time [s]", "force [N]", {{"a", {0, 1, 2, 3, 4}, {0, 1, nan, 1, 0}}, {"b", {0, 4}, {2, 2}}}};
  const std::string svg = svg_plot(plot);
  EXPECT_THAT(svg, HasSubstr("class=\"line c0\""));
  EXPECT_THAT(svg, HasSubstr("class=\"line c1\""));
  EXPECT_EQ(std::count(svg.begin(), svg.end(), 'M'), 3) << "two pieces of a, one of b";
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(SvgPlot, EscapesItsTexts) {
  const std::string svg = svg_plot({"a<b & \"c\"", "x<y", "z", {{"s", {0, 1}, {0, 1}}}});
  EXPECT_THAT(svg, HasSubstr("a&lt;b &amp; &quot;c&quot;"));
  EXPECT_THAT(svg, HasSubstr("x&lt;y"));
}

TEST(SvgPlot, SaysWhenThereIsNothingToDraw) {
  EXPECT_THAT(svg_plot({"empty", "x", "y", {}}), HasSubstr("no data"));
  EXPECT_THAT(svg_plot({"empty", "x", "y", {{"s", {}, {}}}}), HasSubstr("no data"));
  EXPECT_THAT(svg_plot({"point", "x", "y", {{"s", {1.0}, {2.0}}}}), Not(HasSubstr("no data")));
}

TEST(AxisTicks, OfNumbersOfThingsAreWhole) {
  EXPECT_EQ(axis_ticks(0.0, 2.0, 6).step, 0.5);
  const AxisRange range = rounded_range(0.0, 2.0, 6, 1.0);
  EXPECT_EQ(axis_ticks(range.low, range.high, 6, 1.0).labels, (std::vector<std::string>{"0", "1", "2"}));
  Plot plot{"contacts", "x", "y", {{"a", {0, 1}, {0, 2}}}, true};
  EXPECT_EQ(svg_plot(plot).find("0.5</text>"), svg_plot(plot).rfind("0.5</text>")) << "only at the other axis";
}

TEST(Strip, EqualWordsAreOneSpan) {
  Strip strip{"part", {}};
  strip.add(0.0, 2);
  strip.add(1.0, 2);
  strip.add(2.0, 1);
  strip.end_at(2.5);
  ASSERT_EQ(strip.spans.size(), 2u);
  EXPECT_EQ(strip.spans[0].end, 2.0);
  EXPECT_EQ(strip.spans[1].word, 1u);
  EXPECT_EQ(strip.spans[1].end, 2.5);
}

TEST(Strip, OfManySpansTheLongestInEachStretchIsKept) {
  // Two states that alternate 1000 times: for 3 ms and 1 ms, and in the second half the other way round.
  Strip strip{"part", {}};
  for (int i = 0; i < 2000; ++i) {
    const bool is_late = i >= 1000;
    strip.add(0.004 * i, is_late ? 1 : 0);
    strip.add(0.004 * i + 0.003, is_late ? 0 : 1);
  }
  strip.end_at(8.0);
  const Strip coarse = coarsened(strip, 100);
  ASSERT_EQ(coarse.spans.size(), 2u);
  EXPECT_EQ(coarse.spans[0].word, 0u);
  EXPECT_NEAR(coarse.spans[0].end, 4.0, 1e-9);
  EXPECT_EQ(coarse.spans[1].word, 1u);
  EXPECT_EQ(coarse.spans[1].end, 8.0);
  EXPECT_EQ(coarsened(coarse, 100).spans.size(), 2u);
}

}  // namespace
}  // namespace glissade::apps
