#include "certificate/lasting_separation.h"

#include <limits>

#include <Eigen/Geometry>

namespace glissade::haptics {
namespace {

/// A direction that serves for so many more paths is good enough.
constexpr double kEnoughPaths = 1.0;
/// Triangles that come nearer by less than this fraction of the gap on a path hardly come nearer.
constexpr double kAlmostStill = 0.05;

/// Metres by which n separates the triangles, and by which its opposite does.
struct GapsAlong {
  double along;
  double opposite;
};

GapsAlong gaps_of(const Eigen::Vector3d& n, const TrianglesAtMoment& moment) {
  const auto& [obstacle, part] = moment;
  const auto [part_bottom, part_top] = std::minmax({n.dot(part[0]), n.dot(part[1]), n.dot(part[2])});
  const auto [bottom, top] = std::minmax({n.dot(obstacle[0]), n.dot(obstacle[1]), n.dot(obstacle[2])});
  return {part_bottom - top, bottom - part_top};
}

Eigen::Vector3d normal_of_triangle(const geometry::TrianglePoints& triangle) {
  return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
}

Eigen::Vector3d centre_of(const geometry::TrianglePoints& triangle) {
  return (triangle[0] + triangle[1] + triangle[2]) / 3.0;
}

/// Keeps the best of the directions that it is shown.
class LastingSeparation {
 public:
  LastingSeparation(const TrianglesAtMoment& begin, const TrianglesAtMoment& end, double gap)
      : begin_(begin), end_(end), gap_(gap) {}

  const Separation& best() const { return best_; }
  double paths() const { return paths_; }

  /// Looks at a direction, or at its opposite if the part is there.
  void look(const Eigen::Vector3d& n) {
    const GapsAlong at_begin = gaps_of(n, begin_);
    const GapsAlong at_end = gaps_of(n, end_);
    if (at_begin.along >= at_begin.opposite) {
      look({n, at_begin.along, at_end.along});
    } else {
      look({-n, at_begin.opposite, at_end.opposite});
    }
  }

 private:
  void look(const Separation& separation) {
    const double more = separation.least() - gap_;
    // Negative where the direction does not serve for this path.
    const double paths = more < 0.0 ? more : more / std::max(separation.begin - separation.end, kAlmostStill * gap_);
    if (!(paths > paths_)) return;
    best_ = separation;
    paths_ = paths;
  }

  const TrianglesAtMoment& begin_;
  const TrianglesAtMoment& end_;
  double gap_;
  Separation best_{Eigen::Vector3d::Zero(), 0.0, -std::numeric_limits<double>::infinity()};
  double paths_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

Separation lasting_separation(const TrianglesAtMoment& begin, const TrianglesAtMoment& end, double gap) {
  LastingSeparation search(begin, end, gap);
  const Eigen::Vector3d motion =
      (centre_of(end.part) - centre_of(begin.part) - centre_of(end.obstacle) + centre_of(begin.obstacle)).normalized();
  const Eigen::Vector3d of_obstacle = normal_of_triangle(begin.obstacle);
  Eigen::Vector3d of_part = normal_of_triangle(begin.part);
  if (of_part.dot(of_obstacle) < 0.0) of_part = -of_part;
  const Eigen::Vector3d between = of_obstacle + of_part;
  for (const Eigen::Vector3d& n : {between, of_obstacle, of_part}) {
    search.look((n - n.dot(motion) * motion).normalized());
    search.look(n.normalized());
    if (search.paths() >= kEnoughPaths) return search.best();
  }
  const geometry::TriangleDistance closest = geometry::triangle_distance(begin.obstacle, begin.part);
  const Eigen::Vector3d apart = closest.p_b - closest.p_a;
  search.look((apart - apart.dot(motion) * motion).normalized());
  search.look(apart.normalized());
  return search.best();
}

}  // namespace glissade::haptics
