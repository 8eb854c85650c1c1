#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>

#include <glissade/collision/dop_query.h>
#include <glissade/collision/triangle_distance.h>
#include <glissade/collision/triangle_intersection.h>

#include "dop_traversal.h"

namespace glissade::collision {

QueryWorkspace::QueryWorkspace() : memory_(std::make_unique<Memory>()) {}
QueryWorkspace::~QueryWorkspace() = default;
QueryWorkspace::QueryWorkspace(QueryWorkspace&&) noexcept = default;
QueryWorkspace& QueryWorkspace::operator=(QueryWorkspace&&) noexcept = default;

const QueryCounters& QueryWorkspace::counters() const {
  return memory_->counters;
}

namespace {

int least_gap(const TriangleGaps& gaps, PairMask pairs) {
  int least = std::countr_zero(pairs);
  for (PairMask rest = pairs & (pairs - 1); rest != 0; rest &= rest - 1) {
    const int i = std::countr_zero(rest);
    if (gaps.gap[static_cast<std::size_t>(i)] < gaps.gap[static_cast<std::size_t>(least)]) least = i;
  }
  return least;
}

// Calls visit(pair, corners of A, corners of B in A) for every pair of triangles that may be within `distance`, until
// it returns true. Returns whether it did.
template <Goal kGoal, typename Visit>
bool visit_near_triangles(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                          QueryWorkspace& workspace, const Visit& visit) {
  QueryWorkspace::Memory& memory = workspace.memory();
  memory.counters = {};
  const QueryFrame frame(tree_A, tree_B, X_AB);
  if (frame.spheres_apart(distance)) return false;
  const DopTree& base = frame.base_is_A ? tree_A : tree_B;
  const DopTree& other = frame.base_is_A ? tree_B : tree_A;
  const DopVisit step(base, other, frame, distance, memory.alignment);
  return traverse<kGoal>(
      base, other, step, memory,
      [&](std::uint32_t leaf_P, std::uint32_t leaf_Q, PairMask near, const TriangleGaps& gaps) {
        while (near != 0) {
          // Those that cross deepest are the most likely to intersect.
          const int i = kGoal == Goal::kAnyPair ? least_gap(gaps, near) : std::countr_zero(near);
          near &= ~(1U << i);
          const std::int32_t triangle_P = base.leaves()[leaf_P].triangle[static_cast<std::size_t>(i / kWidth)];
          const std::int32_t triangle_Q = other.leaves()[leaf_Q].triangle[static_cast<std::size_t>(i % kWidth)];
          const TrianglePair pair =
              frame.base_is_A ? TrianglePair{triangle_P, triangle_Q} : TrianglePair{triangle_Q, triangle_P};
          const auto corner_A = [&](int c) { return tree_A.mesh().corner(pair.triangle_A, c); };
          const auto corner_B = [&](int c) { return X_AB * tree_B.mesh().corner(pair.triangle_B, c); };
          if (visit(pair, {corner_A(0), corner_A(1), corner_A(2)}, {corner_B(0), corner_B(1), corner_B(2)}))
            return true;
        }
        return false;
      });
}

bool near(const TrianglePoints& a, const TrianglePoints& b, double tolerance) {
  return tolerance > 0.0 ? triangle_distance(a, b).distance <= tolerance : triangles_intersect(a, b);
}

}  // namespace

bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, QueryWorkspace& workspace,
                double tolerance) {
  return visit_near_triangles<Goal::kAnyPair>(
      tree_A, tree_B, X_AB, tolerance, workspace,
      [&](const TrianglePair&, const TrianglePoints& a, const TrianglePoints& b) { return near(a, b, tolerance); });
}

bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                CoherentWorkspace& workspace, double tolerance) {
  return intersects(tree_A, tree_B, X_AB, workspace.workspace(), tolerance);
}

void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        QueryWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance) {
  pairs.clear();
  visit_near_triangles<Goal::kEveryPair>(
      tree_A, tree_B, X_AB, tolerance, workspace,
      [&](const TrianglePair& pair, const TrianglePoints& a, const TrianglePoints& b) {
        if (near(a, b, tolerance)) pairs.push_back(pair);
        return false;
      });
  std::sort(pairs.begin(), pairs.end());
}

void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        CoherentWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance) {
  intersecting_pairs(tree_A, tree_B, X_AB, workspace.workspace(), pairs, tolerance);
}

void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  QueryWorkspace& workspace, std::vector<ClosePair>& pairs) {
  pairs.clear();
  visit_near_triangles<Goal::kEveryPair>(
      tree_A, tree_B, X_AB, distance, workspace,
      [&](const TrianglePair& pair, const TrianglePoints& a, const TrianglePoints& b) {
        const TriangleDistance closest = triangle_distance(a, b);
        if (closest.distance <= distance) {
          pairs.push_back({pair, closest.distance, closest.p_a, closest.p_b});
        }
        return false;
      });
  std::sort(pairs.begin(), pairs.end(),
            [](const ClosePair& u, const ClosePair& v) { return u.triangles < v.triangles; });
}

void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  CoherentWorkspace& workspace, std::vector<ClosePair>& pairs) {
  pairs_within(tree_A, tree_B, X_AB, distance, workspace.workspace(), pairs);
}

}  // namespace glissade::collision
