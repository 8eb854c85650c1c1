// The least distance of two trees, by branch and bound: depth first, the nearest pair of children first, as long as
// lower bounds are below the least distance found.

#include "query/mesh_distance.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include <glissade/geometry/triangle_pair.h>

#include "kernels/distance_bounds.h"
#include "kernels/round_up.h"
#include "query/placed_trees.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// With the centres farther apart than this (radii of the base), single precision would blur the bounds. Then nearly all
// pairs lie in one direction, and bounds along it are of the distance less that of the spheres.
constexpr double kFarApart = 64.0;

Matrix3d axes_from(const Vector3d& first) {
  Matrix3d axes;
  axes.col(0) = first;
  axes.col(1) = first.unitOrthogonal();
  axes.col(2) = first.cross(axes.col(1));
  return axes;
}

class DistanceSearch {
 public:
  /// `front` may be null.
  DistanceSearch(const PlacedTrees& placed, double limit, QueryMemory& memory, DistanceFront* front)
      : placed_(placed),
        frame_(placed.frame),
        memory_(memory),
        front_(front),
        step_(placed.base(), placed.other(), placed.frame, std::numeric_limits<double>::infinity(), memory.alignment,
              {}, memory.meter),
        limit_(limit),
        is_far_(frame_.p_MN.norm() > kFarApart),
        nearer_(is_far_ ? frame_.gap_of_spheres() : 0.0) {
    threshold_ = threshold_of(least_);
    const double between = frame_.p_MN.norm();
    look_along(between > 0.0 ? Vector3d(frame_.p_MN / between) : Vector3d::UnitX());
  }

  MeshDistance run() {
    begin();
    while (!memory_.promising.empty() && least_ > 0.0)
      expand_next();
    keep();
    if (least_ == 0.0) return {0.0, std::nullopt};
    if (!(least_ < limit_)) return {limit_, std::nullopt};
    return {least_, closest_};
  }

  /// Whether there is a pair nearer than the limit.
  bool any() {
    begin();
    while (!memory_.promising.empty() && !(least_ < limit_))
      expand_next();
    return least_ < limit_;
  }

 private:
  // Finds near triangles, and puts onto the stack what is not certainly farther apart than these.
  void begin() {
    memory_.promising.clear();
    if (front_ != nullptr && front_->nearest()) {
      const NearestPair last = *front_->nearest();
      compare(last.leaf_M, last.leaf_N, last.pair);
    } else {
      dive_while_nearer();
    }
    threshold_ = threshold_of(std::min(least_, limit_));
    if (least_ == 0.0) return;
    keeps_ = front_ != nullptr;
    if (front_ == nullptr || !front_->has_entries()) {
      memory_.promising.assign(1, {{0, 0, kAllPairs}, -1.0F});
      return;
    }
    front_->take_expired(static_cast<double>(threshold_), memory_.expired);
    for (const DistanceFront::Entry& entry : memory_.expired) {
      if (!entry.is_leaf) {
        memory_.promising.push_back({entry.nodes, -1.0F});
      } else {
        compare_leaves(entry.nodes.node_M, entry.nodes.node_N);
      }
    }
  }

  // Remembers what is left on the stack, and the nearest pair.
  void keep() {
    if (front_ == nullptr) return;
    for (const PromisingPair& pair : memory_.promising)
      add_entry(pair.nodes, false, pair.gap);
    front_->nearest() = nearest_;
    front_->end_search();
  }

  void add_entry(const NodePair& nodes, bool is_leaf, float gap) {
    if (keeps_) front_->add({nodes, is_leaf}, static_cast<double>(gap));
  }

  void expand_next() {
    const PromisingPair top = memory_.promising.back();
    memory_.promising.pop_back();
    if (top.gap < threshold_) {
      expand(top.nodes);
    } else {
      add_entry(top.nodes, false, top.gap);
    }
  }

  // Down to two leaves, each time along the least bound, as long as they are nearer than those before. Nearer triangles
  // give a better direction for the bounds, so that the next dive ends at still nearer ones. From a good start the
  // search opens few nodes that it need not open. Ends at once if nothing is nearer than the limit.
  void dive_while_nearer() {
    constexpr double kNearer = 0.99;
    const float limit = threshold_of(limit_);
    threshold_ = threshold_of(least_);  // triangles beyond the limit give a direction, too
    double before;
    do {
      before = least_;
      for (Descent descent{{0, 0, kAllPairs}, false, 0}; !descent.is_leaf;) {
        const NodePair nodes = descent.next;
        DistanceBounds bounds;
        find_bounds(nodes, bounds);
        const PairMask pairs = step_.pairs_of(nodes);
        int nearest = std::countr_zero(pairs);
        for (PairMask rest = pairs; rest != 0; rest &= rest - 1) {
          if (bound_of(bounds, std::countr_zero(rest)) < bound_of(bounds, nearest)) nearest = std::countr_zero(rest);
        }
        if (!(bound_of(bounds, nearest) < std::min(threshold_, limit))) return;
        descent = step_.descend(nodes, pairs, nearest);
        if (descent.is_leaf) compare_leaves(descent.next.node_M, descent.next.node_N);
      }
    } while (least_ > 0.0 && least_ < kNearer * before);
  }

