#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <boost/math/distributions/binomial.hpp>

#include <glissade/study/success_rate.h>

namespace glissade::study {

namespace {

/// The interval of Clopper and Pearson, also for counts that are no whole numbers.
Rate exact_rate(double successes, double slides) {
  constexpr double kTail = 0.025;  // on each side of the interval
  using boost::math::binomial;
  return {successes / slides, binomial::find_lower_bound_on_p(slides, successes, kTail),
          binomial::find_upper_bound_on_p(slides, successes, kTail)};
}

/// By Laplace's rule of succession.
double expected_rate(double successes, std::int64_t slides) {
  return (successes + 1.0) / static_cast<double>(slides + 2);
}

}  // namespace

Rate success_rate(std::int64_t successes, std::int64_t slides) {
  if (slides < 1 || successes < 0 || successes > slides)
    throw std::invalid_argument("a success rate needs 0 ≤ successes ≤ slides, and slides > 0");
  return exact_rate(static_cast<double>(successes), static_cast<double>(slides));
}

double success_deviation(double successes, std::int64_t slides) {
  const double rate = expected_rate(successes, slides);
  return std::sqrt(rate * (1.0 - rate));
}

Rate stratified_rate(const std::vector<StratumCount>& strata) {
  double share = 0.0;
  double expected = 0.0;
  double variance = 0.0;
  for (const StratumCount& stratum : strata) {
    const auto slides = static_cast<double>(stratum.slides);
    const double deviation = stratum.weight * success_deviation(stratum.successes, stratum.slides);
    share += stratum.weight * stratum.successes / slides;
    expected += stratum.weight * expected_rate(stratum.successes, stratum.slides);
    variance += deviation * deviation / slides;
  }
  share = std::clamp(share, 0.0, 1.0);  // from rounding
  const double independent_slides = expected * (1.0 - expected) / variance;
  return exact_rate(share * independent_slides, independent_slides);
}

}  // namespace glissade::study
