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

}  // namespace glissade::study
