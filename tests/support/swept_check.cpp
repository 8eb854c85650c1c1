#include "swept_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include <glissade/geometry/triangle_pair.h>

namespace glissade::test_support {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TrianglePoints;

namespace {

constexpr int kMostHalvings = 40;
constexpr double kRounding = 1e-14;

bool has_area(const geometry::TrianglePoints& t) {
  return !geometry::is_degenerate(t);
}

double lowest(const Vector3d& n, const geometry::TrianglePoints& t) {
  return std::min({n.dot(t[0]), n.dot(t[1]), n.dot(t[2])});
}

double highest(const Vector3d& n, const geometry::TrianglePoints& t) {
  return std::max({n.dot(t[0]), n.dot(t[1]), n.dot(t[2])});
}

// The separating axis of two triangles with the widest gap, a unit vector from obstacle to part; zero if there is none.
// Candidates: both face normals, cross products of all pairs of edges, and the edge normals in the plane of each
// triangle.
Vector3d widest_gap(const geometry::TrianglePoints& part, const geometry::TrianglePoints& obstacle) {
  Vector3d best = Vector3d::Zero();
  double best_gap = 0.0;
  const auto try_axis = [&](const Vector3d& axis) {
    const double length = axis.norm();
    if (!(length > 0.0)) return;
    for (const double sign : {1.0, -1.0}) {
      const Vector3d n = sign / length * axis;
      const double gap = lowest(n, part) - highest(n, obstacle);
      if (gap > best_gap) best_gap = gap, best = n;
    }
  };
  std::array<Vector3d, 3> e;
  std::array<Vector3d, 3> f;
  for (std::size_t i = 0; i < 3; ++i) {
    e[i] = (part[(i + 1) % 3] - part[i]).normalized();
    f[i] = (obstacle[(i + 1) % 3] - obstacle[i]).normalized();
  }
  const Vector3d n_part = e[0].cross(e[1]);
  const Vector3d n_obstacle = f[0].cross(f[1]);
  try_axis(n_part);
  try_axis(n_obstacle);
  for (std::size_t i = 0; i < 3; ++i) {
    try_axis(n_part.cross(e[i]));
    try_axis(n_obstacle.cross(f[i]));
    for (std::size_t j = 0; j < 3; ++j)
      try_axis(e[i].cross(f[j]));
  }
  return best;
}

}  // namespace

// A motion of the part, and the deviation of its corners from the chords of their paths.
struct SweptCheck::Motion {
  Isometry3d X_WV;
  Vector3d p_W;
  Vector3d v;
  Vector3d axis;
  double angle;

  geometry::TrianglePoints at(double t, const geometry::TrianglePoints& triangle_V) const {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(t * angle, axis).toRotationMatrix();
    geometry::TrianglePoints points;
    for (std::size_t i = 0; i < 3; ++i)
      points[i] = p_W + t * v + R * (X_WV * triangle_V[i] - p_W);
    return points;
  }

  double bend(const geometry::TrianglePoints& triangle_V, double duration) const {
    double radius = 0.0;
    for (const Vector3d& x_V : triangle_V)
      radius = std::max(radius, (X_WV * x_V - p_W).norm());
    return duration * duration * angle * angle * radius / 8.0;
  }

