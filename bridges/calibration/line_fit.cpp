#include "calibration/line_fit.h"

#include <cmath>
#include <limits>

#include <Eigen/Dense>

namespace glissade::bridges {
namespace {

std::optional<Line> line_through(const LinePoint& a, const LinePoint& b, double least_slope, double greatest_slope) {
  const double slope = (b.y - a.y) / (b.x - a.x);
  if (!(slope >= least_slope && slope <= greatest_slope)) return std::nullopt;
  return Line{.slope = slope, .offset = a.y - slope * a.x};
}

double absolute_errors(const std::vector<LinePoint>& points, const Line& line) {
  double sum = 0.0;
  for (const LinePoint& point : points)
    sum += std::abs(line.error(point)) / point.tolerance;
  return sum;
}

std::optional<Line> least_absolute_line(const std::vector<LinePoint>& points, double least_slope,
                                        double greatest_slope) {
  std::optional<Line> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = i + 1; k < points.size(); ++k) {
      const std::optional<Line> line = line_through(points[i], points[k], least_slope, greatest_slope);
      const double errors = line ? absolute_errors(points, *line) : least;
      if (errors >= least) continue;
      least = errors;
      best = line;
    }
  }
  return best;
}

}  // namespace

std::optional<Line> robust_line(const std::vector<LinePoint>& points, double least_slope, double greatest_slope) {
  const std::optional<Line> robust = least_absolute_line(points, least_slope, greatest_slope);
  if (!robust) return std::nullopt;
  std::vector<LinePoint> inliers;
  for (const LinePoint& point : points) {
    if (std::abs(robust->error(point)) <= point.tolerance) inliers.push_back(point);
  }
  Eigen::MatrixX2d A(inliers.size(), 2);
  Eigen::VectorXd b(inliers.size());
  for (std::size_t i = 0; i < inliers.size(); ++i) {
    const LinePoint& point = inliers[i];
    A.row(static_cast<Eigen::Index>(i)) << point.x / point.tolerance, 1.0 / point.tolerance;
    b[static_cast<Eigen::Index>(i)] = point.y / point.tolerance;
  }
  const Eigen::Vector2d solution = A.colPivHouseholderQr().solve(b);
  if (!(solution[0] >= least_slope && solution[0] <= greatest_slope)) return std::nullopt;
  return Line{.slope = solution[0], .offset = solution[1]};
}

}  // namespace glissade::bridges
