#pragma once

/// Stratified sampling in two phases (Neyman 1938). The slides of a pilot study show where success turns into failure.
/// The ranges of the parameters are divided into boxes, the strata. Most further slides are in the strata in which
/// success is uncertain. The success rate is the mean over the strata, weighted by their probabilities. It is unbiased,
/// because the slides of the pilot choose the strata only, and do not count.

#include <cstdint>
#include <vector>

#include <glissade/study/distribution.h>

namespace glissade::study {

/// A box of shares. A share of a parameter is that of the values which are smaller.
struct Stratum {
  std::vector<double> lower{};  ///< by parameter, from 0 to 1
  std::vector<double> upper{};
  double weight = 1.0;      ///< probability that the values of a slide lie in the box
  double deviation = 0.0;   ///< standard deviation of success (0 or 1), estimated by the pilot
  std::int64_t slides = 0;  ///< that the study runs in it
};

/// A slide of the pilot. The value of a parameter with `OneOf` is its index.
struct PilotSlide {
  std::vector<double> values;
  bool succeeds = false;
};

/// Divides the ranges of the parameters. A box with both outcomes, and with enough slides of the pilot, is halved
/// across the parameter whose quarters separate the outcomes best (after the recursive stratified sampling of Press and
/// Farrar 1990). O(parameters · slides · log(slides)).
std::vector<Stratum> make_strata(const std::vector<Distribution>& parameters, const std::vector<PilotSlide>& pilot);

/// The number of slides with which the interval of 95 % is expected to be this half width wide on each side.
std::int64_t slides_for(const std::vector<Stratum>& strata, double half_width);

/// The strata of the slides of a study. Immutable.
class Strata {
 public:
  /// Divides the slides in proportion to weight times deviation (Neyman 1934), with at least two slides in each
  /// stratum, in a random order. Throws std::invalid_argument if there are fewer than two slides for each stratum.
  Strata(std::vector<Stratum> strata, std::int64_t slides, std::uint64_t seed);

  const std::vector<Stratum>& all() const { return strata_; }
  /// The number of the stratum of a slide.
  std::size_t index_of(std::int64_t slide) const { return of_slides_[static_cast<std::size_t>(slide)]; }
  const Stratum& of(std::int64_t slide) const { return strata_[index_of(slide)]; }
  /// The weight of a slide in a mean over all slides. The weights have the mean 1.
  double weight_of(std::int64_t slide) const;

 private:
  std::vector<Stratum> strata_;
  std::vector<std::uint32_t> of_slides_;
};

}  // namespace glissade::study
