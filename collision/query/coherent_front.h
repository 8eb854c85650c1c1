#pragma once

/// What a query of two trees remembers for the next query of the same two: the front where its traversal ended.
///
/// Every pair of triangles, or every one that was selected, is covered by an entry: a visit of two nodes, for the
/// children that were apart then, or of two leaves. An entry holds good until the part has moved by the least gap it
/// saw; the sum of all motions is the clock by which it expires. So a query looks again only at what has expired, and
/// first of all at the pair of triangles that answered the last one. J. Klosowski et al. (1998) begin at such a front
/// too, and visit all of it.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/query_types.h>

#include "query/dop_traversal.h"
#include "query/dop_visit.h"
#include "query/last_hit.h"
#include "query/triangle_visitor.h"

namespace glissade::collision {

/// The pair of triangles that was nearest.
struct NearestPair {
  std::uint64_t base_id;
  std::uint64_t other_id;
  std::uint32_t leaf_M;
  std::uint32_t leaf_N;
  int pair;
};

/// The front of one pair of trees. Not thread-safe.
class CoherentFront {
 public:
  /// Forgets everything.
  void clear();

  /// Shows the visitor every pair of triangles that may be within `distance` (metres), until it says stop; when any
  /// pair will do, the one that made it stop last time comes first. Returns whether it did.
  bool query(Goal goal, const DopTree& base, const DopTree& other, const QueryFrame& frame, double distance,
             DopAlignment& alignment, QueryCounters& counters, TriangleVisitor& visitor,
             const VisitSelection& selection = {});

  /// Where the last query found that the trees meet, if it did.
  const std::optional<LastHit>& last_hit() const { return last_hit_; }

  /// For queries of the gap, which begin with what answered the last one and need no front.
  std::optional<NearestPair>& nearest() { return nearest_; }

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
  double moved_ = 0.0;            ///< since the front was begun, at most, in radii of M
  bool complete_ = false;         ///< a query has gone through all entries
  std::size_t most_entries_ = 0;  ///< more, and the front is begun anew
  std::optional<LastHit> last_hit_;
  std::optional<NearestPair> nearest_;
  std::vector<Entry> entries_;
  std::vector<float> expiry_;           ///< of each entry: what `moved_` may become; padded by what never expires
  std::vector<std::uint32_t> expired_;  ///< by the clock; room for all
  std::vector<std::uint32_t> open_;     ///< entries to be looked at
};

}  // namespace glissade::collision
