#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/realtime/latency_histogram.h>

namespace glissade::realtime {
namespace {

using std::chrono::nanoseconds;

std::int64_t exact_quantile(const std::vector<std::int64_t>& sorted, double p) {
  const auto rank = static_cast<std::size_t>(std::ceil(p * static_cast<double>(sorted.size())));
  return sorted[std::max(rank, std::size_t{1}) - 1];
}

TEST(LatencyHistogram, EmptyGivesZero) {
  const LatencyHistogram histogram;
  EXPECT_EQ(histogram.count(), 0U);
  EXPECT_EQ(histogram.max(), nanoseconds(0));
  EXPECT_EQ(histogram.quantile(0.5), nanoseconds(0));
}

TEST(LatencyHistogram, SmallValuesAreExact) {
  LatencyHistogram histogram;
  for (int i = 1; i <= 100; ++i)
    histogram.record(nanoseconds(i));
  EXPECT_EQ(histogram.quantile(0.0), nanoseconds(1));
  EXPECT_EQ(histogram.quantile(0.01), nanoseconds(1));
  EXPECT_EQ(histogram.quantile(0.5), nanoseconds(50));
  EXPECT_EQ(histogram.quantile(1.0), nanoseconds(100));
}

TEST(LatencyHistogram, QuantilesBoundTheExactOnesFromAbove) {
  constexpr unsigned kSeed = 20240607;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> log_ns(0.0, 11.5);
  LatencyHistogram histogram;
  std::vector<std::int64_t> values;
  for (int i = 0; i < 20000; ++i) {
    values.push_back(std::llround(std::pow(10.0, log_ns(random))));
    histogram.record(nanoseconds(values.back()));
  }
  std::sort(values.begin(), values.end());
  for (const double p : {0.0, 0.001, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99, 0.999, 1.0}) {
    const auto exact = static_cast<double>(exact_quantile(values, p));
    const auto found = static_cast<double>(histogram.quantile(p).count());
    EXPECT_GE(found, exact) << p;
    EXPECT_LE(found, exact * (1.0 + LatencyHistogram::kRelativeError)) << p;
  }
  EXPECT_EQ(histogram.quantile(1.0), histogram.max());
}

TEST(LatencyHistogram, PowersOfTwoBeginABucket) {
  for (int bit = 0; bit < 40; ++bit) {
    LatencyHistogram histogram;
    const std::int64_t power = std::int64_t{1} << bit;
    histogram.record(nanoseconds(power - 1));
    histogram.record(nanoseconds(power));
    EXPECT_EQ(histogram.quantile(0.5), nanoseconds(power - 1)) << "2^" << bit;
    EXPECT_EQ(histogram.quantile(1.0), nanoseconds(power)) << "2^" << bit;
  }
}

TEST(LatencyHistogram, TheSumOfTwoIsAsIfOneHadRecordedAll) {
  LatencyHistogram first;
  LatencyHistogram second;
  LatencyHistogram both;
  for (int i = 1; i <= 100; ++i) {
    const nanoseconds duration(i * i * i);
    (i % 3 == 0 ? first : second).record(duration);
    both.record(duration);
  }
  first.add(second);
  EXPECT_EQ(first.count(), 100U);
  EXPECT_EQ(first.max(), nanoseconds(1'000'000));
  for (const double p : {0.01, 0.25, 0.5, 0.99, 1.0})
    EXPECT_EQ(first.quantile(p), both.quantile(p)) << p;
}

TEST(LatencyHistogram, CountsWhatIsAtMostADuration) {
  LatencyHistogram histogram;
  for (const int ns : {0, 5, 5, 100, 1'000'000})
    histogram.record(nanoseconds(ns));
  EXPECT_EQ(histogram.count_up_to(nanoseconds(-1)), 0U);
  EXPECT_EQ(histogram.count_up_to(nanoseconds(0)), 1U);
  EXPECT_EQ(histogram.count_up_to(nanoseconds(4)), 1U);
  EXPECT_EQ(histogram.count_up_to(nanoseconds(5)), 3U);
  EXPECT_EQ(histogram.count_up_to(nanoseconds(900'000)), 4U);
  EXPECT_EQ(histogram.count_up_to(nanoseconds(1'000'000)), 5U);
  EXPECT_EQ(histogram.count_up_to(std::chrono::hours(10)), 5U);
}

TEST(LatencyHistogram, NegativeCountsAsZeroAndHugeStaysInMax) {
  LatencyHistogram histogram;
  histogram.record(nanoseconds(-5));
  histogram.record(std::chrono::hours(10));
  EXPECT_EQ(histogram.quantile(0.5), nanoseconds(0));
  EXPECT_EQ(histogram.max(), std::chrono::hours(10));
  EXPECT_EQ(histogram.quantile(1.0), std::chrono::hours(10));
}

}  // namespace
}  // namespace glissade::realtime
