#pragma once

/// What a distance query remembers for the next one of the same two trees: the nearest pair of triangles, and where the
/// search ended.
///
/// Every pair of triangles is covered by an entry: by pairs of children of two nodes, or by two leaves. An entry holds
/// a lower bound of the distance of its triangles at the pose of its visit. The sum of all motions since is the clock.
/// A query examines the entries whose bound, less the motion since, is below the distance of the triangles that were
/// the nearest.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <glissade/collision/dop_tree.h>

#include "kernels/query_frame.h"
#include "query/dop_visit.h"

namespace glissade::collision {

/// A pair of triangles of two leaves, numbered 4 · triangle of leaf_M + triangle of leaf_N.
struct NearestPair {
  std::uint32_t leaf_M;
  std::uint32_t leaf_N;
  int pair;
};

class DistanceFront {
 public:
  struct Entry {
    NodePair nodes;  ///< two nodes, or two leaves
    bool is_leaf;
  };

  void clear() { ids_ = {}; }

  /// Advances the clock to this pose. Forgets everything of other trees; starts afresh, without entries, if too many
  /// have come.
  void follow(const DopTree& base, const DopTree& other, const QueryFrame& frame);

  /// Without entries a search begins at the roots.
  bool has_entries() const { return !entries_.empty(); }

  /// Adds an entry whose triangles are at least `gap` apart (radii of the base; may be negative).
  void add(const Entry& entry, double gap);

  /// Moves all entries whose triangles may be nearer than `distance` (radii of the base) to `open`.
  void take_expired(double distance, std::vector<Entry>& open);

  /// To be called at the end of each search.
  void end_search();

  std::optional<NearestPair>& nearest() { return nearest_; }

 private:
  std::array<std::uint64_t, 2> ids_{};  ///< of the trees
  Eigen::Matrix3d R_MN_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_MN_ = Eigen::Vector3d::Zero();
  double moved_ = 0.0;  ///< bound on the motion since the entries began, in radii of the base
  std::optional<NearestPair> nearest_;
  std::vector<Entry> entries_;
  std::vector<double> expiry_;    ///< by entry: `moved_` and gap, summed at its visit
  std::size_t most_entries_ = 0;  ///< with more entries the search starts afresh; 0: not known yet
};

}  // namespace glissade::collision
