#pragma once

/// The triangle pairs that parts could reach soon, kept over several steps: one tree query serves as long as nothing
/// has certainly moved further than the query looked.

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/haptics/proof_front.h>
#include <glissade/haptics/surroundings.h>

namespace glissade::haptics {

/// A pair of triangles as it was at the pose of the query. Bodies are numbered as in the surroundings; the obstacle may
/// be another part of lower number.
struct CandidatePair {
  std::int32_t obstacle;
  std::int32_t obstacle_triangle;
  std::int32_t part;
  std::int32_t part_triangle;
  bool has_features;    ///< either triangle answers for an edge or vertex that can stop the part
  double distance;      ///< metres, at the pose of the query
  Eigen::Vector3d n_W;  ///< unit, from the obstacle's to the part's closest point, at the pose of the query
};

/// Not thread-safe.
class CandidatePairs {
 public:
  /// The surroundings must outlive this object.
  explicit CandidatePairs(Surroundings& surroundings) : surroundings_(surroundings), front_(surroundings) {}

  /// Looks around for all pairs within `radius` (metres) of where the parts are placed, but those of bodies that are
  /// `ignored`.
  void refresh(double radius, std::span<const BodyPair> ignored);

  /// Tells that no two points of different bodies have come nearer by more than `bound` (metres) since the last call.
  void moved(double bound) { drift_ += bound; }

  /// Forgets everything: covers nothing until the next query.
  void clear() { radius_ = -1.0; }

  /// Whether every pair within `reach` of the parts' present poses is certainly among the candidates.
  bool covers(double reach) const { return reach + drift_ <= radius_; }

  /// The candidates that may be within `reach` of the parts' present poses, nearest first (by the poses of the query).
  std::span<const CandidatePair> within(double reach) const;

  /// All that may be within `reach` of the parts' present poses, triangles without features too, for proofs.
  std::span<const Obligation> obligations(double reach) const { return front_.within(reach + drift_); }

  /// Number of candidates.
  std::size_t size() const { return pairs_.size(); }

 private:
  Surroundings& surroundings_;
  std::vector<CandidatePair> pairs_;
  ProofFront front_;
  double radius_ = -1.0;
  double drift_ = 0.0;
};

}  // namespace glissade::haptics
