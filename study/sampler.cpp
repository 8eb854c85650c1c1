#include <numeric>

#include <boost/random/sobol.hpp>

#include <glissade/study/sampler.h>

#include "sampling/random_numbers.h"

namespace glissade::study {
namespace {

double on_grid(const Distribution& distribution, std::int64_t step, int steps) {
  if (distribution.as_one_of() != nullptr) return static_cast<double>(step);
  const Uniform bounds = distribution.bounds();
  if (steps == 1) return 0.5 * (bounds.least + bounds.greatest);
  const double share = static_cast<double>(step) / (steps - 1);
  return (1.0 - share) * bounds.least + share * bounds.greatest;
}

}  // namespace

Sampler::Sampler(const Study& study)
    : sampling_(study.sampling), slides_(study.slides), seed_(study.seed), strata_(study.strata) {
  std::mt19937_64 shift = generator_of(seed_, kShiftStream);
  for (std::size_t p = 0; p < study.parameters.size(); ++p) {
    distributions_.push_back(study.parameters[p].distribution);
    steps_.push_back(study.parameters[p].steps);
    shifts_.push_back(shift());
    if (sampling_ != Sampling::kLatinHypercube) continue;
    std::vector<std::uint32_t>& numbers = hypercube_.emplace_back(static_cast<std::size_t>(slides_));
    std::iota(numbers.begin(), numbers.end(), 0U);
    shuffle(numbers, generator_of(seed_, kFirstHypercubeStream + p));
  }
}

std::vector<double> Sampler::values(std::int64_t number) const {
  std::vector<double> values;
  if (sampling_ == Sampling::kGrid) {
    values = grid_values(number);
  } else {
    values = sampling_ == Sampling::kSobol ? sobol_shares(number) : random_shares(number);
    for (std::size_t p = 0; p < values.size(); ++p)
      values[p] = distributions_[p].quantile(values[p]);
  }
  for (std::size_t p = 0; p < values.size(); ++p) {
    const OneOf* one_of = distributions_[p].as_one_of();
    if (one_of != nullptr && !one_of->numbers.empty()) values[p] = one_of->numbers[static_cast<std::size_t>(values[p])];
  }
  return values;
}

std::vector<double> Sampler::random_shares(std::int64_t number) const {
  const auto stream = static_cast<std::uint64_t>(number);
  std::mt19937_64 generator =
      strata_ != nullptr ? generator_of(strata_->seed(), kFirstStratifiedStream + stream) : generator_of(seed_, stream);
  std::vector<double> shares;
  for (std::size_t p = 0; p < distributions_.size(); ++p) {
    const double share = share_of(generator());
    if (strata_ != nullptr) {
      const Stratum& stratum = strata_->of(number);
      shares.push_back(stratum.lower[p] + share * (stratum.upper[p] - stratum.lower[p]));
    } else if (!hypercube_.empty()) {
      shares.push_back((hypercube_[p][static_cast<std::size_t>(number)] + share) / static_cast<double>(slides_));
    } else {
      shares.push_back(share);
    }
  }
  return shares;
}

std::vector<double> Sampler::sobol_shares(std::int64_t number) const {
  boost::random::sobol sequence(distributions_.size());
  // The engine leaves out the first point, the origin. Without it, the points are less even (Owen 2020).
  if (number > 0) sequence.discard(static_cast<std::uint64_t>(number - 1) * distributions_.size());
  std::vector<double> shares;
  for (const std::uint64_t shift : shifts_)
    shares.push_back(share_of((number > 0 ? sequence() : 0) ^ shift));
  return shares;
}

std::vector<double> Sampler::grid_values(std::int64_t number) const {
  std::vector<double> values(distributions_.size());
  for (std::size_t p = values.size(); p-- > 0;) {
    values[p] = on_grid(distributions_[p], number % steps_[p], steps_[p]);
    number /= steps_[p];
  }
  return values;
}

}  // namespace glissade::study
