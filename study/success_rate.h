#pragma once

/// The success rate of a study.

#include <cstdint>

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

}  // namespace glissade::study
