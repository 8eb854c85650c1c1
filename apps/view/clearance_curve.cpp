#include <algorithm>
#include <limits>
#include <utility>

#include <glissade/apps/view/clearance_curve.h>
#include <glissade/collision/dop_query.h>
#include <glissade/geometry/triangle_pair.h>

namespace glissade::apps {

namespace {

constexpr std::int64_t kMoments = 500;  // at most

}  // namespace

ClearanceCurve::ClearanceCurve(const HapticScene& scene, std::int64_t poses, std::size_t part)
    : part_V_(*scene.parts[part].part_V),
      first_moving_(scene.obstacles.size()),
      own_number_(scene.obstacles.size() + part),
      every_(std::max<std::int64_t>(1, (poses + kMoments - 1) / kMoments)) {
  for (const contact::Obstacle& obstacle : scene.obstacles)
    bodies_.push_back({.body_B = obstacle.body.get(), .X_WB = obstacle.X_WO});
  for (std::size_t other = 0; other < scene.parts.size(); ++other) {
    if (other != part)
      bodies_.push_back({.body_B = scene.parts[other].part_V.get(), .X_WB = Eigen::Isometry3d::Identity()});
  }
  for (const contact::ScriptedPart& moving : scene.moving)
    bodies_.push_back({.body_B = moving.part_B.get(), .X_WB = Eigen::Isometry3d::Identity()});
}

void ClearanceCurve::note(std::chrono::nanoseconds time, const Eigen::Isometry3d& X_WV,
                          std::span<const Eigen::Isometry3d> moving_X_WB, std::span<const contact::Contact> contacts) {
  if (noted_++ % every_ != 0) return;
  for (std::size_t b = first_moving_; b < bodies_.size(); ++b)
    bodies_[b].X_WB = moving_X_WB[b - first_moving_];
  double least = kFarthest_m;
  const auto limit_by = [&](const Pair& pair) { least = std::min(least, distance_of(pair, X_WV)); };
  const auto contact =
      std::min_element(contacts.begin(), contacts.end(), [](const auto& a, const auto& b) { return a.gap < b.gap; });
  if (contact != contacts.end() && contact->kind != contact::ContactKind::kOverlap) limit_by(pair_of(*contact));
  // What was nearest is still near, and the lower the limit, the sooner a search ends.
  if (nearest_) limit_by(*nearest_);
  const std::size_t first = nearest_ ? nearest_->body : 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    least = distance_to((first + i) % bodies_.size(), X_WV, least);
  series_.x.push_back(std::chrono::duration<double>(time).count());
  series_.y.push_back(least < kFarthest_m ? 1e6 * least : std::numeric_limits<double>::quiet_NaN());
}

ClearanceCurve::Pair ClearanceCurve::pair_of(const contact::Contact& contact) const {
  // The part has a number too.
  const auto number = static_cast<std::size_t>(contact.obstacle);
  return {number > own_number_ ? number - 1 : number, {contact.obstacle_triangle, contact.part_triangle}};
}

double ClearanceCurve::distance_of(const Pair& pair, const Eigen::Isometry3d& X_WV) const {
  const Body& body = bodies_[pair.body];
  const Eigen::Isometry3d X_BV = body.X_WB.inverse(Eigen::Isometry) * X_WV;
  const auto points = [](const geometry::TriangleMesh& mesh, std::int32_t triangle) -> geometry::TrianglePoints {
    return mesh.corners(triangle);
  };
  const geometry::TrianglePoints of_body = points(body.body_B->tree.mesh(), pair.triangles.triangle_A);
  geometry::TrianglePoints of_part = points(part_V_.tree.mesh(), pair.triangles.triangle_B);
  for (Eigen::Vector3d& point : of_part)
    point = X_BV * point;
  return geometry::triangle_distance(of_body, of_part).distance;
}

/// The distance of a body if it is less than `limit`, or else `limit`.
double ClearanceCurve::distance_to(std::size_t b, const Eigen::Isometry3d& X_WV, double limit) {
  const Body& body = bodies_[b];
  const collision::DopTree& tree = body.body_B->tree;
  const Eigen::Isometry3d X_BV = body.X_WB.inverse(Eigen::Isometry) * X_WV;
  // A list of the few pairs just within the limit is found sooner than a distance, most of all between parallel faces,
  // of which thousands of triangles are nearly as near as the nearest.
  constexpr double kFew_m = 50e-6;
  double of_all = limit;
  if (limit > kFew_m) {
    const double nearer = limit - kFew_m;
    const double found = collision::distance(tree, part_V_.tree, X_BV, workspace_, nearer).distance;
    if (found < nearer) of_all = found;
  }
  // Nearly always, the features are as near as the triangles. They are not where the part may overlap the body.
  constexpr double kRounding_m = 1e-9;
  constexpr double kFirst_m = 1e-5;
  for (double within = of_all + kRounding_m;; within = std::max(2.0 * within, kFirst_m)) {
    within = std::min(within, limit);
    collision::pairs_within(tree, part_V_.tree, X_BV, within, workspace_, close_,
                            {.of_A = &body.body_B->features, .of_B = &part_V_.features});
    double least = limit;
    for (const collision::ClosePair& pair : close_) {
      if (!(pair.distance < least)) continue;
      least = pair.distance;
      nearest_ = Pair{b, pair.triangles};
    }
    if (!close_.empty() || within >= limit) return least;
  }
}

Plot clearance_plot() {
  return {"Clearance of the visible parts, up to 2 mm", kTimeLabel, "clearance [um]", {}};
}

PlotSeries ClearanceCurve::take(std::string name) {
  series_.name = std::move(name);
  return std::move(series_);
}

}  // namespace glissade::apps
