#pragma once

/// Obstacles that overlap a part at its start, and the ways of its depenetration.

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>

#include "search/candidate_pairs.h"

namespace glissade::haptics {

/// A way out of an obstacle, from the present pose of the part.
struct WayOut {
  BodyPair bodies;
  Eigen::Vector3d n_W;  ///< unit
  double depth;         ///< metres along n_W until both are a margin apart
};

/// The pairs of an obstacle and a part that overlapped at the start and are not yet a margin apart. Not thread-safe.
class Overlaps {
 public:
  /// The scene must outlive this object.
  explicit Overlaps(const ContactScene& scene) : scene_(scene) {}

  void add(const BodyPair& pair) { pairs_.push_back(pair); }
  std::span<const BodyPair> pairs() const { return pairs_; }
  bool empty() const { return pairs_.empty(); }

  /// Finds the ways out from the present poses, and drops pairs that are a margin apart. Returns whether it dropped
  /// any. Cost: some hundred queries a pair.
  bool update();

  /// The ways that `update` found, the deepest overlap first.
  std::span<const WayOut> ways_out() const { return ways_out_; }
  /// The way out of the deepest overlap of a part; null if it has none.
  const WayOut* way_out_of(std::size_t part) const;

 private:
  const ContactScene& scene_;
  collision::QueryWorkspace workspace_;
  std::vector<BodyPair> pairs_;
  std::vector<WayOut> ways_out_;
};

}  // namespace glissade::haptics
