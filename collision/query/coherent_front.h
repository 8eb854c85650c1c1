#pragma once

/// The front where the traversal of a query ended, kept for the next query of the same two trees.
///
/// Every triangle pair, or every selected one, is covered by an entry. An entry is a visit of two nodes, which covers
/// the pairs of children that were apart then, or a visit of two leaves. It stays valid until the relative motion of
/// the trees exceeds the least gap that the visit found; the sum of all motions is the clock by which entries expire. A
/// query examines the triangle pair that answered the last one, then the expired entries, and nothing else. J.
/// Klosowski et al. (1998) also begin at such a front, but visit all of it.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/query_types.h>

#include "query/distance_front.h"
#include "query/dop_traversal.h"
#include "query/dop_visit.h"
#include "query/last_hit.h"
#include "query/triangle_visitor.h"

namespace glissade::collision {

/// The front of one pair of trees. Not thread-safe.
class CoherentFront {
 public:
  /// Forgets everything.
  void clear();

  /// Passes to the visitor every triangle pair that may be within `distance` (metres), until the visitor stops. For
  /// Goal::kAnyPair, the pair at which it stopped last time comes first. Returns whether the visitor stopped.
  bool query(Goal goal, const DopTree& base, const DopTree& other, const QueryFrame& frame, double distance,
             DopAlignment& alignment, QueryCounters& counters, TriangleVisitor& visitor,
             const VisitSelection& selection = {}, WorkMeter* meter = nullptr);

  /// The triangle pair at which the last query stopped, if it did.
  const std::optional<LastHit>& last_hit() const { return last_hit_; }

  /// The memory of distance queries.
  DistanceFront& of_distance() { return of_distance_; }

 private:
  struct Entry {
    NodePair pair;    ///< two nodes, or two leaves
    PairMask opened;  ///< pairs of children that have entries of their own
    std::uint32_t parent;
    bool is_leaf;
  };
  void follow(const DopTree& base, const DopTree& other, const QueryFrame& frame, const VisitSelection& selection);
  void start_afresh(const DopTree& base, const DopTree& other);
  void add(const NodePair& pair, bool is_leaf, std::size_t parent);
  void take_last_hit(std::size_t entry, int pair);
  void holds_for(std::size_t entry, double gap);
  void visit_nodes(std::size_t entry, DopVisit& step, QueryCounters& counters);
  bool visit_leaves(std::size_t entry, const QueryFrame& frame, DopVisit& step, VisitedLeaves& leaves,
                    QueryCounters& counters, TriangleVisitor& visitor);

  std::uint64_t base_id_ = 0;
  std::uint64_t other_id_ = 0;
  std::array<std::uint64_t, 2> selection_ids_{};
  Eigen::Matrix3d R_MN_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_MN_ = Eigen::Vector3d::Zero();
  double moved_ = 0.0;            ///< bound on the motion since the front began, in radii of M
  bool complete_ = false;         ///< a query has visited all entries
  std::size_t most_entries_ = 0;  ///< with more entries the front starts afresh
  std::optional<LastHit> last_hit_;
  DistanceFront of_distance_;
  std::vector<Entry> entries_;
  std::vector<float> expiry_;  ///< by entry: the greatest `moved_` for which it is valid; padding never expires
  std::vector<std::uint32_t> expired_;  ///< entries that the clock has passed; has room for all
  std::vector<std::uint32_t> open_;     ///< entries to visit
};

}  // namespace glissade::collision
