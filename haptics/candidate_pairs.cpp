#include <algorithm>

#include <glissade/haptics/candidate_pairs.h>

namespace glissade::haptics {

void CandidatePairs::refresh(double radius, std::span<const BodyPair> ignored) {
  const collision::FrameResult& near = surroundings_.look_around(radius);
  pairs_.clear();
  for (std::size_t i = 0; i < near.meeting.size(); ++i) {
    const std::uint32_t a = near.meeting[i].object_A.index;
    const std::uint32_t b = near.meeting[i].object_B.index;
    const BodyPair numbers{static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)};
    if (std::find(ignored.begin(), ignored.end(), numbers) != ignored.end()) continue;
    const PlacedBody& obstacle = surroundings_.bodies()[a];
    const PlacedBody& part = surroundings_.bodies()[b];
    for (const collision::ClosePair& pair : near.close_pairs(i)) {
      const collision::TrianglePair& triangles = pair.triangles;
      const bool has_features = obstacle.body->topology.answers_for_features(triangles.triangle_A) ||
                                part.body->topology.answers_for_features(triangles.triangle_B);
      const Eigen::Vector3d n_W = obstacle.X_WB.linear() * (pair.p_B - pair.p_A).normalized();
      pairs_.push_back({numbers.obstacle, triangles.triangle_A, numbers.part, triangles.triangle_B, has_features,
                        pair.distance, n_W});
    }
  }
  std::stable_sort(pairs_.begin(), pairs_.end(),
                   [](const CandidatePair& a, const CandidatePair& b) { return a.distance < b.distance; });
  front_.refresh(radius, ignored);
  radius_ = radius;
  drift_ = 0.0;
}

std::span<const CandidatePair> CandidatePairs::within(double reach) const {
  const auto end = std::upper_bound(pairs_.begin(), pairs_.end(), reach + drift_,
                                    [](double limit, const CandidatePair& pair) { return limit < pair.distance; });
  return {pairs_.data(), static_cast<std::size_t>(end - pairs_.begin())};
}

}  // namespace glissade::haptics
