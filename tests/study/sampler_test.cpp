/// The values of parameters: what each way to sample promises.

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/study/sampler.h>

namespace glissade::study {
namespace {

Study study_of(Sampling sampling, std::int64_t slides, std::vector<Parameter> parameters) {
  Study study;
  study.sampling = sampling;
  study.slides = slides;
  study.parameters = std::move(parameters);
  return study;
}

Parameter parameter(Distribution distribution, int steps = 0) {
  return {.name = "p", .distribution = std::move(distribution), .steps = steps};
}

std::vector<double> column(const Sampler& sampler, std::int64_t slides, std::size_t number) {
  std::vector<double> values;
  for (std::int64_t slide = 0; slide < slides; ++slide)
    values.push_back(sampler.values(slide)[number]);
  return values;
}

constexpr std::int64_t kSlides = 1024;

class EachSampling : public testing::TestWithParam<Sampling> {};
INSTANTIATE_TEST_SUITE_P(Samplings, EachSampling,
                         testing::Values(Sampling::kRandom, Sampling::kLatinHypercube, Sampling::kSobol));

TEST_P(EachSampling, ValuesDependOnSeedAndNumberOnly) {
  Study study = study_of(GetParam(), kSlides, {parameter({Uniform{0.0, 1.0}}), parameter({Normal{0.0, 1.0}})});
  const Sampler sampler(study);
  const std::vector<double> late = sampler.values(900);
  sampler.values(3);
  EXPECT_EQ(sampler.values(900), late);
  EXPECT_EQ(Sampler(study).values(900), late);
  study.seed = 2;
  EXPECT_NE(Sampler(study).values(900), late);
}

/// The greatest distance of the empirical from the wanted distribution; by Kolmogorov, it exceeds 1.95 / √n with a
/// probability of 0.1 %, if the values are independent.
TEST_P(EachSampling, ValuesHaveTheDistribution) {
  const Sampler sampler(study_of(
      GetParam(), kSlides,
      {parameter({Uniform{2.0, 4.0}}), parameter({Normal{1.0, 0.5}}), parameter({Triangular{0.0, 1.0, 4.0}})}));
  const auto far_from = [&](std::size_t number, auto cdf) {
    std::vector<double> values = column(sampler, kSlides, number);
    std::sort(values.begin(), values.end());
    double farthest = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
      farthest = std::max(farthest, std::abs((static_cast<double>(i) + 0.5) / kSlides - cdf(values[i])));
    return farthest;
  };
  const double limit = 1.95 / std::sqrt(kSlides);
  EXPECT_LT(far_from(0, [](double x) { return (x - 2.0) / 2.0; }), limit);
  EXPECT_LT(far_from(1, [](double x) { return 0.5 * std::erfc(-(x - 1.0) / 0.5 / std::sqrt(2.0)); }), limit);
  EXPECT_LT(far_from(2, [](double x) { return x < 1.0 ? x * x / 4.0 : 1.0 - (4.0 - x) * (4.0 - x) / 12.0; }), limit);
}

TEST_P(EachSampling, ParametersAreNotCorrelated) {
  const Sampler sampler(
      study_of(GetParam(), kSlides, {parameter({Uniform{-1.0, 1.0}}), parameter({Uniform{-1.0, 1.0}})}));
  double sum = 0.0;
  for (std::int64_t slide = 0; slide < kSlides; ++slide)
    sum += sampler.values(slide)[0] * sampler.values(slide)[1];
  EXPECT_LT(std::abs(sum / kSlides * 3.0), 4.0 / std::sqrt(kSlides));
}

TEST(Sampler, LatinHypercubeHasOneValueInEachInterval) {
  const Sampler sampler(
      study_of(Sampling::kLatinHypercube, 100, {parameter({Uniform{0.0, 100.0}}), parameter({Uniform{0.0, 100.0}})}));
  for (const std::size_t number : {0U, 1U}) {
    std::set<int> intervals;
    for (const double value : column(sampler, 100, number))
      intervals.insert(static_cast<int>(value));
    EXPECT_EQ(intervals.size(), 100U);
  }
}

/// A property of Sobol sequences: of 2ⁿ points in a plane, each of 2ⁿ equal rectangles of some shapes has one.
TEST(Sampler, SobolPointsAreEvenInThePlane) {
  const Sampler sampler(
      study_of(Sampling::kSobol, 256, {parameter({Uniform{0.0, 1.0}}), parameter({Uniform{0.0, 1.0}})}));
  for (const int columns : {1, 4, 16, 64, 256}) {
    std::set<std::pair<int, int>> cells;
    for (std::int64_t slide = 0; slide < 256; ++slide) {
      const std::vector<double> values = sampler.values(slide);
      cells.emplace(static_cast<int>(values[0] * columns), static_cast<int>(values[1] * 256 / columns));
    }
    EXPECT_EQ(cells.size(), 256U) << columns << " columns";
  }
}

TEST(Sampler, GridHasAllCombinationsWithTheBounds) {
  const Sampler sampler(
      study_of(Sampling::kGrid, 6, {parameter({Uniform{1.0, 2.0}}, 3), parameter({OneOf{{"a", "b"}, {}}}, 2)}));
  std::vector<std::vector<double>> rows;
  for (std::int64_t slide = 0; slide < 6; ++slide)
    rows.push_back(sampler.values(slide));
  EXPECT_THAT(rows, testing::ElementsAre(std::vector{1.0, 0.0}, std::vector{1.0, 1.0}, std::vector{1.5, 0.0},
                                         std::vector{1.5, 1.0}, std::vector{2.0, 0.0}, std::vector{2.0, 1.0}));
}

TEST(Sampler, NumbersOfAListAreTheirOwnValues) {
  const Sampler sampler(study_of(Sampling::kRandom, 300, {parameter({OneOf{{"0.1", "7"}, {0.1, 7.0}}})}));
  const std::vector<double> values = column(sampler, 300, 0);
  EXPECT_NEAR(static_cast<double>(std::count(values.begin(), values.end(), 7.0)), 150.0, 40.0);
  EXPECT_EQ(std::count(values.begin(), values.end(), 7.0) + std::count(values.begin(), values.end(), 0.1), 300);
}

TEST(Sampler, BoundsOfANormalDistributionCutItsTails) {
  const Distribution cut{Normal{0.0, 1.0}, Uniform{-0.5, 2.0}};
  EXPECT_NEAR(cut.quantile(1e-12), -0.5, 1e-9);
  EXPECT_NEAR(cut.quantile(1.0 - 1e-12), 2.0, 1e-9);
  // Half of Φ(2) − Φ(−0.5) lies below: Φ⁻¹(0.64289) = 0.36621.
  EXPECT_NEAR(cut.quantile(0.5), 0.36621, 1e-4);
}

}  // namespace
}  // namespace glissade::study
