#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include <glissade/study/strata.h>
#include <glissade/study/success_rate.h>

#include "sampling/random_numbers.h"

namespace glissade::study {
namespace {

constexpr std::size_t kLeastPilotSlides = 4;  // of each half
constexpr std::int64_t kLeastSlides = 2;      // of a stratum

using Slides = std::vector<const PilotSlide*>;

double deviation_of(const Slides& slides) {
  const auto successes = std::count_if(slides.begin(), slides.end(), [](const auto* slide) { return slide->succeeds; });
  return success_deviation(successes, static_cast<std::int64_t>(slides.size()));
}

/// Divides boxes until they need it no more.
class Divider {
 public:
  explicit Divider(const std::vector<Distribution>& parameters) : parameters_(parameters) {}

  void divide(Stratum box, const Slides& slides, std::vector<Stratum>& strata) const {
    box.deviation = deviation_of(slides);
    const auto successes = std::count_if(slides.begin(), slides.end(), [](const auto* one) { return one->succeeds; });
    const bool is_mixed = successes > 0 && successes < static_cast<std::ptrdiff_t>(slides.size());
    const std::size_t best = is_mixed ? best_parameter(box, slides) : parameters_.size();
    if (best == parameters_.size()) {
      strata.push_back(std::move(box));
      return;
    }
    const double middle = 0.5 * (box.lower[best] + box.upper[best]);
    const std::array<Slides, 2> halves = split(slides, best, middle);
    Stratum below = box;
    Stratum above = std::move(box);
    below.weight = above.weight = 0.5 * below.weight;
    below.upper[best] = above.lower[best] = middle;
    divide(std::move(below), halves[0], strata);
    divide(std::move(above), halves[1], strata);
  }

 private:
  std::array<Slides, 2> split(const Slides& slides, std::size_t parameter, double share) const {
    const double value = parameters_[parameter].quantile(share);
    std::array<Slides, 2> halves;
    for (const PilotSlide* slide : slides)
      halves[slide->values[parameter] < value ? 0 : 1].push_back(slide);
    return halves;
  }

  /// The parameter whose quarters have the least deviation together; their number if none can be halved. By halves, one
  /// would not see a success in the middle.
  std::size_t best_parameter(const Stratum& box, const Slides& slides) const {
    std::size_t best = parameters_.size();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < parameters_.size(); ++p) {
      const double lower = box.lower[p];
      const double quarter = 0.25 * (box.upper[p] - lower);
      const std::array<Slides, 2> halves = split(slides, p, lower + 2.0 * quarter);
      if (std::min(halves[0].size(), halves[1].size()) < kLeastPilotSlides) continue;
      double sum = 0.0;
      for (std::size_t half = 0; half < 2; ++half) {
        for (const Slides& part : split(halves[half], p, lower + (half == 0 ? 1.0 : 3.0) * quarter))
          sum += deviation_of(part);
      }
      if (sum < least) {
        least = sum;
        best = p;
      }
    }
    return best;
  }

  const std::vector<Distribution>& parameters_;
};

double sum_of_deviations(const std::vector<Stratum>& strata) {
  return std::accumulate(strata.begin(), strata.end(), 0.0,
                         [](double sum, const Stratum& one) { return sum + one.weight * one.deviation; });
}

}  // namespace

std::vector<Stratum> make_strata(const std::vector<Distribution>& parameters, const std::vector<PilotSlide>& pilot) {
  Slides slides;
  for (const PilotSlide& slide : pilot)
    slides.push_back(&slide);
  Stratum whole;
  whole.lower.assign(parameters.size(), 0.0);
  whole.upper.assign(parameters.size(), 1.0);
  std::vector<Stratum> strata;
  Divider(parameters).divide(std::move(whole), slides, strata);
  return strata;
}

std::int64_t slides_for(const std::vector<Stratum>& strata, double half_width) {
  const double root = kNormalQuantile_95 * sum_of_deviations(strata) / half_width;
  return std::max(static_cast<std::int64_t>(std::ceil(root * root)),
                  kLeastSlides * static_cast<std::int64_t>(strata.size()));
}

Strata::Strata(std::vector<Stratum> strata, std::int64_t slides, std::uint64_t seed) : strata_(std::move(strata)) {
  const auto least = kLeastSlides * static_cast<std::int64_t>(strata_.size());
  if (slides < least) {
    throw std::invalid_argument("the pilot gives " + std::to_string(strata_.size()) + " strata, which need at least " +
                                std::to_string(least) + " slides");
  }
  const double sum = sum_of_deviations(strata_);
  // By the sums of the shares, so that no slide is lost by rounding.
  double share = 0.0;
  std::int64_t given = 0;
  for (Stratum& stratum : strata_) {
    share += stratum.weight * stratum.deviation / sum;
    const auto end = static_cast<std::int64_t>(std::llround(share * static_cast<double>(slides - least)));
    stratum.slides = kLeastSlides + end - std::exchange(given, end);
  }
  for (std::size_t s = 0; s < strata_.size(); ++s)
    of_slides_.insert(of_slides_.end(), static_cast<std::size_t>(strata_[s].slides), static_cast<std::uint32_t>(s));
  shuffle(of_slides_, generator_of(seed, kStrataStream));
}

double Strata::weight_of(std::int64_t slide) const {
  const Stratum& stratum = of(slide);
  return stratum.weight * static_cast<double>(of_slides_.size()) / static_cast<double>(stratum.slides);
}

}  // namespace glissade::study
