#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <glissade/collision/dop_query.h>

#include "query/dop_traversal.h"
#include "query/pair_visitors.h"
#include "query/placed_trees.h"
#include "query/workspace_access.h"

namespace glissade::collision {
namespace {

/// Passes pairs of triangles on. Those that no direction separates far enough are measured.
class TrianglesToVisitor : public PlacedVisitor {
 public:
  TrianglesToVisitor(const PlacedTrees& placed, const NearDistances& distances)
      : PlacedVisitor(placed), distances_(distances), metres_per_radius_(placed.frame.in_metres(1.0)) {}

  bool asks_for_directions() const override { return true; }
  PairMask to_measure(std::uint32_t leaf_M, std::uint32_t leaf_N, PairMask pairs, const LeafPair& leaves) override {
    PairMask near = 0;
    for (PairMask rest = pairs; rest != 0; rest &= rest - 1) {
      const int pair = std::countr_zero(rest);
      const double gap = metres_per_radius_ * static_cast<double>(leaves.gaps.gap[static_cast<std::size_t>(pair)]);
      if (gap < distances_.exact_below) {
        near |= 1U << pair;
      } else {
        pass({placed_.triangles(leaf_M, leaf_N, pair), direction_A(pair, leaves), gap, separator(pair, leaves)});
      }
    }
    return near;
  }
  PairOutcome visit(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) override {
    constexpr double kNotYet = -1.0;
    if (waiting_.add(placed_.triangles(leaf_M, leaf_N, pair))) finish();
    return {false, kNotYet};
  }
  PairOutcome found(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) override {
    pass(touching(placed_.triangles(leaf_M, leaf_N, pair)));
    return {false, 0.0};
  }
  void finish() {
    for (const ClosePair& close : waiting_.measure(placed_)) {
      if (close.distance <= distances_.within) pass(measured(close));
    }
  }

 protected:
  ~TrianglesToVisitor() = default;
  virtual void pass(const NearTriangles& pair) = 0;

 private:
  Eigen::Vector3d direction_A(int pair, const LeafPair& leaves) const {
    const auto& n = leaves.directions.n;
    const auto i = static_cast<std::size_t>(pair);
    const Eigen::Vector3d n_M = Eigen::Vector3f(n[0][i], n[1][i], n[2][i]).cast<double>();
    Eigen::Vector3d n_A = n_M;
    if (!placed_.frame.base_is_A) n_A = -(placed_.X_AB.linear() * n_M);
    n_A *= 1.0 / n_A.norm();
    return n_A;
  }
  Separator separator(int pair, const LeafPair& leaves) const {
    if ((leaves.by_edges >> pair & 1U) != 0) return Separator::kOther;
    return ((leaves.by_N >> pair & 1U) != 0) == placed_.frame.base_is_A ? Separator::kPlaneOfB : Separator::kPlaneOfA;
  }
  static NearTriangles touching(const TrianglePair& triangles) {
    return {triangles, Eigen::Vector3d::Zero(), 0.0, Separator::kOther};
  }
  /// The direction between points a few nanometres apart is ill-conditioned: it separates the triangles by less than
  /// their distance, or not at all.
  NearTriangles measured(const ClosePair& close) const {
    const Eigen::Vector3d n_A = (close.p_B - close.p_A).normalized();
    const auto heights = [&](const geometry::TrianglePoints& points) {
      return std::minmax({n_A.dot(points[0]), n_A.dot(points[1]), n_A.dot(points[2])});
    };
    const double gap =
        heights(placed_.points_B(close.triangles)).first - heights(placed_.points_A(close.triangles)).second;
    if (close.distance == 0.0 || !(gap > 0.0)) return touching(close.triangles);
    return {close.triangles, n_A, gap, Separator::kOther};
  }

  NearDistances distances_;
  double metres_per_radius_;
  WaitingPairs waiting_;
};

/// Asks the visitor which pairs of children to open, and collects those that it accepts.
class NearPairs final : public TrianglesToVisitor {
 public:
  NearPairs(const PlacedTrees& placed, const NearDistances& distances, DualTreeVisitor& visitor,
            std::vector<OpenPair>& accepted)
      : TrianglesToVisitor(placed, distances), visitor_(visitor), accepted_(accepted) {}

  PairMask to_open(const NodePair& nodes, PairMask near) override {
    PairMask accepted = 0;
    for (PairMask rest = near; rest != 0; rest &= rest - 1) {
      const int pair = std::countr_zero(rest);
      const TreeChild child_M{nodes.node_M, pair / kWidth};
      const TreeChild child_N{nodes.node_N, pair % kWidth};
      const bool base_is_A = placed_.frame.base_is_A;
      if (visitor_.accepts(base_is_A ? child_M : child_N, base_is_A ? child_N : child_M)) accepted |= 1U << pair;
    }
    if (accepted != 0) accepted_.push_back({nodes, accepted, {}});
    return near & ~accepted;
  }

 private:
  void pass(const NearTriangles& pair) override { visitor_.visit(pair); }

  DualTreeVisitor& visitor_;
  std::vector<OpenPair>& accepted_;
};

class PairsBelowAccepted final : public TrianglesToVisitor {
 public:
  PairsBelowAccepted(const PlacedTrees& placed, const NearDistances& distances, DualTreeVisitor& visitor)
      : TrianglesToVisitor(placed, distances), visitor_(visitor) {}

 private:
  void pass(const NearTriangles& pair) override { visitor_.visit_below_accepted(pair); }

  DualTreeVisitor& visitor_;
};

/// Passes on the selected pairs of triangles below accepted pairs of children.
void visit_below_accepted(const PlacedTrees& placed, const NearDistances& distances, const VisitSelection& selection,
                          QueryMemory& memory, DualTreeVisitor& visitor) {
  memory.stack.clear();
  for (OpenPair& open : memory.accepted) {
    open.near &= selection.pairs_of_nodes(open.nodes.node_M, open.nodes.node_N);
    if (open.near != 0) memory.stack.push_back(open);
  }
  DopVisit step(placed.base(), placed.other(), placed.frame, distances.within, memory.alignment, selection,
                memory.meter);
  PairsBelowAccepted pairs(placed, distances, visitor);
  continue_all(step, memory, pairs, std::numeric_limits<std::int64_t>::max());
  pairs.finish();
}

}  // namespace

void traverse_near(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                   const NearDistances& distances, QueryWorkspace& workspace, DualTreeVisitor& visitor,
                   const PairSelection* below_accepted) {
  if (!(distances.exact_below >= 0.0))
    throw std::invalid_argument("the distance below which pairs are measured must not be negative");
  const PlacedTrees placed{tree_A, tree_B, X_AB, below_accepted == nullptr ? PairSelection{} : *below_accepted};
  const VisitSelection selection = placed.visit_selection();
  QueryMemory& memory = memory_of(workspace);
  memory.counters = {};
  if (placed.frame.spheres_apart(distances.within)) return;
  DopVisit step(placed.base(), placed.other(), placed.frame, distances.within, memory.alignment, {}, memory.meter);
  memory.accepted.clear();
  NearPairs pairs(placed, distances, visitor, memory.accepted);
  visit_every(step, memory, pairs);
  pairs.finish();
  const bool shows_selected = placed.selection.of_A != nullptr && placed.selection.of_B != nullptr;
  if (shows_selected) visit_below_accepted(placed, distances, selection, memory, visitor);
}

}  // namespace glissade::collision