  void find_bounds(const NodePair& nodes, DistanceBounds& bounds) {
    if (!has_frames_) {
      frames_[0] = box_frame(placed_.base().options().directions, frame_, Matrix3d::Identity());
      frames_[1] = box_frame(placed_.base().options().directions, frame_, frame_.R_MN);
      has_frames_ = true;
    }
    if (turned_) {
      frames_[2] = box_frame(placed_.base().options().directions, frame_, axes_from(toward_N_), nearer_);
      turned_ = false;
    }
    step_.bounds(nodes, frames_, is_far_, bounds, memory_.counters);
  }

  void expand(const NodePair& nodes) {
    DistanceBounds bounds;
    find_bounds(nodes, bounds);
    std::array<int, kWidth * kWidth> order;
    std::size_t count = 0;
    const PairMask pairs = step_.pairs_of(nodes);
    PairMask near = pairs & below_threshold(bounds.bound);
    for (PairMask rest = near; rest != 0; rest &= rest - 1) {
      const int pair = std::countr_zero(rest);
      std::size_t place = count++;  // in ascending order of the bounds
      for (; place > 0 && bound_of(bounds, order[place - 1]) > bound_of(bounds, pair); --place)
        order[place] = order[place - 1];
      order[place] = pair;
    }
    step_.prefetch(nodes, near);
    PairMask left_out = pairs & ~near;
    // Leaves are compared at once; nodes go onto the stack, the nearest on top.
    const std::size_t first = memory_.promising.size();
    for (std::size_t i = 0; i < count; ++i) {
      const int pair = order[i];
      if ((near >> pair & 1U) == 0) continue;
      const Descent descent = step_.descend(nodes, near, pair);
      near &= ~descent.including;
      if (!descent.is_leaf) {
        memory_.promising.push_back({descent.next, bound_of(bounds, pair)});
      } else if (bound_of(bounds, pair) < threshold_) {
        compare_leaves(descent.next.node_M, descent.next.node_N);
      } else {
        left_out |= descent.including;
      }
    }
    if (keeps_ && left_out != 0) add_entry({nodes.node_M, nodes.node_N, left_out}, false, least_of(bounds, left_out));
    std::reverse(memory_.promising.begin() + static_cast<std::ptrdiff_t>(first), memory_.promising.end());
  }

  static float least_of(const DistanceBounds& bounds, PairMask pairs) {
    float least = bound_of(bounds, std::countr_zero(pairs));
    for (; pairs != 0; pairs &= pairs - 1)
      least = std::min(least, bound_of(bounds, std::countr_zero(pairs)));
    return least;
  }

  static float bound_of(const DistanceBounds& bounds, int pair) { return bounds.bound[static_cast<std::size_t>(pair)]; }

  void compare_leaves(std::uint32_t leaf_M, std::uint32_t leaf_N) {
    step_.prepare(leaf_M, leaf_N, leaves_);
    const PairMask present = step_.leaves(leaves_, memory_.counters);
    if (is_far_) {  // single precision is of no use
      for (PairMask rest = present; rest != 0; rest &= rest - 1)
        compare(leaf_M, leaf_N, std::countr_zero(rest));
    } else {
      step_.along(direction_, leaves_);
      PairMask near = present & below_threshold(leaves_.gaps.gap);
      if (near != 0) near = step_.edges(leaves_, near);
      near &= below_threshold(leaves_.gaps.gap);
      while (near != 0) {
        const int nearest = nearest_of(near);
        near &= ~(1U << nearest);
        const bool is_nearer = compare(leaf_M, leaf_N, nearest);
        leaves_.gaps.gap[static_cast<std::size_t>(nearest)] = gap_of_compared();
        if (!is_nearer) continue;
        step_.along(direction_, leaves_);
        near &= below_threshold(leaves_.gaps.gap);
      }
    }
    if (present != 0) add_entry({leaf_M, leaf_N, kAllPairs}, true, gap_of(nearest_of(present)));
  }

  // Of the last compared triangles; single precision rounds up by less.
  float gap_of_compared() const {
    return static_cast<float>(compared_ / frame_.base_radius * (1.0 - 1e-6) - 4.0 * frame_.uncertainty);
  }

