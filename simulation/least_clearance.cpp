#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/displacement.h>
#include <glissade/geometry/triangle_pair.h>
#include <glissade/simulation/least_clearance.h>

namespace glissade::simulation {
namespace {

// Poses wait for others with contacts, which may make it needless to know how far apart distant bodies are.
constexpr std::size_t kMostNoted = 8192;

// A list of pairs serves for so many steps, unless they grow; for fewer than these, it is not worth its search.
constexpr double kStepsAhead = 16.0;
constexpr double kWorthAList = 4.0;
constexpr double kLeastAhead_m = 30e-6;
// In radii of the part: how much farther than the nearest a body is looked for; how much farther than the nearest pair
// others are listed at most; and how far beside it, where two faces are parallel. Without these bounds, a list might
// hold all pairs of the two meshes.
constexpr double kFarAhead = 0.05;
constexpr double kMostAhead = 0.1;
constexpr double kMostBeside = 0.02;

// Below this distance, the direction between the closest points of two triangles is not sharp.
constexpr double kSharp_m = 1e-9;

geometry::TrianglePoints points(const geometry::TriangleMesh& mesh, std::int32_t triangle) {
  return mesh.corners(triangle);
}

/// How far a point of the part has moved at most between two poses, metres.
double motion_of(const contact::SlidingPart& part, const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  return geometry::motion_bound(geometry::displacement_between(from, to, part.p_Vref()), part.radius());
}

/// How much farther than the nearest pair, `nearest` metres away, others may be listed.
double most_ahead(const contact::SlidingPart& part, double nearest) {
  const double beside = kMostBeside * part.radius();
  return std::min(kMostAhead * part.radius(), beside * beside / (2.0 * nearest));
}

}  // namespace

LeastClearance::LeastClearance(const SceneBodies& bodies, std::size_t part)
    : part_(part),
      part_V_(*bodies.parts.at(part).part_V),
      first_moving_(bodies.obstacles.size()),
      own_number_(first_moving_ + part),
      least_(farthest()) {
  for (const contact::Obstacle& obstacle : bodies.obstacles)
    bodies_.push_back({.body_B = obstacle.body.get(), .moving_B = nullptr, .X_WB = obstacle.X_WO});
  const auto add_moving = [&](const contact::SlidingPart& body) {
    bodies_.push_back({.body_B = &body, .moving_B = &body});
  };
  for (std::size_t other = 0; other < bodies.parts.size(); ++other) {
    if (other != part) add_moving(*bodies.parts[other].part_V);
  }
  for (const contact::ScriptedPart& moving : bodies.moving)
    add_moving(*moving.part_B);
}

void LeastClearance::note(const Eigen::Isometry3d& X_WV, std::span<const Eigen::Isometry3d> moving_X_WB,
                          std::span<const contact::Contact> contacts) {
  if (moving_X_WB.size() != bodies_.size() - first_moving_) {
    throw std::invalid_argument("a least clearance needs the poses of " +
                                std::to_string(bodies_.size() - first_moving_) + " other moving bodies, not of " +
                                std::to_string(moving_X_WB.size()));
  }
  try_contacts(X_WV, moving_X_WB, contacts);
  X_WV_noted_.push_back(X_WV);
  X_WB_noted_.insert(X_WB_noted_.end(), moving_X_WB.begin(), moving_X_WB.end());
  if (X_WV_noted_.size() == kMostNoted) look_at_noted();
}

void LeastClearance::note(const Simulation& simulation) {
  const contact::MultiPartSliding& parts = simulation.engine().parts();
  std::vector<Eigen::Isometry3d> moving_X_WB;
  for (std::size_t p = 0; p < parts.part_count(); ++p) {
    if (p != part_) moving_X_WB.push_back(parts.result(p).X_WV);
  }
  note(simulation.X_WV(part_), moving_X_WB, simulation.result(part_).contacts);
}

void LeastClearance::finish() {
  look_at_noted();
}

void LeastClearance::try_contacts(const Eigen::Isometry3d& X_WV, std::span<const Eigen::Isometry3d> moving_X_WB,
                                  std::span<const contact::Contact> contacts) {
  // Not those of a hand that holds the part.
  const auto gap_of = [](const contact::Contact& contact) {
    return contact.rider < 0 ? contact.gap : std::numeric_limits<double>::infinity();
  };
  const auto nearest = std::min_element(contacts.begin(), contacts.end(),
                                        [&](const auto& a, const auto& b) { return gap_of(a) < gap_of(b); });
  if (nearest == contacts.end() || nearest->kind == contact::ContactKind::kOverlap || gap_of(*nearest) >= least_)
    return;
  // The part has a number too, and hands come last.
  const auto number = static_cast<std::size_t>(nearest->obstacle);
  const std::size_t b = number > own_number_ ? number - 1 : number;
  if (b >= bodies_.size()) return;
  const Body& body = bodies_[b];
  const Eigen::Isometry3d& X_WB = b >= first_moving_ ? moving_X_WB[b - first_moving_] : body.X_WB;
  Pair pair{{nearest->obstacle_triangle, nearest->part_triangle}, Eigen::Vector3d::Zero(), 0.0};
  take(distance_of(body, X_WB.inverse(Eigen::Isometry) * X_WV, pair),
       looked_at_ + static_cast<std::int64_t>(X_WV_noted_.size()));
}

void LeastClearance::look_at_noted() {
  const std::size_t moving = bodies_.size() - first_moving_;
  for (std::size_t i = 0; i < X_WV_noted_.size(); ++i) {
    move_to(X_WV_noted_[i], std::span(X_WB_noted_).subspan(i * moving, moving));
    for (Body& body : bodies_) {
      if (body.meets_at - body.clock < least_) look_at(body);
    }
    ++looked_at_;
  }
  X_WV_noted_.clear();
  X_WB_noted_.clear();
}

void LeastClearance::move_to(const Eigen::Isometry3d& X_WV, std::span<const Eigen::Isometry3d> moving_X_WB) {
  const bool is_first = looked_at_ == 0;
  const double part_moved = is_first ? 0.0 : motion_of(part_V_, X_WV_, X_WV);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Body& body = bodies_[b];
    body.step = part_moved;
    if (b >= first_moving_) {
      const std::size_t i = b - first_moving_;
      if (!is_first) body.step += motion_of(*body.moving_B, body.X_WB, moving_X_WB[i]);
      body.X_WB = moving_X_WB[i];
    }
    body.clock += body.step;
  }
  X_WV_ = X_WV;
}

