#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <glissade/apps/report/growing_curve.h>
#include <glissade/apps/report/strip_chart.h>

namespace glissade::apps {
namespace {

PlotSeries wave(std::size_t count) {
  PlotSeries series{"wave", {}, {}};
  for (std::size_t i = 0; i < count; ++i) {
    series.x.push_back(static_cast<double>(i));
    series.y.push_back(std::sin(0.01 * static_cast<double>(i)));
  }
  return series;
}

TEST(GrowingCurve, HasEveryPointOfAShortRun) {
  GrowingCurve curve("wave");
  const PlotSeries points = wave(1500);
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
  EXPECT_LE(most, 3100U) << "a page of many lines stays small";
  const PlotSeries few = curve.series();
  EXPECT_GT(few.x.size(), 1500U) << "as fine as a page draws it";
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
