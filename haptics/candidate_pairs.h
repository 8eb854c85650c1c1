#pragma once

/// The triangle pairs a part could reach soon, kept over several steps: one tree query serves as long as the part has
/// certainly not moved further than the query looked.

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/haptics/surroundings.h>

namespace glissade::haptics {

/// A pair of triangles as it was at the pose of the query.
struct CandidatePair {
  std::int32_t obstacle;  ///< number among the surroundings
  std::int32_t obstacle_triangle;
  std::int32_t part_triangle;
  bool has_features;    ///< either triangle answers for an edge or vertex that can stop the part
  double distance;      ///< metres, at the pose of the query
  Eigen::Vector3d n_W;  ///< unit, from the obstacle's to the part's closest point, at the pose of the query
};

/// Not thread-safe.
class CandidatePairs {
 public:
  /// Both must outlive this object.
  CandidatePairs(Surroundings& surroundings, const SlidingPart& part_V)
      : surroundings_(surroundings), part_V_(part_V) {}

  /// Looks around at X_WV for all pairs within `radius` (metres).
  void refresh(const Eigen::Isometry3d& X_WV, double radius);

  /// Tells that no point of the part has moved more than `bound` (metres) since the last call.
  void moved(double bound) { drift_ += bound; }

  /// Whether every pair within `reach` of the part's present pose is certainly among the candidates.
  bool covers(double reach) const { return reach + drift_ <= radius_; }

  /// The candidates that may be within `reach` of the part's present pose, nearest first (by the pose of the query).
  std::span<const CandidatePair> within(double reach) const;

  /// Number of candidates.
  std::size_t size() const { return pairs_.size(); }

 private:
  Surroundings& surroundings_;
  const SlidingPart& part_V_;
  std::vector<CandidatePair> pairs_;
  double radius_ = -1.0;  // covers nothing until the first query
  double drift_ = 0.0;
};

}  // namespace glissade::haptics
