#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <glissade/study/strata.h>
#include <glissade/study/success_rate.h>

#include "sampling/random_numbers.h"

namespace glissade::study {
namespace {

constexpr std::size_t kLeastPilotSlides = 4;       // of each half
constexpr std::int64_t kLeastSlides = 2;           // of a stratum
constexpr std::int64_t kUsualSlidesOfStratum = 8;  // on average, at least

using Slides = std::vector<const PilotSlide*>;

double deviation_of(const Stratum& stratum) {
  return success_deviation(static_cast<double>(stratum.pilot_successes), stratum.pilot_slides);
}

std::int64_t successes_of(const Slides& slides) {
  return std::count_if(slides.begin(), slides.end(), [](const PilotSlide* slide) { return slide->succeeds; });
}

/// A stratum, the slides of the pilot in it, and where to halve it.
struct Box {
  Stratum stratum;
  Slides slides;
  std::optional<std::size_t> parameter{};  // across which it can be halved

  double uncertainty() const { return stratum.weight * deviation_of(stratum); }
};

/// Divides boxes.
class Divider {
 public:
  explicit Divider(const std::vector<Distribution>& parameters) : parameters_(parameters) {}

  Box box(Stratum stratum, Slides slides) const {
    stratum.pilot_slides = static_cast<std::int64_t>(slides.size());
    stratum.pilot_successes = successes_of(slides);
    const bool is_mixed = stratum.pilot_successes > 0 && stratum.pilot_successes < stratum.pilot_slides;
    const std::optional<std::size_t> parameter = is_mixed ? best_parameter(stratum, slides) : std::nullopt;
    return {std::move(stratum), std::move(slides), parameter};
  }

  std::array<Box, 2> halves(const Box& whole) const {
    const std::size_t p = *whole.parameter;
    const double lower = whole.stratum.lower[p];
    const double upper = whole.stratum.upper[p];
    const double middle = cut(p, lower, upper, 0.5);
    Stratum below = whole.stratum;
    Stratum above = whole.stratum;
    below.upper[p] = above.lower[p] = middle;
    below.weight *= (middle - lower) / (upper - lower);
    above.weight *= (upper - middle) / (upper - lower);
    std::array<Slides, 2> parts = split(whole.slides, p, middle);
    return {box(std::move(below), std::move(parts[0])), box(std::move(above), std::move(parts[1]))};
  }

 private:
  /// The share at this fraction of a range. One of several values is never cut through.
  double cut(std::size_t parameter, double lower, double upper, double fraction) const {
    const double share = lower + fraction * (upper - lower);
    const OneOf* const one_of = parameters_[parameter].as_one_of();
    if (one_of == nullptr) return share;
    const auto count = static_cast<double>(one_of->names.size());
    return std::round(share * count) / count;
  }

  std::array<Slides, 2> split(const Slides& slides, std::size_t parameter, double share) const {
    // In the middle between two of several values: shares such as 1/3 are rounded.
    const OneOf* const one_of = parameters_[parameter].as_one_of();
    const double value = one_of != nullptr ? share * static_cast<double>(one_of->names.size()) - 0.5
                                           : parameters_[parameter].quantile(share);
    std::array<Slides, 2> parts;
    for (const PilotSlide* slide : slides)
      parts[slide->values[parameter] < value ? 0 : 1].push_back(slide);
    return parts;
  }

  /// The parameter whose quarters have the least deviation together. By halves, one would not see a success in the
  /// middle.
  std::optional<std::size_t> best_parameter(const Stratum& stratum, const Slides& slides) const {
    std::optional<std::size_t> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < parameters_.size(); ++p) {
      const double lower = stratum.lower[p];
      const double upper = stratum.upper[p];
      const double middle = cut(p, lower, upper, 0.5);
      if (middle <= lower || middle >= upper) continue;
      const std::array<Slides, 2> halves = split(slides, p, middle);
      if (std::min(halves[0].size(), halves[1].size()) < kLeastPilotSlides) continue;
      double sum = 0.0;
      for (std::size_t half = 0; half < 2; ++half) {
        for (const Slides& part : split(halves[half], p, cut(p, lower, upper, half == 0 ? 0.25 : 0.75)))
          sum += success_deviation(static_cast<double>(successes_of(part)), static_cast<std::int64_t>(part.size()));
      }
      if (sum >= least) continue;
      least = sum;
      best = p;
    }
    return best;
  }

