#include <algorithm>
#include <limits>
#include <utility>

#include <glissade/apps/commands/clearance_curve.h>
#include <glissade/collision/dop_query.h>

namespace glissade::apps {

namespace {

constexpr std::int64_t kMoments = 500;

}  // namespace

ClearanceCurve::ClearanceCurve(const HapticScene& scene, std::int64_t poses)
    : part_V_(*scene.parts.front().part_V),
      first_moving_(scene.obstacles.size()),
      every_(std::max<std::int64_t>(1, poses / kMoments)) {
  for (const haptics::Obstacle& obstacle : scene.obstacles)
    bodies_.push_back({.body_B = obstacle.body.get(), .X_WB = obstacle.X_WO});
  for (const haptics::ScriptedPart& moving : scene.moving)
    bodies_.push_back({.body_B = moving.part_B.get(), .X_WB = Eigen::Isometry3d::Identity()});
}

void ClearanceCurve::note(std::chrono::nanoseconds time, const Eigen::Isometry3d& X_WV,
                          std::span<const Eigen::Isometry3d> moving_X_WB) {
  if (noted_++ % every_ != 0) return;
  double least = kFarthest_m;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (b >= first_moving_) bodies_[b].X_WB = moving_X_WB[b - first_moving_];
    least = std::min(least, distance_to(bodies_[b], X_WV, least));
  }
  series_.x.push_back(std::chrono::duration<double>(time).count());
  series_.y.push_back(least < kFarthest_m ? 1e6 * least : std::numeric_limits<double>::quiet_NaN());
}

/// The distance if it is less than `limit`, or else `limit`.
double ClearanceCurve::distance_to(Body& body, const Eigen::Isometry3d& X_WV, double limit) {
  const collision::DopTree& tree = body.body_B->tree;
  const Eigen::Isometry3d X_BV = body.X_WB.inverse(Eigen::Isometry) * X_WV;
  const double of_all = collision::distance(tree, part_V_.tree, X_BV, body.workspace, limit).distance;
  // Nearly always, the features are as near as the triangles. They are not where the part may overlap the body.
  constexpr double kRounding_m = 1e-9;
  constexpr double kFirst_m = 1e-5;
  for (double within = of_all + kRounding_m;; within = std::max(2.0 * within, kFirst_m)) {
    within = std::min(within, limit);
    collision::pairs_within(tree, part_V_.tree, X_BV, within, body.workspace, close_,
                            {.of_A = &body.body_B->features, .of_B = &part_V_.features});
    double least = limit;
    for (const collision::ClosePair& pair : close_)
      least = std::min(least, pair.distance);
    if (!close_.empty() || within >= limit) return least;
  }
}

PlotSeries ClearanceCurve::take(std::string name) {
  series_.name = std::move(name);
  return std::move(series_);
}

}  // namespace glissade::apps
