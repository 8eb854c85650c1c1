#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/triangular.hpp>

#include <glissade/study/distribution.h>

namespace glissade::study {
namespace {

double quantile_of(const Uniform& shape, double u) {
  return shape.least + u * (shape.greatest - shape.least);
}

double quantile_of(const Normal& shape, double u, const std::optional<Uniform>& within) {
  const boost::math::normal normal(shape.mean, shape.deviation);
  if (!within) return boost::math::quantile(normal, u);
  const double below = boost::math::cdf(normal, within->least);
  const double inside = boost::math::cdf(normal, within->greatest) - below;
  return std::clamp(boost::math::quantile(normal, below + u * inside), within->least, within->greatest);
}

double quantile_of(const Triangular& shape, double u) {
  return boost::math::quantile(boost::math::triangular(shape.least, shape.mode, shape.greatest), u);
}

double quantile_of(const OneOf& shape, double u) {
  const auto count = static_cast<double>(shape.names.size());
  return std::min(std::floor(u * count), count - 1.0);
}

}  // namespace

double Distribution::quantile(double u) const {
  if (const auto* normal = std::get_if<Normal>(&shape)) return quantile_of(*normal, u, within);
  if (const auto* triangular = std::get_if<Triangular>(&shape)) return quantile_of(*triangular, u);
  if (const auto* one_of = std::get_if<OneOf>(&shape)) return quantile_of(*one_of, u);
  return quantile_of(std::get<Uniform>(shape), u);
}

Uniform Distribution::bounds() const {
  if (within) return *within;
  if (const auto* uniform = std::get_if<Uniform>(&shape)) return *uniform;
  if (const auto* triangular = std::get_if<Triangular>(&shape)) return {triangular->least, triangular->greatest};
  if (const auto* one_of = std::get_if<OneOf>(&shape)) return {0.0, static_cast<double>(one_of->names.size() - 1)};
  return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}

}  // namespace glissade::study
