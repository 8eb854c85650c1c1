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

/// The standard deviation of success (0 or 1) of a slide, after `successes` of `slides` slides. The success rate is
/// that of Laplace's rule of succession. So the deviation is positive also if all slides have the same outcome.
double success_deviation(double successes, std::int64_t slides);

struct StratumCount {
  double weight;  ///< probability of the stratum
  double successes = 0.0;
  std::int64_t slides = 0;
};

/// The mean of the success rates of strata, weighted by their probabilities. The interval is that of Clopper and
/// Pearson for as many independent slides as would have the variance of this mean (Korn and Graubard 1998). The
/// variance is that with `success_deviation` in each stratum. For a single stratum, the interval is that of
/// `success_rate`. Each stratum must have slides.
Rate stratified_rate(const std::vector<StratumCount>& strata);

}  // namespace glissade::study
