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

bool fits(const std::vector<double>& values) {
  return std::hypot(values[0], values[1]) < values[2];
}

/// The mean over the play r of the area π r² of a disc in the square of area 4.
const double kRate = std::acos(-1.0) / 12.0;

std::vector<Distribution> distributions() {
  std::vector<Distribution> result;
  for (const Parameter& parameter : pegs(Sampling::kRandom, 1, 1).parameters)
    result.push_back(parameter.distribution);
  return result;
}

std::vector<Stratum> strata_of_pilot(std::int64_t slides, std::uint64_t seed) {
  const Sampler sampler(pegs(Sampling::kSobol, slides, seed));
  std::vector<PilotSlide> pilot;
  for (std::int64_t slide = 0; slide < slides; ++slide)
    pilot.push_back({sampler.values(slide), fits(sampler.values(slide))});
  return make_strata(distributions(), pilot);
}

Study stratified(const std::vector<Stratum>& strata, std::int64_t slides, std::uint64_t seed) {
  Study study = pegs(Sampling::kStratified, slides, seed);
  study.strata = std::make_shared<const Strata>(strata, slides, seed);
  return study;
}

Rate rate_of(const Study& study) {
  const Sampler sampler(study);
  std::vector<StratumCount> counts;
  for (const Stratum& stratum : study.strata->all())
    counts.push_back({stratum.weight});
  for (std::int64_t slide = 0; slide < study.slides; ++slide) {
    StratumCount& count = counts[study.strata->index_of(slide)];
    ++count.slides;
    count.successes += fits(sampler.values(slide)) ? 1 : 0;
  }
  return stratified_rate(counts);
}

TEST(Strata, DivideTheRangesWhereSuccessTurnsIntoFailure) {
  const std::vector<Stratum> strata = strata_of_pilot(512, 1);
  EXPECT_GT(strata.size(), 20U);
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
  EXPECT_EQ(make_strata({{Uniform{0.0, 1.0}}}, std::vector<PilotSlide>(100, {{0.5}, true})).size(), 1U);
}

/// Halves across x and y have the same success rate, because success is in the middle.
TEST(Strata, SuccessInTheMiddleIsFound) {
  std::vector<PilotSlide> pilot;
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j)
      pilot.push_back({{j / 64.0, i / 64.0}, std::abs(i - 31.5) < 16.0});
  }
  const std::vector<Stratum> strata = make_strata({{Uniform{0.0, 1.0}}, {Uniform{0.0, 1.0}}}, pilot);
  ASSERT_EQ(strata.size(), 4U) << "quarters across the second parameter";
  for (const Stratum& stratum : strata)
    EXPECT_EQ(stratum.upper[0] - stratum.lower[0], 1.0);
}

TEST(Strata, MostSlidesAreWhereSuccessIsUncertain) {
  std::vector<Stratum> two(2, {{0.0}, {1.0}});
  two[0].weight = two[1].weight = 0.5;
  two[0].deviation = 0.1;
  two[1].deviation = 0.4;
  const Strata strata(two, 1004, 1);
  EXPECT_EQ(strata.all()[0].slides, 202) << "two, and a fifth of the others";
  EXPECT_EQ(strata.all()[1].slides, 802);
  double weights = 0.0;
  for (std::int64_t slide = 0; slide < 1004; ++slide)
    weights += strata.weight_of(slide);
  EXPECT_NEAR(weights, 1004.0, 1e-9);
  EXPECT_THROW(Strata(two, 3, 1), std::invalid_argument);
}

TEST(Strata, ValuesLieInTheStratumOfTheirSlide) {
  const Study study = stratified(strata_of_pilot(256, 1), 500, 1);
  const Sampler sampler(study);
  for (std::int64_t slide = 0; slide < 500; ++slide) {
    const Stratum& stratum = study.strata->of(slide);
    const double play = sampler.values(slide)[2];
    EXPECT_GT(play, stratum.lower[2]);
    EXPECT_LT(play, stratum.upper[2]);
  }
}

TEST(Strata, TheIntervalContainsTheRateOfTheClosedForm) {
  constexpr int kStudies = 400;
  int misses = 0;
  double bias = 0.0;
  for (std::uint64_t seed = 1; seed <= kStudies; ++seed) {
    const Rate rate = rate_of(stratified(strata_of_pilot(256, seed), 600, seed));
    misses += rate.least <= kRate && kRate <= rate.greatest ? 0 : 1;
    bias += (rate.share - kRate) / kStudies;
  }
  EXPECT_LE(misses, 0.05 * kStudies);
  EXPECT_NEAR(bias, 0.0, 0.002) << "three standard deviations of this mean";
}

// Pilot and study together, beside the interval of independent slides.
TEST(Strata, TheSameIntervalTakesAThirdOfTheSlides) {
  constexpr double kHalfWidth = 0.005;
  constexpr std::int64_t kPilot = 2048;
  const std::vector<Stratum> strata = strata_of_pilot(kPilot, 1);
  const std::int64_t slides = slides_for(strata, kHalfWidth);
  const Rate rate = rate_of(stratified(strata, slides, 1));
  EXPECT_LE(0.5 * (rate.greatest - rate.least), 1.1 * kHalfWidth);
  std::int64_t plain = 1000;
  for (Rate one = success_rate(1, 2); 0.5 * (one.greatest - one.least) > kHalfWidth; plain += 1000)
    one = success_rate(std::llround(kRate * static_cast<double>(plain)), plain);
  EXPECT_LE(3 * (kPilot + slides), plain) << kPilot << " and " << slides;
}

}  // namespace
}  // namespace glissade::study
