#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <boost/math/distributions/binomial.hpp>

#include <glissade/study/success_rate.h>

namespace glissade::study {

Rate success_rate(std::int64_t successes, std::int64_t slides) {
  if (slides < 1 || successes < 0 || successes > slides)
    throw std::invalid_argument("a success rate needs 0 ≤ successes ≤ slides, and slides > 0");
  constexpr double kTail = 0.025;  // on each side of the interval
  using boost::math::binomial;
  const auto n = static_cast<double>(slides);
  const auto k = static_cast<double>(successes);
  return {k / n, binomial::find_lower_bound_on_p(n, k, kTail), binomial::find_upper_bound_on_p(n, k, kTail)};
}

double success_deviation(std::int64_t successes, std::int64_t slides) {
  const double rate = static_cast<double>(successes + 1) / static_cast<double>(slides + 2);
  return std::sqrt(rate * (1.0 - rate));
}

Rate stratified_rate(const std::vector<StratumCount>& strata) {
  double share = 0.0;
  double variance = 0.0;
  for (const StratumCount& stratum : strata) {
    const auto n = static_cast<double>(stratum.slides);
    const double deviation = stratum.weight * success_deviation(stratum.successes, stratum.slides);
    share += stratum.weight * static_cast<double>(stratum.successes) / n;
    variance += deviation * deviation / n;
  }
  const double half_width = kNormalQuantile_95 * std::sqrt(variance);
  return {share, std::max(0.0, share - half_width), std::min(1.0, share + half_width)};
}

}  // namespace glissade::study
