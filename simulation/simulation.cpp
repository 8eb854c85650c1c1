#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <glissade/collision/dop_query.h>
#include <glissade/simulation/simulation.h>

namespace glissade::simulation {
namespace {

SceneBodies movable_bodies(const Scene& scene) {
  const std::vector<std::string> names = scene.movable_names();
  if (names.empty()) throw std::invalid_argument(scene.source + ": no object is movable; a hand needs a part to hold");
  return bodies_of(scene, names);
}

double greatest_margin(const SceneBodies& bodies, const grasping::GraspSimulation& engine, std::size_t part) {
  double margin = engine.parts().margin(part);
  for (const contact::Obstacle& obstacle : bodies.obstacles)
    margin = std::max(margin, obstacle.margin.value_or(0.0));
  return engine.hand_count() > 0 ? std::max(margin, grasping::ClaspRules{}.margin) : margin;
}

void check_time(double milliseconds) {
  if (std::isfinite(milliseconds) && milliseconds >= 0.0) return;
  throw std::invalid_argument("milliseconds must be finite and not negative");
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::vector<Eigen::Isometry3d> poses_of(const contact::MultiPartSliding& parts) {
  std::vector<Eigen::Isometry3d> X_WV;
  for (std::size_t p = 0; p < parts.part_count(); ++p)
    X_WV.push_back(parts.result(p).X_WV);
  return X_WV;
}

}  // namespace

Simulation::Simulation(const Scene& scene)
    : bodies_(movable_bodies(scene)),
      engine_(bodies_.obstacles, held_parts(bodies_, scene.metaphor, scene.stiffness_N_per_m), hand_models(scene.hands),
              {.sliding = scene.rules, .up_W = scene.up_W}) {
  for (std::size_t p = 0; p < part_count(); ++p)
    tracked_.push_back({contact::ContactTracker(greatest_margin(bodies_, engine_, p)), poses_of(engine_.parts())});
  X_WG_ = poses_of(engine_.parts());
}

void Simulation::advance(std::span<const Eigen::Isometry3d> X_WG, double milliseconds) {
  check_time(milliseconds);
  if (engine_.hand_count() > 0)
    throw std::invalid_argument(bodies_.source + " has hands, which lead the parts: advance it with their postures");
  if (X_WG.size() != part_count())
    throw std::invalid_argument(bodies_.source + ": " + counted(X_WG.size(), "pose") + " for " +
                                counted(part_count(), "part"));
  for (std::size_t p = 0; p < part_count(); ++p) {
    X_WG_[p] = X_WG[p];
    if (!engine_.is_led(p)) engine_.take_part(p, X_WG[p]);
  }
  engine_.advance(X_WG_, {}, milliseconds);
}

void Simulation::advance(std::span<const std::optional<grasping::Posture>> hands, double milliseconds) {
  check_time(milliseconds);
  if (hands.size() != engine_.hand_count())
    throw std::invalid_argument(bodies_.source + ": " + counted(hands.size(), "posture") + " for " +
                                counted(engine_.hand_count(), "hand"));
  engine_.advance(hands, milliseconds);
}

const std::string& Simulation::name_of_body(std::int32_t body) const {
  static const std::string kHand = "a hand";
  static const std::string kNothing = "nothing";
  if (body < 0) return kNothing;
  const auto number = static_cast<std::size_t>(body);
  return number < bodies_.body_names.size() ? bodies_.body_names[number] : kHand;
}

contact::Wrench Simulation::wrench(std::size_t part) const {
  return contact::contact_wrench(result(part), engine_.parts().p_Vref(part));
}

std::span<const contact::TrackedContact> Simulation::contacts(std::size_t part) {
  Tracked& tracked = tracked_[part];
  const contact::MultiPartSliding& parts = engine_.parts();
  double travel = 0.0;  // of the other parts since the last update
  for (std::size_t p = 0; p < parts.part_count(); ++p) {
    if (p == part) continue;
    const Eigen::Vector3d& p_Vref = parts.part(p).p_Vref();
    const geometry::Displacement moved = geometry::displacement_between(tracked.X_WB[p], parts.result(p).X_WV, p_Vref);
    travel = std::max(travel, moved.v.norm() + moved.w.norm() * parts.part(p).radius());
  }
  tracked.X_WB = poses_of(parts);
  return tracked.tracker.update(result(part), travel);
}

double Simulation::clearance(std::size_t part, double farthest) {
  const contact::MultiPartSliding& parts = engine_.parts();
  double least = farthest;
  const auto look_at = [&](const contact::ContactBody& body, const Eigen::Isometry3d& X_WB) {
    const Eigen::Isometry3d X_BV = X_WB.inverse(Eigen::Isometry) * X_WV(part);
    least = collision::distance(body.tree, parts.part(part).tree, X_BV, workspace_, least).distance;
  };
  for (const contact::Obstacle& obstacle : bodies_.obstacles)
    look_at(*obstacle.body, obstacle.X_WO);
  for (std::size_t p = 0; p < parts.part_count(); ++p) {
    if (p != part) look_at(parts.part(p), parts.result(p).X_WV);
  }
  return least;
}

}  // namespace glissade::simulation
