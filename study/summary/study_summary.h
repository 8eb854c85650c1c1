#pragma once

/// What the rows of a study say together: on what success depends, where parts jam, and which slides are worst.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <glissade/study/study.h>
#include <glissade/study/success_rate.h>

namespace glissade::study {

/// Memory: some 100 bytes for each slide.
class StudySummary {
 public:
  explicit StudySummary(const Study& study);

  /// Adds a row, as `json_of` made it. Slides may be missing.
  void add(const nlohmann::json& row);

  std::int64_t rows() const { return static_cast<std::int64_t>(success_.size()); }
  std::int64_t successes() const;
  std::int64_t problems() const { return problems_; }

  /// The first slide, by number, of each outcome but success. Slides that could not be run are left out.
  std::vector<std::int64_t> first_failures() const;

  /// The success rate, if each stratum has slides.
  std::optional<Rate> rate() const;

  /// The numbers of study.json, see docs/studies.md.
  nlohmann::ordered_json to_json() const;

 private:
  /// Slides whose values of a parameter are equal or next to each other.
  struct Bin {
    std::string values{};
    std::int64_t slides = 0;
    double weight = 0.0;
    double success_weight = 0.0;
  };
  struct Jam {
    std::int64_t slide = 0;
    Eigen::Vector3d p_W;
    std::string objects;
  };

  std::vector<StratumCount> counts() const;
  std::vector<double> weights() const;
  std::vector<Bin> bins(std::size_t parameter, const std::vector<double>& weights) const;
  nlohmann::ordered_json sensitivity(std::size_t parameter, double mean, const std::vector<double>& weights) const;
  nlohmann::ordered_json jams() const;
  std::vector<std::int64_t> worst() const;

  const Study& study_;
  double jam_distance_m_ = 0.0;
  std::vector<std::vector<double>> values_{};           // by parameter, then by row
  std::vector<std::map<std::string, double>> names_{};  // by parameter: numbers of values that are texts
  std::vector<std::int64_t> slides_{};                  // by row
  std::vector<bool> success_{};
  std::vector<double> forces_{};  // not a number if unknown
  std::map<std::string, std::int64_t> outcomes_{};
  std::map<std::string, std::int64_t> first_failures_{};  // by outcome
  std::vector<Jam> jams_{};
  std::int64_t problems_ = 0;
};

}  // namespace glissade::study
