#pragma once

/// The triangle pairs a part could reach soon, kept over several steps: one tree query serves as long as the part has
/// certainly not moved further than the query looked.

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>
#include <glissade/haptics/contact_body.h>

namespace glissade::haptics {

/// A pair of triangles as it was at the pose of the query.
struct CandidatePair {
  std::int32_t obstacle_triangle;
  std::int32_t part_triangle;
  bool has_features;    ///< either triangle answers for an edge or vertex that can stop the part
  double distance;      ///< metres, at the pose of the query
  Eigen::Vector3d n_W;  ///< unit, from the obstacle's to the part's closest point, at the pose of the query
};

/// Not thread-safe.
class CandidatePairs {
 public:
  /// Both must outlive this object. `obstacles_W` is in world coordinates.
  CandidatePairs(const ContactBody& obstacles_W, const SlidingPart& part_V)
      : obstacles_W_(obstacles_W), part_V_(part_V) {}

  /// Queries the tree at X_WV for all pairs within `radius` (metres).
  void refresh(const Eigen::Isometry3d& X_WV, double radius);

  /// Tells that no point of the part has moved more than `bound` (metres) since the last call.
  void moved(double bound) { drift_ += bound; }

  /// Whether every pair within `reach` of the part's present pose is certainly among the candidates.
  bool covers(double reach) const { return reach + drift_ <= radius_; }

  /// The candidates that may be within `reach` of the part's present pose, nearest first (by the pose of the query).
  std::span<const CandidatePair> within(double reach) const;

  /// Number of candidates.
  std::size_t size() const { return pairs_.size(); }

  std::int64_t queries() const { return queries_; }

 private:
  const ContactBody& obstacles_W_;
  const SlidingPart& part_V_;
  std::vector<CandidatePair> pairs_;
  double radius_ = -1.0;  // covers nothing until the first query
  double drift_ = 0.0;
  std::int64_t queries_ = 0;
  collision::QueryWorkspace workspace_;
  std::vector<collision::ClosePair> close_pairs_;
};

}  // namespace glissade::haptics
