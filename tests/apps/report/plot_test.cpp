#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/apps/report/growing_curve.h>
#include <glissade/apps/report/word_curve.h>

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

TEST(WordCurve, AWordHoldsUpToTheNextOne) {
  WordCurve curve("part");
  EXPECT_TRUE(curve.series().x.empty());
  for (const auto& [time, word] : {std::pair(0.0, 2), std::pair(1.0, 2), std::pair(2.0, 1), std::pair(2.5, 1)})
    curve.add(time, static_cast<std::size_t>(word));
  const PlotSeries series = curve.series();
  EXPECT_EQ(series.name, "part");
  EXPECT_EQ(series.x, (std::vector<double>{0.0, 2.0, 2.5}));
  EXPECT_EQ(series.y, (std::vector<double>{2, 1, 1}));
}

TEST(WordCurve, KeepsTheLongestWordOfEachIntervalOfALongRun) {
  // Two states that alternate 1000 times: for 3 ms and 1 ms, and in the second half the other way round.
  WordCurve curve("part");
  for (int i = 0; i < 2000; ++i) {
    const bool is_late = i >= 1000;
    curve.add(0.004 * i, is_late ? 1 : 0);
    curve.add(0.004 * i + 0.003, is_late ? 0 : 1);
  }
  curve.add(8.0, 0);
  const PlotSeries coarse = curve.series(100);
  ASSERT_EQ(coarse.x.size(), 3u);
  EXPECT_NEAR(coarse.x[1], 4.0, 1e-9);
  EXPECT_EQ(coarse.x[2], 8.0);
  EXPECT_EQ(coarse.y, (std::vector<double>{0, 1, 1}));
  EXPECT_EQ(curve.series(5000).x.size(), 4000u) << "each begin, of which two are one, and the end";
}

}  // namespace
}  // namespace glissade::apps
