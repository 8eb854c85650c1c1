#include <algorithm>
#include <limits>

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

/// Of the face normals and the common normals of edges that which separates the triangles most.
Eigen::Vector3d sharpest_direction(const TrianglePoints& obstacle, const TrianglePoints& part) {
  Eigen::Vector3d sharpest = face_normal(obstacle);
  double widest = -std::numeric_limits<double>::infinity();
  const auto look = [&](const Eigen::Vector3d& normal) {
    for (const Eigen::Vector3d& n : {normal, Eigen::Vector3d(-normal)}) {
      const double gap = gap_along(n, obstacle, part);
      if (!(gap > widest)) continue;  // nor where parallel edges have none
      widest = gap;
      sharpest = n;
    }
  };
  look(face_normal(obstacle));
  look(face_normal(part));
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      look((obstacle[(i + 1) % 3] - obstacle[i]).cross(part[(j + 1) % 3] - part[j]).normalized());
  }
  return sharpest;
}

}  // namespace

PathCertificate::PathCertificate(const Surroundings& surroundings)
    : surroundings_(surroundings), first_part_(static_cast<std::int32_t>(surroundings.obstacles().size())) {
  for (std::size_t b = 0; b < surroundings.bodies().size(); ++b) {
    const PlacedBody& placed = surroundings.bodies()[b];
    const collision::DopTree& tree = placed.body->tree;
    if (b < surroundings.obstacles().size()) {
      reach_of_obstacles_ =
          std::max(reach_of_obstacles_, placed.X_WB.translation().norm() + tree.center().norm() + tree.radius());
    } else {
      paths_.push_back({placed.body, tree.center(), tree.radius(), {}, {}, {}});
    }
  }
}

bool PathCertificate::prove(std::span<const Displacement> displacements, std::span<const CandidatePair> pairs,
                            std::vector<UncertifiedPair>& failures) {
  failures.clear();
  rounding_ = certain_distance();
  for (std::size_t p = 0; p < paths_.size(); ++p) {
    Path& path = paths_[p];
    path.displacement = displacements[p];
    path.known.fill(false);
    path.X_WV_at[0] = surroundings_.bodies()[surroundings_.body_of_part(p)].X_WB;
    path.known[0] = true;
  }
  for (const CandidatePair& pair : pairs) {
    if (stands_still(pair)) continue;
    Eigen::Vector3d n_start;
    if (!prove_pair(pair, n_start))
      failures.push_back({pair.obstacle, pair.obstacle_triangle, pair.part, pair.part_triangle, n_start});
  }
  return failures.empty();
}

double PathCertificate::certain_distance() const {
  double reach = reach_of_obstacles_;
  for (std::size_t p = 0; p < paths_.size(); ++p) {
    const Eigen::Isometry3d& X_WV = surroundings_.bodies()[surroundings_.body_of_part(p)].X_WB;
    reach = std::max(reach, X_WV.translation().norm() + paths_[p].p_Vref.norm() + paths_[p].radius);
  }
  return 128.0 * std::numeric_limits<double>::epsilon() * reach;
}

/// Whether neither body of the pair moves.
bool PathCertificate::stands_still(const CandidatePair& pair) const {
  const auto moves = [&](std::int32_t body) {
    if (body < first_part_) return false;
    const Displacement& d = paths_[static_cast<std::size_t>(body - first_part_)].displacement;
    return !(d.v.isZero(0.0) && d.w.isZero(0.0));
  };
  return !moves(pair.obstacle) && !moves(pair.part);
}

bool PathCertificate::prove_pair(const CandidatePair& pair, Eigen::Vector3d& n_start) {
  const double floor = surroundings_.floor(pair.obstacle, pair.part);
  const Moment start = moment_of(pair, 0);
  const Moment end = moment_of(pair, kMoments);
  const Stretch whole{start, end, curvature_loss(pair, 0, kMoments)};
  // The direction found by the query still separates most pairs; of flush faces that slide over each other, where the
  // closest points of neighbouring triangles lie askew, a face normal separates the others.
  if (separates(pair.n_W, whole, floor)) return true;
  for (const Eigen::Vector3d& normal : {face_normal(start.obstacle), face_normal(start.part)}) {
    const Eigen::Vector3d n = normal.dot(start.part[0] - start.obstacle[0]) < 0.0 ? (-normal).eval() : normal;
    if (separates(n, whole, floor)) return true;
  }

  const TriangleDistance closest = collision::triangle_distance(start.obstacle, start.part);
  n_start = direction(closest);
  if (!(closest.distance > rounding_)) return false;  // nothing can be kept of no distance at all
  return prove_stretch(pair, 0, kMoments, closest.distance >= floor ? floor : 0.95 * closest.distance);
}