  // Whether the pair is apart at all times from t0 to t1: along one direction, at both ends, by more than the deviation
  // of the path from its chord; otherwise both halves must be.
  bool apart(const geometry::TrianglePoints& triangle_V, const geometry::TrianglePoints& obstacle, double t0, double t1,
             int halvings) const {
    const double middle = 0.5 * (t0 + t1);
    const Vector3d n = widest_gap(at(middle, triangle_V), obstacle);
    if (n.isZero()) return false;  // they meet there
    const double magnitude = obstacle[0].cwiseAbs().maxCoeff() + v.cwiseAbs().maxCoeff() + p_W.cwiseAbs().maxCoeff();
    const double needed = highest(n, obstacle) + bend(triangle_V, t1 - t0) + kRounding * magnitude;
    if (lowest(n, at(t0, triangle_V)) > needed && lowest(n, at(t1, triangle_V)) > needed) return true;
    if (halvings == kMostHalvings) return false;
    return apart(triangle_V, obstacle, t0, middle, halvings + 1) &&
           apart(triangle_V, obstacle, middle, t1, halvings + 1);
  }
};

SweptCheck::SweptCheck(const std::vector<contact::Obstacle>& obstacles, const geometry::TriangleMesh& part_V,
                       const Vector3d& p_Vref)
    : p_Vref_(p_Vref) {
  for (const contact::Obstacle& obstacle : obstacles) {
    const geometry::TriangleMesh& mesh = obstacle.body->tree.mesh();
    for (std::int32_t i = 0; i < std::ssize(mesh.triangles); ++i) {
      if (!has_area(mesh.corners(i))) continue;
      const geometry::TrianglePoints points{obstacle.X_WO * mesh.corner(i, 0), obstacle.X_WO * mesh.corner(i, 1),
                                            obstacle.X_WO * mesh.corner(i, 2)};
      obstacles_W_.push_back({points, box_of(points, 0.0)});
    }
  }
  for (std::int32_t i = 0; i < std::ssize(part_V.triangles); ++i) {
    const geometry::TrianglePoints points = part_V.corners(i);
    if (has_area(points)) part_V_.push_back(points);
  }
}

SweptCheck::Box SweptCheck::box_of(const geometry::TrianglePoints& points, double margin) {
  return {points[0].cwiseMin(points[1]).cwiseMin(points[2]).array() - margin,
          points[0].cwiseMax(points[1]).cwiseMax(points[2]).array() + margin};
}

// Selects the triangles of the obstacles that meet the box of all placed triangles.
void SweptCheck::select_obstacles(const Box& box) {
  selected_.clear();
  for (const BoxedTriangle& obstacle : obstacles_W_) {
    if (obstacle.box.meets(box)) selected_.push_back(&obstacle);
  }
}

std::optional<std::string> SweptCheck::fault_of(const Isometry3d& X_WV, const geometry::Displacement& d) {
  const double angle = d.w.norm();
  const Motion motion{X_WV, X_WV * p_Vref_, d.v, angle > 0.0 ? Vector3d(d.w / angle) : Vector3d::UnitX(), angle};
  placed_.clear();
  Box all{Eigen::Array3d::Constant(std::numeric_limits<double>::infinity()),
          Eigen::Array3d::Constant(-std::numeric_limits<double>::infinity())};
  for (const geometry::TrianglePoints& triangle_V : part_V_) {
    const double bend = motion.bend(triangle_V, 1.0);
    const geometry::TrianglePoints first = motion.at(0.0, triangle_V);
    const Box from = box_of(first, bend);
    const Box to = box_of(motion.at(1.0, triangle_V), bend);
    placed_.push_back({first, {from.low.min(to.low), from.high.max(to.high)}});
    all = {all.low.min(placed_.back().box.low), all.high.max(placed_.back().box.high)};
  }
  select_obstacles(all);
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    for (const BoxedTriangle* obstacle : selected_) {
      if (!obstacle->box.meets(placed_[i].box) || motion.apart(part_V_[i], obstacle->points, 0.0, 1.0, 0)) continue;
      char text[200];
      std::snprintf(text, sizeof text,
                    "triangle %zu of the part is not proved apart from triangle %td of the obstacles: distance %.3g m "
                    "at the start, %.3g m at the end",
                    i, obstacle - obstacles_W_.data(),
                    geometry::triangle_distance(obstacle->points, placed_[i].points).distance,
                    geometry::triangle_distance(obstacle->points, motion.at(1.0, part_V_[i])).distance);
      return text;
    }
  }
  return std::nullopt;
}

template <typename Visit>
void SweptCheck::traverse_near(const Isometry3d& X_WV, double limit, const Visit& visit) {
  placed_.clear();
  Box all{Eigen::Array3d::Constant(std::numeric_limits<double>::infinity()),
          Eigen::Array3d::Constant(-std::numeric_limits<double>::infinity())};
  for (const geometry::TrianglePoints& t : part_V_) {
    const geometry::TrianglePoints points{X_WV * t[0], X_WV * t[1], X_WV * t[2]};
    placed_.push_back({points, box_of(points, limit)});
    all = {all.low.min(placed_.back().box.low), all.high.max(placed_.back().box.high)};
  }
  select_obstacles(all);
  for (const BoxedTriangle& placed : placed_) {
    for (const BoxedTriangle* obstacle : selected_) {
      if (!obstacle->box.meets(placed.box)) continue;
      const geometry::TriangleDistance d = geometry::triangle_distance(obstacle->points, placed.points);
      if (d.distance <= limit && !visit(d)) return;
    }
  }
}

const std::vector<SweptCheck::NearPair>& SweptCheck::near_pairs(const Isometry3d& X_WV, double limit,
                                                                std::size_t most) {
  near_.clear();
  traverse_near(X_WV, limit, [&](const geometry::TriangleDistance& d) {
    near_.push_back({d.distance, d.p_b, d.p_a});
    return near_.size() < most;
  });
  return near_;
}

double SweptCheck::distance(const Isometry3d& X_WV, double limit) {
  double least = limit;
  traverse_near(X_WV, limit, [&](const geometry::TriangleDistance& d) {
    least = std::min(least, d.distance);
    return true;
  });
  return least;
}

}  // namespace glissade::test_support
