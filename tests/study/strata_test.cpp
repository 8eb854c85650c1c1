/// Stratified sampling, with success that has a closed form: a peg goes in if its offset is smaller than the play.

#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/study/sampler.h>
#include <glissade/study/strata.h>
#include <glissade/study/success_rate.h>

namespace glissade::study {
namespace {

/// Offsets in x and y, and a play; all from 0 to 1 or −1 to 1.
Study pegs(Sampling sampling, std::int64_t slides, std::uint64_t seed) {
  Study study;
  study.parameters = {
      {"x", {}, {Uniform{-1.0, 1.0}}}, {"y", {}, {Uniform{-1.0, 1.0}}}, {"play", {}, {Uniform{0.0, 1.0}}}};
  study.sampling = sampling;
  study.slides = slides;
  study.seed = seed;
  return study;
}

bool fits(const std::vector<double>& values, double scale = 1.0) {
  return std::hypot(values[0], values[1]) < scale * values[2];
}

/// The mean over the play r of the area π (scale r)² of a disc in the square of area 4.
double true_rate(double scale = 1.0) {
  return std::acos(-1.0) / 12.0 * scale * scale;
}

std::vector<Distribution> distributions() {
  std::vector<Distribution> result;
  for (const Parameter& parameter : pegs(Sampling::kRandom, 1, 1).parameters)
    result.push_back(parameter.distribution);
  return result;
}

/// `scale` makes all plays smaller.
std::vector<PilotSlide> pilot_of(std::int64_t slides, std::uint64_t seed, double scale = 1.0) {
  const Sampler sampler(pegs(Sampling::kSobol, slides, seed));
  std::vector<PilotSlide> pilot;
  for (std::int64_t slide = 0; slide < slides; ++slide) {
    PilotSlide& one = pilot.emplace_back();
    one.values = sampler.values(slide);
    one.succeeds = fits(one.values, scale);
  }
  return pilot;
}

Study stratified(const std::vector<Stratum>& strata, std::int64_t slides, std::uint64_t seed) {
  Study study = pegs(Sampling::kStratified, slides, seed);
  study.strata = std::make_shared<const Strata>(strata, slides, seed);
  return study;
}

Rate rate_of(const Study& study, double scale = 1.0) {
  const Sampler sampler(study);
  std::vector<StratumCount> counts;
  for (const Stratum& stratum : study.strata->all())
    counts.push_back({stratum.weight});
  for (std::int64_t slide = 0; slide < study.slides; ++slide) {
    StratumCount& count = counts[study.strata->index_of(slide)];
    ++count.slides;
    count.successes += fits(sampler.values(slide), scale) ? 1.0 : 0.0;
  }
  return stratified_rate(counts);
}

TEST(Strata, DivideTheRangesWhereSuccessTurnsIntoFailure) {
  const std::vector<Stratum> strata = make_strata(distributions(), pilot_of(512, 1), 40);
  EXPECT_EQ(strata.size(), 40U);
  double weight = 0.0;
  for (const Stratum& stratum : strata) {
    double volume = 1.0;
    for (std::size_t p = 0; p < 3; ++p)
      volume *= stratum.upper[p] - stratum.lower[p];
    EXPECT_DOUBLE_EQ(volume, stratum.weight);
    weight += stratum.weight;
  }
  EXPECT_DOUBLE_EQ(weight, 1.0);
}

TEST(Strata, WithoutFailureThereIsOneStratum) {
  EXPECT_EQ(make_strata({{Uniform{0.0, 1.0}}}, std::vector<PilotSlide>(100, {{0.5}, true}), 100).size(), 1U);
}

/// Halves across the second parameter have the same success rate, because success is in the middle.
TEST(Strata, SuccessInTheMiddleIsFound) {
  std::vector<PilotSlide> pilot;
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j)
      pilot.push_back({{j / 64.0, i / 64.0}, std::abs(i - 31.5) < 16.0});
  }
  const std::vector<Stratum> strata = make_strata({{Uniform{0.0, 1.0}}, {Uniform{0.0, 1.0}}}, pilot, 100);
  ASSERT_EQ(strata.size(), 4U) << "quarters across the second parameter";
  for (const Stratum& stratum : strata)
    EXPECT_EQ(stratum.upper[0] - stratum.lower[0], 1.0);
}