bool PathCertificate::prove_stretch(const CandidatePair& pair, int begin, int end, double floor) {
  const Moment at_begin = moment_of(pair, begin);
  const Moment at_end = moment_of(pair, end);
  const Stretch stretch{at_begin, at_end, curvature_loss(pair, begin, end)};
  const TriangleDistance closest_begin = collision::triangle_distance(at_begin.obstacle, at_begin.part);
  if (closest_begin.distance < floor) return false;
  const Eigen::Vector3d n_begin = direction(closest_begin);
  if (separates(n_begin, stretch, floor)) return true;

  const TriangleDistance closest_end = collision::triangle_distance(at_end.obstacle, at_end.part);
  if (closest_end.distance < floor) return false;
  const Eigen::Vector3d n_end = direction(closest_end);
  if (separates(n_end, stretch, floor)) return true;
  if (separates((n_begin + n_end).normalized(), stretch, floor)) return true;
  // Of points a few nanometres apart the direction is not sharp enough for triangles of a metre; their features' is.
  if (separates(sharpest_direction(at_begin.obstacle, at_begin.part), stretch, floor)) return true;
  if (separates(sharpest_direction(at_end.obstacle, at_end.part), stretch, floor)) return true;

  if (end - begin == 1) return false;
  const int middle = begin + (end - begin) / 2;
  return prove_stretch(pair, begin, middle, floor) && prove_stretch(pair, middle, end, floor);
}

/// Whether n separates the pair by `floor` on the whole stretch.
bool PathCertificate::separates(const Eigen::Vector3d& n, const Stretch& stretch, double floor) const {
  const double needed = floor + stretch.curvature + rounding_;
  return gap_along(n, stretch.begin.obstacle, stretch.begin.part) >= needed &&
         gap_along(n, stretch.end.obstacle, stretch.end.part) >= needed;
}

PathCertificate::Moment PathCertificate::moment_of(const CandidatePair& pair, int moment) {
  return {triangle_at(pair.obstacle, pair.obstacle_triangle, moment),
          triangle_at(pair.part, pair.part_triangle, moment)};
}

TrianglePoints PathCertificate::triangle_at(std::int32_t body, std::int32_t triangle, int moment) {
  if (body < first_part_) return surroundings_.bodies()[static_cast<std::size_t>(body)].triangle_W(triangle);
  Path& path = paths_[static_cast<std::size_t>(body - first_part_)];
  const auto m = static_cast<std::size_t>(moment);
  if (!path.known[m]) {
    const double t = static_cast<double>(moment) / kMoments;
    path.X_WV_at[m] = displaced(path.X_WV_at[0], path.p_Vref, path.displacement.scaled(t));
    path.known[m] = true;
  }
  const collision::TriangleMesh& mesh = path.body->tree.mesh();
  const Eigen::Isometry3d& X_WV = path.X_WV_at[m];
  return {X_WV * mesh.corner(triangle, 0), X_WV * mesh.corner(triangle, 1), X_WV * mesh.corner(triangle, 2)};
}

double PathCertificate::curvature_loss(const CandidatePair& pair, int begin, int end) const {
  // A point at radius ρ leaves the chord of its path by at most (second derivative) / 8 = |w|² ρ / 8.
  const auto loss = [&](std::int32_t body) {
    if (body < first_part_) return 0.0;
    const Path& path = paths_[static_cast<std::size_t>(body - first_part_)];
    const double angle = path.displacement.w.norm() * static_cast<double>(end - begin) / kMoments;
    return angle * angle * path.radius / 8.0;
  };
  return loss(pair.obstacle) + loss(pair.part);
}

}  // namespace glissade::haptics