  const std::vector<Distribution>& parameters_;
};

double uncertainty_of(const std::vector<Stratum>& strata) {
  return std::accumulate(strata.begin(), strata.end(), 0.0,
                         [](double sum, const Stratum& one) { return sum + one.weight * deviation_of(one); });
}

/// Gives each stratum its slides.
void allocate(std::vector<Stratum>& strata, std::int64_t slides) {
  const std::int64_t others = slides - kLeastSlides * static_cast<std::int64_t>(strata.size());
  const double sum = uncertainty_of(strata);
  // By the sums of the shares, so that no slide is lost by rounding.
  double share = 0.0;
  std::int64_t given = 0;
  for (Stratum& stratum : strata) {
    share += stratum.weight * deviation_of(stratum) / sum;
    const auto end = static_cast<std::int64_t>(std::llround(share * static_cast<double>(others)));
    stratum.slides = kLeastSlides + end - std::exchange(given, end);
  }
}

/// The half width that the interval has if all strata have the success rates of the pilot.
double expected_half_width(std::vector<Stratum>& strata, std::int64_t slides) {
  allocate(strata, slides);
  std::vector<StratumCount> counts;
  for (const Stratum& stratum : strata) {
    const double rate = static_cast<double>(stratum.pilot_successes) / static_cast<double>(stratum.pilot_slides);
    counts.push_back({stratum.weight, rate * static_cast<double>(stratum.slides), stratum.slides});
  }
  const Rate rate = stratified_rate(counts);
  return 0.5 * (rate.greatest - rate.least);
}

/// The least number of slides with this half width.
std::int64_t slides_for(std::vector<Stratum> strata, double half_width) {
  std::int64_t few = kUsualSlidesOfStratum * static_cast<std::int64_t>(strata.size()) - 1;
  std::int64_t many = few + 1;
  while (expected_half_width(strata, many) > half_width)
    few = std::exchange(many, 2 * many);
  while (many - few > 1) {
    const std::int64_t middle = few + (many - few) / 2;
    (expected_half_width(strata, middle) > half_width ? few : many) = middle;
  }
  return many;
}

}  // namespace

std::vector<Stratum> make_strata(const std::vector<Distribution>& parameters, const std::vector<PilotSlide>& pilot,
                                 std::size_t most) {
  const Divider divider(parameters);
  Slides slides;
  for (const PilotSlide& slide : pilot)
    slides.push_back(&slide);
  Stratum whole;
  whole.lower.assign(parameters.size(), 0.0);
  whole.upper.assign(parameters.size(), 1.0);
  std::vector<Box> boxes{divider.box(std::move(whole), std::move(slides))};
  while (boxes.size() < most) {
    const auto uncertainty = [](const Box& box) { return box.parameter ? box.uncertainty() : 0.0; };
    const auto next = std::max_element(boxes.begin(), boxes.end(),
                                       [&](const Box& a, const Box& b) { return uncertainty(a) < uncertainty(b); });
    if (!next->parameter) break;
    std::array<Box, 2> halves = divider.halves(*next);
    *next = std::move(halves[0]);
    boxes.push_back(std::move(halves[1]));
  }
  std::vector<Stratum> strata;
  for (Box& box : boxes)
    strata.push_back(std::move(box.stratum));
  return strata;
}

std::size_t most_strata(std::int64_t slides) {
  return static_cast<std::size_t>(std::max<std::int64_t>(1, slides / kUsualSlidesOfStratum));
}

StrataPlan plan_for(const std::vector<Distribution>& parameters, const std::vector<PilotSlide>& pilot,
                    double half_width) {
  StrataPlan best;
  for (std::size_t most = 1;; most *= 2) {
    std::vector<Stratum> strata = make_strata(parameters, pilot, most);
    const bool is_last = strata.size() < most;
    const std::int64_t slides = slides_for(strata, half_width);
    if (best.slides == 0 || slides < best.slides) best = {std::move(strata), slides};
    if (is_last) return best;
  }
}

Strata::Strata(std::vector<Stratum> strata, std::int64_t slides, std::uint64_t seed)
    : strata_(std::move(strata)), seed_(seed) {
  const std::int64_t least = kLeastSlides * static_cast<std::int64_t>(strata_.size());
  if (slides < least) {
    throw std::invalid_argument(std::to_string(strata_.size()) + " strata need at least " + std::to_string(least) +
                                " slides, not " + std::to_string(slides));
  }
  allocate(strata_, slides);
  for (std::size_t s = 0; s < strata_.size(); ++s)
    of_slides_.insert(of_slides_.end(), static_cast<std::size_t>(strata_[s].slides), static_cast<std::uint32_t>(s));
  shuffle(of_slides_, generator_of(seed, kStrataStream));
}

double Strata::weight_of(std::int64_t slide) const {
  const Stratum& stratum = of(slide);
  return stratum.weight * static_cast<double>(of_slides_.size()) / static_cast<double>(stratum.slides);
}

}  // namespace glissade::study
