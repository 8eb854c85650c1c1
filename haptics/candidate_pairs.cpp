#include <algorithm>

#include <glissade/haptics/candidate_pairs.h>

namespace glissade::haptics {

void CandidatePairs::refresh(const Eigen::Isometry3d& X_WV, double radius) {
  const collision::FrameResult& near = surroundings_.look_around(X_WV, radius);
  pairs_.clear();
  for (std::size_t i = 0; i < near.meeting.size(); ++i) {
    const std::uint32_t number = near.meeting[i].object_A.index;
    const Obstacle& obstacle = surroundings_.obstacles()[number];
    for (const collision::ClosePair& pair : near.close_pairs(i)) {
      const Eigen::Vector3d n_W = obstacle.X_WO.linear() * (pair.p_B - pair.p_A).normalized();
      const bool has_features = obstacle.body->topology.answers_for_features(pair.triangles.triangle_A) ||
                                part_V_.topology.answers_for_features(pair.triangles.triangle_B);
      pairs_.push_back({static_cast<std::int32_t>(number), pair.triangles.triangle_A, pair.triangles.triangle_B,
                        has_features, pair.distance, n_W});
    }
  }
  std::stable_sort(pairs_.begin(), pairs_.end(),
                   [](const CandidatePair& a, const CandidatePair& b) { return a.distance < b.distance; });
  radius_ = radius;
  drift_ = 0.0;
}

std::span<const CandidatePair> CandidatePairs::within(double reach) const {
  const auto end = std::upper_bound(pairs_.begin(), pairs_.end(), reach + drift_,
                                    [](double limit, const CandidatePair& pair) { return limit < pair.distance; });
  return {pairs_.data(), static_cast<std::size_t>(end - pairs_.begin())};
}

}  // namespace glissade::haptics
