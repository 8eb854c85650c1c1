#include <algorithm>
#include <initializer_list>
#include <numeric>
#include <random>

#include <boost/random/sobol.hpp>

#include <glissade/study/sampler.h>

namespace glissade::study {
namespace {

/// A generator for this stream of random numbers. Generator and seed sequence are defined by the standard to the bit.
std::mt19937_64 generator_of(std::uint64_t seed, std::uint64_t stream) {
  const std::initializer_list<std::uint64_t> words{seed & 0xffffffffU, seed >> 32U, stream & 0xffffffffU,
                                                   stream >> 32U};
  std::seed_seq sequence(words);
  return std::mt19937_64(sequence);
}

/// Between 0 and 1, both excluded.
double share_of(std::uint64_t bits) {
  return (static_cast<double>(bits >> 12U) + 0.5) * 0x1p-52;
}

/// A permutation of 0 … count − 1. `std::shuffle` differs between standard libraries.
std::vector<std::uint32_t> permutation(std::int64_t count, std::mt19937_64 generator) {
  std::vector<std::uint32_t> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0U);
  for (std::size_t i = numbers.size(); i > 1; --i)
    std::swap(numbers[i - 1], numbers[generator() % i]);
  return numbers;
}

double on_grid(const Distribution& distribution, std::int64_t step, int steps) {
  if (distribution.as_one_of() != nullptr) return static_cast<double>(step);
  const Uniform bounds = distribution.bounds();
  if (steps == 1) return 0.5 * (bounds.least + bounds.greatest);
  const double share = static_cast<double>(step) / (steps - 1);
  return (1.0 - share) * bounds.least + share * bounds.greatest;
}

// Streams of random numbers beside those of the slides, which have the numbers from 0.
constexpr std::uint64_t kShiftStream = ~std::uint64_t{0};
constexpr std::uint64_t kFirstStrataStream = std::uint64_t{1} << 63U;

}  // namespace

Sampler::Sampler(const Study& study) : sampling_(study.sampling), slides_(study.slides), seed_(study.seed) {
  std::mt19937_64 shift = generator_of(seed_, kShiftStream);
  for (std::size_t p = 0; p < study.parameters.size(); ++p) {
    distributions_.push_back(study.parameters[p].distribution);
    steps_.push_back(study.parameters[p].steps);
    shifts_.push_back(shift());
    if (sampling_ != Sampling::kLatinHypercube) continue;
    strata_.push_back(permutation(slides_, generator_of(seed_, kFirstStrataStream + p)));
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
  std::mt19937_64 generator = generator_of(seed_, static_cast<std::uint64_t>(number));
  std::vector<double> shares;
  for (std::size_t p = 0; p < distributions_.size(); ++p) {
    const double share = share_of(generator());
    const auto slide = static_cast<std::size_t>(number);
    shares.push_back(strata_.empty() ? share : (strata_[p][slide] + share) / static_cast<double>(slides_));
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