/// Of five values, all equally likely, the third one fails.
TEST(Strata, NoCutGoesThroughOneOfSeveralValues) {
  std::vector<PilotSlide> pilot;
  for (int i = 0; i < 100; ++i)
    pilot.push_back({{static_cast<double>(i % 5)}, i % 5 != 2});
  const Distribution values{OneOf{{"a", "b", "c", "d", "e"}, {}}};
  for (const Stratum& stratum : make_strata({values}, pilot, 100)) {
    EXPECT_TRUE(stratum.pilot_successes == 0 || stratum.pilot_successes == stratum.pilot_slides);
    EXPECT_NEAR(stratum.weight, 0.01 * static_cast<double>(stratum.pilot_slides), 1e-12);
  }
}

TEST(Strata, MostSlidesAreWhereSuccessIsUncertain) {
  std::vector<Stratum> two(2, {{0.0}, {1.0}, 0.5});
  two[0].pilot_slides = two[1].pilot_slides = 98;
  two[1].pilot_successes = 49;  // deviations: 0.0995 and 0.5
  const Strata strata(two, 1004, 1);
  EXPECT_EQ(strata.all()[0].slides, 2 + 166);
  EXPECT_EQ(strata.all()[1].slides, 2 + 834);
  double weights = 0.0;
  for (std::int64_t slide = 0; slide < 1004; ++slide)
    weights += strata.weight_of(slide);
  EXPECT_NEAR(weights, 1004.0, 1e-9);
  EXPECT_THROW(Strata(two, 3, 1), std::invalid_argument);
}

TEST(Strata, ValuesLieInTheStratumOfTheirSlide) {
  const Study study = stratified(make_strata(distributions(), pilot_of(256, 1), 30), 500, 1);
  const Sampler sampler(study);
  for (std::int64_t slide = 0; slide < 500; ++slide) {
    const Stratum& stratum = study.strata->of(slide);
    const double play = sampler.values(slide)[2];
    EXPECT_GT(play, stratum.lower[2]);
    EXPECT_LT(play, stratum.upper[2]);
  }
}

// Also where success is rare: one in a hundred.
TEST(Strata, TheIntervalContainsTheRateOfTheClosedForm) {
  constexpr int kStudies = 200;
  for (const double scale : {1.0, 0.2}) {
    int misses = 0;
    double mean = 0.0;
    double square = 0.0;
    for (std::uint64_t seed = 1; seed <= kStudies; ++seed) {
      const std::vector<Stratum> strata = make_strata(distributions(), pilot_of(256, seed, scale), most_strata(400));
      const Rate rate = rate_of(stratified(strata, 400, seed), scale);
      misses += rate.least <= true_rate(scale) && true_rate(scale) <= rate.greatest ? 0 : 1;
      mean += rate.share / kStudies;
      square += rate.share * rate.share / kStudies;
    }
    EXPECT_LE(misses, 0.05 * kStudies) << scale;
    EXPECT_NEAR(mean, true_rate(scale), 3.0 * std::sqrt((square - mean * mean) / kStudies))
        << "no bias, scale " << scale;
  }
}

double half_width_of(const Rate& rate) {
  return 0.5 * (rate.greatest - rate.least);
}

// Pilot and study together, beside independent slides with the same interval.
TEST(Strata, TheSameIntervalTakesAThirdOfTheSlides) {
  constexpr std::int64_t kPilot = 2048;
  const StrataPlan plan = plan_for(distributions(), pilot_of(kPilot, 1), 0.005);
  const double half_width = half_width_of(rate_of(stratified(plan.strata, plan.slides, 1)));
  EXPECT_NEAR(half_width, 0.005, 0.001);
  std::int64_t plain = 1000;
  const auto successes = [&] { return std::llround(true_rate() * static_cast<double>(plain)); };
  while (half_width_of(success_rate(successes(), plain)) > half_width)
    plain += 100;
  EXPECT_LE(3 * (kPilot + plan.slides), plain) << kPilot << " and " << plan.slides;
}

TEST(Strata, ALargerPilotMakesNoWiderInterval) {
  constexpr double kHalfWidth = 0.02;
  for (const std::int64_t pilot : {64, 512, 4096}) {
    const StrataPlan plan = plan_for(distributions(), pilot_of(pilot, 1), kHalfWidth);
    const Rate rate = rate_of(stratified(plan.strata, plan.slides, 1));
    EXPECT_LE(half_width_of(rate), 1.3 * kHalfWidth) << pilot << ": " << plan.slides;
  }
}

}  // namespace
}  // namespace glissade::study