  // The pair of triangles with the least gap.
  int nearest_of(PairMask pairs) const {
    int nearest = std::countr_zero(pairs);
    for (PairMask rest = pairs & (pairs - 1); rest != 0; rest &= rest - 1) {
      const int pair = std::countr_zero(rest);
      if (gap_of(pair) < gap_of(nearest)) nearest = pair;
    }
    return nearest;
  }

  float gap_of(int pair) const { return leaves_.gaps.gap[static_cast<std::size_t>(pair)]; }

  // Without branches: which bounds are below can hardly be foreseen.
  PairMask below_threshold(const std::array<float, kWidth * kWidth>& bounds) const {
    PairMask below = 0;
    for (std::size_t i = 0; i < bounds.size(); ++i)
      below |= static_cast<PairMask>(bounds[i] < threshold_) << i;
    return below;
  }

  /// Whether this pair is nearer than all before.
  bool compare(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) {
    const TrianglePair triangles = placed_.triangles(leaf_M, leaf_N, pair);
    const geometry::TriangleDistance found =
        geometry::triangle_distance(placed_.points_A(triangles), placed_.points_B(triangles));
    compared_ = found.distance;
    if (found.distance > least_ || (found.distance == least_ && !(nearest_ && triangles < closest_.triangles))) {
      return false;
    }
    const bool is_nearer = found.distance < least_;
    nearest_ = NearestPair{leaf_M, leaf_N, pair};
    closest_ = {triangles, found.distance, found.p_a, found.p_b};
    if (!is_nearer) return false;
    least_ = found.distance;
    threshold_ = std::min(threshold_, threshold_of(least_));
    const Vector3d between = found.p_b - found.p_a;
    const double length = between.norm();
    if (length > 0.0 && found.distance > 0.0) {
      const Vector3d direction_A = between / length;
      look_along(frame_.base_is_A ? direction_A
                                  : Vector3d(-(placed_.X_AB.linear().transpose() * direction_A).normalized()));
    }
    return true;
  }

  // Bounds must be below this for a pair to be nearer than `distance` (metres), or as near. Bounds are rounded down,
  // and below the computed distance by more than its rounding, so that no pair as near as the nearest is lost.
  float threshold_of(double distance) const {
    const double radii = frame_.in_base_radii(distance) - nearer_;
    return round_up_to_float(std::min(radii + 4.0 * frame_.uncertainty, 1e30));
  }

  void look_along(const Vector3d& direction) {
    toward_N_ = direction;
    for (std::size_t axis = 0; axis < 3; ++axis)
      direction_[axis] = static_cast<float>(direction[static_cast<Eigen::Index>(axis)]);
    turned_ = true;
  }

  const PlacedTrees& placed_;
  const QueryFrame& frame_;
  QueryMemory& memory_;
  DistanceFront* const front_;
  DopVisit step_;
  const double limit_;  ///< metres
  const bool is_far_;
  const double nearer_;  ///< radii of the base: subtracted from all distances that are compared in single precision
  double least_ = std::numeric_limits<double>::infinity();  ///< metres
  float threshold_ = 0.0F;                                  ///< of the lower of `least_` and `limit_`
  std::array<BoxFrame, kBoxFrames> frames_;
  double compared_ = 0.0;    ///< metres: distance of the last triangles compared
  bool keeps_ = false;       ///< the front gets entries
  bool has_frames_ = false;  ///< the first two
  bool turned_ = true;       ///< the last frame is out of date
  Vector3d toward_N_;        ///< from the nearest point of M to that of N, unit, in the frame of M
  std::array<float, 3> direction_;
  VisitedLeaves leaves_;
  ClosePair closest_{};
  std::optional<NearestPair> nearest_;
};

}  // namespace

bool any_pair_within(const PlacedTrees& placed, double tolerance, QueryMemory& memory) {
  const double beyond = std::nextafter(tolerance, std::numeric_limits<double>::infinity());
  return DistanceSearch(placed, beyond, memory, nullptr).any();
}

MeshDistance least_distance(const PlacedTrees& placed, double limit, QueryMemory& memory, DistanceFront* front) {
  memory.counters = {};
  if (placed.frame.spheres_apart(limit)) return {limit, std::nullopt};
  // Far apart, bounds are of another distance.
  if (front == nullptr || placed.frame.p_MN.norm() > kFarApart)
    return DistanceSearch(placed, limit, memory, nullptr).run();
  front->follow(placed.base(), placed.other(), placed.frame);
  return DistanceSearch(placed, limit, memory, front).run();
}

}  // namespace glissade::collision
