#pragma once

/// The success rate of a study.

#include <cstdint>
#include <vector>

namespace glissade::study {

/// A share of slides with its interval of 95 % confidence.
struct Rate {
  double share;
  double least;
  double greatest;
};

/// The exact interval of Clopper and Pearson (1934) for `successes` of `slides` independent slides. For the more even
/// samples of a Latin hypercube and of a Sobol sequence, the interval is usually wider than necessary. Throws
/// std::invalid_argument unless 0 ≤ successes ≤ slides and slides > 0.
Rate success_rate(std::int64_t successes, std::int64_t slides);

/// So many standard deviations on each side of the mean leave out 5 % of a normal distribution.
inline constexpr double kNormalQuantile_95 = 1.959963984540054;

/// The standard deviation of success (0 or 1) of a slide, after `successes` of `slides` slides, by Laplace's rule of
/// succession. So it is positive also if all slides have the same outcome.
double success_deviation(std::int64_t successes, std::int64_t slides);

struct StratumCount {
  double weight;  ///< probability of the stratum
  std::int64_t successes = 0;
  std::int64_t slides = 0;
};

/// The mean of the success rates of strata, weighted by their probabilities, with the normal interval of 95 %. The
/// deviation in each stratum is `success_deviation`. Each stratum must have slides.
Rate stratified_rate(const std::vector<StratumCount>& strata);

}  // namespace glissade::study
