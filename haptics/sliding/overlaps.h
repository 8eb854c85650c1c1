#pragma once

/// Obstacles that overlap a part at its start, and how it is led out of them.

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>

#include "search/candidate_pairs.h"

namespace glissade::haptics {

/// A way out of one of them, from where the part is now.
struct WayOut {
  BodyPair bodies;
  Eigen::Vector3d n_W;  ///< unit
  double depth;         ///< metres to go along it until the part is a margin away
};

/// The pairs of an obstacle and a part that overlapped at the start and are not free of each other yet. Not
/// thread-safe.
class Overlaps {
 public:
  /// The scene must outlive this object.
  explicit Overlaps(const ContactScene& scene) : scene_(scene) {}

  void add(const BodyPair& pair) { pairs_.push_back(pair); }
  std::span<const BodyPair> pairs() const { return pairs_; }
  bool empty() const { return pairs_.empty(); }

  /// Looks for the ways out from where the parts are placed, and forgets pairs that are apart by their margin. Returns
  /// whether any were. Cost: some hundred queries a pair.
  bool update();

  /// As `update` found them, the deepest first.
  std::span<const WayOut> ways_out() const { return ways_out_; }
  /// The deepest of one part, null when it has none.
  const WayOut* way_out_of(std::size_t part) const;

 private:
  const ContactScene& scene_;
  collision::QueryWorkspace workspace_;
  std::vector<BodyPair> pairs_;
  std::vector<WayOut> ways_out_;
};

}  // namespace glissade::haptics
