#include "certificate/triangle_certificate.h"

#include <algorithm>
#include <limits>

#include <glissade/geometry/triangle_pair.h>

namespace glissade::contact {
namespace {

using geometry::TriangleDistance;
using geometry::TrianglePoints;

/// Metres by which the direction n separates the part's triangle from the obstacle's.
double gap_along(const Eigen::Vector3d& n, const geometry::TrianglePoints& obstacle,
                 const geometry::TrianglePoints& part) {
  const double obstacle_top = std::max({n.dot(obstacle[0]), n.dot(obstacle[1]), n.dot(obstacle[2])});
  const double part_bottom = std::min({n.dot(part[0]), n.dot(part[1]), n.dot(part[2])});
  return part_bottom - obstacle_top;
}

Eigen::Vector3d face_normal(const geometry::TrianglePoints& triangle) {
  return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
}

Eigen::Vector3d direction(const geometry::TriangleDistance& closest) {
  return (closest.p_b - closest.p_a).normalized();
}

/// The face normal, or common normal of two edges, that separates the triangles most.
Eigen::Vector3d sharpest_direction(const geometry::TrianglePoints& obstacle, const geometry::TrianglePoints& part) {
  Eigen::Vector3d sharpest = face_normal(obstacle);
  double widest = -std::numeric_limits<double>::infinity();
  const auto look = [&](const Eigen::Vector3d& normal) {
    if (normal.isZero(0.0)) return;  // parallel edges have no common normal
    for (const Eigen::Vector3d& n : {normal, Eigen::Vector3d(-normal)}) {
      const double gap = gap_along(n, obstacle, part);
      if (!(gap > widest)) continue;
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

bool TriangleCertificate::prove(const Eigen::Vector3d& n_hint, Eigen::Vector3d& n_start) {
  const Moment start = at(0);
  const Moment end = at(MovingBodies::kMoments);
  const Stretch whole{start, end, needed(0, MovingBodies::kMoments)};
  // The direction that separated a pair some steps ago mostly still does. On flush faces that slide over each other,
  // the closest points of neighboring triangles lie askew; a face normal separates those pairs.
  n_start = n_hint;
  if (separates(n_hint, whole)) return true;
  for (const Eigen::Vector3d& normal : {face_normal(start.obstacle), face_normal(start.part)}) {
    const Eigen::Vector3d n = normal.dot(start.part[0] - start.obstacle[0]) < 0.0 ? (-normal).eval() : normal;
    n_start = n;
    if (separates(n, whole)) return true;
  }

  ++stretches_;
  const geometry::TriangleDistance closest = geometry::triangle_distance(start.obstacle, start.part);
  // The direction between points a few nanometres apart is too ill-conditioned for triangles of a metre; normals of
  // features are not.
  n_start = closest.distance < kSharpDistance_m ? sharpest_direction(start.obstacle, start.part) : direction(closest);
  if (!(closest.distance > rounding_)) return false;  // there is no distance to keep
  if (closest.distance >
      bodies_.motion(pair_.bodies.obstacle) + bodies_.motion(pair_.bodies.part) + min_clearance_ + rounding_)
    return true;
  if (closest.distance < min_clearance_) min_clearance_ = 0.95 * closest.distance;
  return prove_stretch(0, MovingBodies::kMoments, start, closest);
}

/// `closest` are the closest points at the beginning.
bool TriangleCertificate::prove_stretch(int begin, int end, const Moment& at_begin,
                                        const geometry::TriangleDistance& closest) {
  ++stretches_;
  const Moment at_end = at(end);
  const Stretch stretch{at_begin, at_end, needed(begin, end)};
  if (closest.distance < min_clearance_) return false;
  const Eigen::Vector3d n_begin = direction(closest);
  if (separates(n_begin, stretch)) return true;

  const geometry::TriangleDistance closest_end = geometry::triangle_distance(at_end.obstacle, at_end.part);
  if (closest_end.distance < min_clearance_) return false;
  const Eigen::Vector3d n_end = direction(closest_end);
  if (separates(n_end, stretch)) return true;
  if (separates_turning(n_begin, n_end, stretch)) return true;
  if (separates((n_begin + n_end).normalized(), stretch)) return true;
  if (separates(sharpest_direction(at_begin.obstacle, at_begin.part), stretch)) return true;
  if (separates(sharpest_direction(at_end.obstacle, at_end.part), stretch)) return true;

  if (end - begin == 1) return false;
  const int middle = begin + (end - begin) / 2;
  if (!prove_stretch(begin, middle, at_begin, closest)) return false;
  const Moment at_middle = at(middle);
  return prove_stretch(middle, end, at_middle, geometry::triangle_distance(at_middle.obstacle, at_middle.part));
}

/// Whether n separates the pair by the minimum clearance on the whole stretch.
bool TriangleCertificate::separates(const Eigen::Vector3d& n, const Stretch& stretch) const {
  return gap_along(n, stretch.begin.obstacle, stretch.begin.part) >= stretch.needed &&
         gap_along(n, stretch.end.obstacle, stretch.end.part) >= stretch.needed;
}

/// The same for a direction that turns evenly from n_begin to n_end. Along it, the height of a corner on a straight
/// path is the product of two linear functions, which lies between the least and the greatest of its three Bernstein
/// coefficients.
bool TriangleCertificate::separates_turning(const Eigen::Vector3d& n_begin, const Eigen::Vector3d& n_end,
                                            const Stretch& stretch) const {
  if (gap_along(n_begin, stretch.begin.obstacle, stretch.begin.part) < stretch.needed ||
      gap_along(n_end, stretch.end.obstacle, stretch.end.part) < stretch.needed)
    return false;
  double top = -std::numeric_limits<double>::infinity();
  double bottom = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < 3; ++c) {
    top = std::max(top, n_begin.dot(stretch.end.obstacle[c]) + n_end.dot(stretch.begin.obstacle[c]));
    bottom = std::min(bottom, n_begin.dot(stretch.end.part[c]) + n_end.dot(stretch.begin.part[c]));
  }
  return 0.5 * (bottom - top) >= stretch.needed;
}

TriangleCertificate::Moment TriangleCertificate::at(int moment) {
  return {bodies_.triangle_W(pair_.bodies.obstacle, pair_.obstacle_triangle, moment),
          bodies_.triangle_W(pair_.bodies.part, pair_.part_triangle, moment)};
}

double TriangleCertificate::needed(int begin, int end) const {
  return min_clearance_ + bodies_.curvature(pair_.bodies.obstacle, begin, end) +
         bodies_.curvature(pair_.bodies.part, begin, end) + rounding_;
}

}  // namespace glissade::contact
