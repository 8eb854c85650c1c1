#include <algorithm>

#include <glissade/haptics/candidate_pairs.h>

namespace glissade::haptics {

void CandidatePairs::refresh(const Eigen::Isometry3d& X_WV, double radius) {
  collision::pairs_within(obstacles_W_.tree, part_V_.tree, X_WV, radius, workspace_, close_pairs_);
  pairs_.clear();
  for (const collision::ClosePair& pair : close_pairs_) {
    const Eigen::Vector3d n_W = (pair.p_B - pair.p_A).normalized();
    const bool has_features = obstacles_W_.topology.answers_for_features(pair.triangles.triangle_A) ||
                              part_V_.topology.answers_for_features(pair.triangles.triangle_B);
    pairs_.push_back({pair.triangles.triangle_A, pair.triangles.triangle_B, has_features, pair.distance, n_W});
  }
  std::stable_sort(pairs_.begin(), pairs_.end(),
                   [](const CandidatePair& a, const CandidatePair& b) { return a.distance < b.distance; });
  radius_ = radius;
  drift_ = 0.0;
  ++queries_;
}

std::span<const CandidatePair> CandidatePairs::within(double reach) const {
  const auto end = std::upper_bound(pairs_.begin(), pairs_.end(), reach + drift_,
                                    [](double limit, const CandidatePair& pair) { return limit < pair.distance; });
  return {pairs_.data(), static_cast<std::size_t>(end - pairs_.begin())};
}

}  // namespace glissade::haptics
