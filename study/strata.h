#pragma once

/// Stratified sampling. The slides of a pilot study show where success turns into failure. The ranges of the parameters
/// are divided into boxes, the strata. Most further slides are in the strata in which success is uncertain (Neyman
/// 1934). The success rate is the mean over the strata, weighted by their probabilities. It is unbiased, because the
/// slides of the pilot choose the strata only, and do not count.

#include <cstdint>
#include <vector>

#include <glissade/study/distribution.h>

namespace glissade::study {

/// A box of shares. A share of a parameter is that of the values which are smaller.
struct Stratum {
  std::vector<double> lower{};  ///< by parameter, from 0 to 1
  std::vector<double> upper{};
  double weight = 1.0;            ///< probability that the values of a slide lie in the box
  std::int64_t pilot_slides = 0;  ///< slides of the pilot in the box
  std::int64_t pilot_successes = 0;
  std::int64_t slides = 0;  ///< that the study runs in it
};

/// A slide of the pilot. The value of a parameter with `OneOf` is its index.
struct PilotSlide {
  std::vector<double> values;
  bool succeeds = false;
};

/// Divides the ranges of the parameters into at most `most` boxes. Again and again, the box with the greatest product
/// of weight and deviation of success is halved across the parameter whose quarters separate the outcomes best (after
/// the recursive stratified sampling of Press and Farrar 1990). A box with one outcome only stays whole, as does one
/// with too few slides of the pilot. O(parameters · slides · most).
std::vector<Stratum> make_strata(const std::vector<Distribution>& parameters, const std::vector<PilotSlide>& pilot,
                                 std::size_t most);

/// At most so many strata suit a study of this many slides: with fewer slides in each, the interval is wider.
std::size_t most_strata(std::int64_t slides);

/// A number of strata, and of slides in them all, with which the interval of 95 % is expected to have this half width.
struct StrataPlan {
  std::vector<Stratum> strata{};
  std::int64_t slides = 0;
};
/// The plan with the fewest slides.
StrataPlan plan_for(const std::vector<Distribution>& parameters, const std::vector<PilotSlide>& pilot,
                    double half_width);

/// The strata of the slides of a study. Immutable. Memory: four bytes for each slide.
class Strata {
 public:
  /// Divides the slides in proportion to weight times deviation of success in the pilot (Neyman 1934), with at least
  /// two slides in each stratum, in a random order. `seed` is also that of the values. Throws std::invalid_argument if
  /// there are fewer than two slides for each stratum.
  Strata(std::vector<Stratum> strata, std::int64_t slides, std::uint64_t seed);

  const std::vector<Stratum>& all() const { return strata_; }
  std::uint64_t seed() const { return seed_; }
  /// The number of the stratum of a slide of the study.
  std::size_t index_of(std::int64_t slide) const { return of_slides_[static_cast<std::size_t>(slide)]; }
  const Stratum& of(std::int64_t slide) const { return strata_[index_of(slide)]; }
  /// The weight of a slide in a mean over all slides. The weights have the mean 1.
  double weight_of(std::int64_t slide) const;

 private:
  std::vector<Stratum> strata_;
  std::uint64_t seed_;
  std::vector<std::uint32_t> of_slides_;
};

}  // namespace glissade::study
