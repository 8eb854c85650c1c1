#include <algorithm>

#include <glissade/collision/triangle_distance.h>
#include <glissade/haptics/path_certificate.h>

namespace glissade::haptics {
namespace {

using collision::TriangleDistance;
using collision::TrianglePoints;

/// By how much the direction n separates the part's triangle from the obstacle's.
double gap_along(const Eigen::Vector3d& n, const TrianglePoints& obstacle, const TrianglePoints& part) {
  const double obstacle_top = std::max({n.dot(obstacle[0]), n.dot(obstacle[1]), n.dot(obstacle[2])});
  const double part_bottom = std::min({n.dot(part[0]), n.dot(part[1]), n.dot(part[2])});
  return part_bottom - obstacle_top;
}

Eigen::Vector3d face_normal(const TrianglePoints& triangle) {
  return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
}

Eigen::Vector3d direction(const TriangleDistance& closest) {
  return (closest.p_b - closest.p_a).normalized();
}

}  // namespace

PathCertificate::PathCertificate(std::span<const Obstacle> obstacles, const SlidingPart& part_V, double floor)
    : obstacles_(obstacles), part_V_(part_V), floor_(floor) {
  double reach = 0.0;
  for (const Obstacle& obstacle : obstacles) {
    const collision::DopTree& tree = obstacle.body->tree;
    reach = std::max(reach, obstacle.X_WO.translation().norm() + tree.center().norm() + tree.radius());
  }
  rounding_ =
      64.0 * std::numeric_limits<double>::epsilon() * (reach + part_V.tree.center().norm() + part_V.tree.radius());
}

bool PathCertificate::prove(const Eigen::Isometry3d& X_WV, const Displacement& d, std::span<const CandidatePair> pairs,
                            std::vector<UncertifiedPair>& failures) {
  failures.clear();
  X_WV_start_ = X_WV;
  displacement_ = d;
  known_.fill(false);
  for (const CandidatePair& pair : pairs) {
    Eigen::Vector3d n_start;
    if (!prove_pair(pair, n_start))
      failures.push_back({pair.obstacle, pair.obstacle_triangle, pair.part_triangle, n_start});
  }
  return failures.empty();
}

bool PathCertificate::prove_pair(const CandidatePair& pair, Eigen::Vector3d& n_start) {
  obstacle_ = obstacles_[static_cast<std::size_t>(pair.obstacle)].triangle_W(pair.obstacle_triangle);
  const TrianglePoints part_start = part_triangle_at(pair.part_triangle, 0);
  const TrianglePoints part_end = part_triangle_at(pair.part_triangle, kMoments);
  // The direction found by the query still separates most pairs; of flush faces that slide over each other, where the
  // closest points of neighbouring triangles lie askew, a face normal separates the others.
  const double curvature = curvature_loss(0, kMoments);
  if (separates(pair.n_W, part_start, part_end, curvature, floor_)) return true;
  for (const Eigen::Vector3d& normal : {face_normal(obstacle_), face_normal(part_start)}) {
    const Eigen::Vector3d n = normal.dot(part_start[0] - obstacle_[0]) < 0.0 ? (-normal).eval() : normal;
    if (separates(n, part_start, part_end, curvature, floor_)) return true;
  }

  const TriangleDistance closest = collision::triangle_distance(obstacle_, part_start);
  n_start = direction(closest);
  if (!(closest.distance > rounding_)) return false;  // nothing can be kept of no distance at all
  return prove_stretch(pair, 0, kMoments, std::min(floor_, 0.95 * closest.distance));
}

bool PathCertificate::prove_stretch(const CandidatePair& pair, int begin, int end, double floor) {
  const TrianglePoints part_begin = part_triangle_at(pair.part_triangle, begin);
  const TrianglePoints part_end = part_triangle_at(pair.part_triangle, end);
  const double curvature = curvature_loss(begin, end);
  const TriangleDistance at_begin = collision::triangle_distance(obstacle_, part_begin);
  if (at_begin.distance < floor) return false;
  const Eigen::Vector3d n_begin = direction(at_begin);
  if (separates(n_begin, part_begin, part_end, curvature, floor)) return true;

  const TriangleDistance at_end = collision::triangle_distance(obstacle_, part_end);
  if (at_end.distance < floor) return false;
  const Eigen::Vector3d n_end = direction(at_end);
  if (separates(n_end, part_begin, part_end, curvature, floor)) return true;
  if (separates((n_begin + n_end).normalized(), part_begin, part_end, curvature, floor)) return true;

  if (end - begin == 1) return false;
  const int middle = begin + (end - begin) / 2;
  return prove_stretch(pair, begin, middle, floor) && prove_stretch(pair, middle, end, floor);
}

bool PathCertificate::separates(const Eigen::Vector3d& n, const TrianglePoints& part_begin,
                                const TrianglePoints& part_end, double curvature, double floor) const {
  const double needed = floor + curvature + rounding_;
  return gap_along(n, obstacle_, part_begin) >= needed && gap_along(n, obstacle_, part_end) >= needed;
}

collision::TrianglePoints PathCertificate::part_triangle_at(std::int32_t triangle, int moment) {
  const auto m = static_cast<std::size_t>(moment);
  if (!known_[m]) {
    const double t = static_cast<double>(moment) / kMoments;
    X_WV_at_[m] = moment == 0 ? X_WV_start_ : displaced(X_WV_start_, part_V_.p_Vref(), displacement_.scaled(t));
    known_[m] = true;
  }
  const auto& mesh = part_V_.tree.mesh();
  return {X_WV_at_[m] * mesh.corner(triangle, 0), X_WV_at_[m] * mesh.corner(triangle, 1),
          X_WV_at_[m] * mesh.corner(triangle, 2)};
}

double PathCertificate::curvature_loss(int begin, int end) const {
  // A point at radius ρ leaves the chord of its path by at most (second derivative) / 8 = |w|² ρ / 8.
  const double angle = displacement_.w.norm() * static_cast<double>(end - begin) / kMoments;
  return angle * angle * part_V_.radius() / 8.0;
}

}  // namespace glissade::haptics
