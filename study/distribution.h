#pragma once

/// The distributions of parameters.

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace glissade::study {

struct Uniform {
  double least;
  double greatest;
};

struct Normal {
  double mean;
  double deviation;  ///< standard deviation
};

struct Triangular {
  double least;
  double mode;
  double greatest;
};

/// One of several values, all equally likely.
struct OneOf {
  std::vector<std::string> names;  ///< as in the study file
  std::vector<double> numbers;     ///< their values; empty if the names are not numbers
};

/// A distribution, possibly cut off at two bounds.
struct Distribution {
  std::variant<Uniform, Normal, Triangular, OneOf> shape;
  std::optional<Uniform> within{};  ///< for `Normal` only

  /// The value below which the share `u` of all values lies, 0 < u < 1. For `OneOf`, the index of a value. Not
  /// decreasing in u.
  double quantile(double u) const;
  /// The least and the greatest value. Infinite for a normal distribution without bounds.
  Uniform bounds() const;
  const OneOf* as_one_of() const { return std::get_if<OneOf>(&shape); }
};

}  // namespace glissade::study