void LeastClearance::look_at(Body& body) {
  body.X_BV = body.X_WB.inverse(Eigen::Isometry) * X_WV_;
  if (body.searched + body.distance - body.clock < least_) search(body);
  look_at_pairs(body);
}

void LeastClearance::search(Body& body) {
  const collision::DopTree& tree = body.body_B->tree;
  const auto is_fast = [&](double nearest) { return kWorthAList * body.step > most_ahead(part_V_, nearest); };
  const bool was_far = body.pairs.empty() || is_fast(least_);
  const double ahead = std::max(kStepsAhead * body.step, kLeastAhead_m);
  body.searched = body.clock;
  body.pairs.clear();
  body.pair_meets_at.clear();
  double nearest = least_;
  if (was_far) {
    ++work_.searches;
    body.distance =
        collision::distance(tree, part_V_.tree, body.X_BV, body.workspace, least_ + kFarAhead * part_V_.radius())
            .distance;
    if (body.distance > least_ + ahead) return;
    nearest = std::min(least_, body.distance);
    if (is_fast(nearest)) return take(body.distance, looked_at_);
  }
  body.distance = nearest + std::min(ahead, most_ahead(part_V_, nearest));
  find_close(body);
  work_.listed += std::ssize(close_);
  for (const collision::ClosePair& close : close_) {
    Pair& pair = body.pairs.emplace_back(Pair{close.triangles, Eigen::Vector3d::Zero(), 0.0});
    if (close.distance <= kSharp_m) continue;
    const geometry::TrianglePoints a = points(tree.mesh(), close.triangles.triangle_A);
    pair.n_B = (close.p_B - close.p_A) / close.distance;
    pair.offset = std::max({pair.n_B.dot(a[0]), pair.n_B.dot(a[1]), pair.n_B.dot(a[2])});
  }
  body.pair_meets_at.assign(body.pairs.size(), -1.0);
  if (nearest == 0.0) take(0.0, looked_at_);  // triangles may intersect where no features are near
}

void LeastClearance::find_close(Body& body) {
  ++work_.searches;
  collision::pairs_within(body.body_B->tree, part_V_.tree, body.X_BV, body.distance, body.workspace, close_,
                          {.of_A = &body.body_B->features, .of_B = &part_V_.features});
}

void LeastClearance::look_at_pairs(Body& body) {
  body.meets_at = body.searched + body.distance;
  for (std::size_t i = 0; i < body.pairs.size(); ++i) {
    double& meets_at = body.pair_meets_at[i];
    if (meets_at - body.clock < least_) {
      double distance = gap_along(body, body.pairs[i]);
      if (distance < least_) {
        distance = distance_of(body, body.X_BV, body.pairs[i]);
        take(distance, looked_at_);
      }
      meets_at = body.clock + distance;
    }
    body.meets_at = std::min(body.meets_at, meets_at);
  }
}

/// A lower bound of the distance: how far apart the triangles are along the direction in which they were before.
double LeastClearance::gap_along(const Body& body, const Pair& pair) {
  ++work_.directions;
  const Eigen::Vector3d n_V = body.X_BV.linear().transpose() * pair.n_B;
  const geometry::TriangleMesh& mesh = part_V_.tree.mesh();
  const std::int32_t triangle = pair.triangles.triangle_B;
  const double nearest = std::min(
      {n_V.dot(mesh.corner(triangle, 0)), n_V.dot(mesh.corner(triangle, 1)), n_V.dot(mesh.corner(triangle, 2))});
  return nearest + pair.n_B.dot(body.X_BV.translation()) - pair.offset;
}

double LeastClearance::distance_of(const Body& body, const Eigen::Isometry3d& X_BV, Pair& pair) {
  ++work_.triangle_distances;
  const geometry::TrianglePoints a = points(body.body_B->tree.mesh(), pair.triangles.triangle_A);
  geometry::TrianglePoints b = points(part_V_.tree.mesh(), pair.triangles.triangle_B);
  for (Eigen::Vector3d& point : b)
    point = X_BV * point;
  const geometry::TriangleDistance closest = geometry::triangle_distance(a, b);
  pair.n_B.setZero();
  pair.offset = 0.0;
  if (closest.distance > kSharp_m) {
    pair.n_B = (closest.p_b - closest.p_a) / closest.distance;
    pair.offset = std::max({pair.n_B.dot(a[0]), pair.n_B.dot(a[1]), pair.n_B.dot(a[2])});
  }
  return closest.distance;
}

void LeastClearance::take(double distance, std::int64_t pose) {
  if (!(distance < least_)) return;
  least_ = distance;
  least_at_ = pose;
}

}  // namespace glissade::simulation
