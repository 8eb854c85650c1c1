#pragma once

/// The values of the parameters in each slide of a study. They depend on the study and the number of the slide only, so
/// slides can run in any order and on any machine.

#include <cstdint>
#include <memory>
#include <vector>

#include <glissade/study/study.h>

namespace glissade::study {

/// Immutable after construction, so threads may share it.
class Sampler {
 public:
  /// Memory: with `kLatinHypercube`, four bytes for each slide and parameter.
  explicit Sampler(const Study& study);

  /// The values of all parameters in the slide `number`, from 0. For `OneOf` without numbers: the index of the value.
  ///
  /// - `kRandom`: independent, from the Mersenne Twister seeded by the seed of the study and `number`.
  /// - `kLatinHypercube`: each parameter has one value in each of as many equally likely intervals as there are slides
  ///   (McKay, Beckman and Conover 1979).
  /// - `kSobol`: points of a Sobol sequence (direction numbers of Joe and Kuo) with a random digital shift.
  /// - `kStratified`: independent, each in the stratum of the slide.
  /// - `kGrid`: all combinations. The last parameter changes from slide to slide.
  std::vector<double> values(std::int64_t number) const;

 private:
  std::vector<double> random_shares(std::int64_t number) const;
  std::vector<double> sobol_shares(std::int64_t number) const;
  std::vector<double> grid_values(std::int64_t number) const;

  std::vector<Distribution> distributions_;
  std::vector<int> steps_;
  Sampling sampling_;
  std::int64_t slides_;
  std::uint64_t seed_;
  std::shared_ptr<const Strata> strata_;
  std::vector<std::vector<std::uint32_t>> hypercube_{};  // by parameter, then by slide
  std::vector<std::uint64_t> shifts_{};                  // of the Sobol sequence, by parameter
};

}  // namespace glissade::study
