#pragma once

/// Runs the slides of a study.

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <glissade/contact/sliding.h>
#include <glissade/study/sampler.h>
#include <glissade/study/slide_row.h>
#include <glissade/study/study.h>

namespace glissade::study {

/// Called after each millisecond of a slide, first for the start.
using SlideWatch = std::function<void(std::chrono::nanoseconds time, const contact::Sliding& sliding)>;

/// Deterministic: a row depends on the study and its number only. Thread-safe.
class SlideRunner {
 public:
  /// Builds the trees of all meshes that do not change continuously. Throws std::invalid_argument, naming the object,
  /// if an object cannot be simulated. `study` must outlive this object.
  explicit SlideRunner(const Study& study);

  /// Runs the slide `number`, from 0. A slide that is impossible, for example because the part starts inside an object,
  /// gives a row with a `problem`. Throws std::out_of_range for a number that the study does not have.
  SlideRow run(std::int64_t number, const SlideWatch& watch = {}) const;

  /// The scene of a slide, with the values of its parameters. Throws std::out_of_range as `run`, and
  /// std::invalid_argument, naming the object, if the values are impossible.
  simulation::Scene scene(std::int64_t number) const;

  /// The row of a slide that could not be run, for example because its process crashed.
  SlideRow not_run(std::int64_t number, const std::string& problem) const;

  /// `SlideRow::input_hash` of the slide.
  std::uint64_t hash(std::int64_t number) const { return input_hash(study_hash_, sampler_.values(number)); }

 private:
  std::vector<double> values(std::int64_t number) const;
  SlideMeasures slide(const std::vector<double>& values, const SlideWatch& watch) const;
  std::string outcome_of(const SlideMeasures& measures) const;

  const Study& study_;
  Sampler sampler_;
  std::vector<simulation::SceneBodies> known_;  // of the scene, and of the scene with each mesh that may be chosen
  std::uint64_t study_hash_;
};

}  // namespace glissade::study
