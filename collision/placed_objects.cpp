#include "placed_objects.h"

#include <cmath>
#include <limits>

namespace glissade::collision {
namespace {

// Entries of RᵀR − 1, added up: less than this in a world.
constexpr double kRotation = 1e-12;
// Of coordinates: rounded a few times.
constexpr double kRoundingOfPoses = 1e-14;

}  // namespace

void PlacedObjects::place(std::uint32_t slot, const WorldObject& object) {
  const DopTree& tree = *object.tree;
  objects_[slot] = {object.X_WO, object.X_WO * tree.center(), tree.radius(), tree.center().norm() + tree.radius()};
  travels_[slot] = 0.0;
}

void PlacedObjects::move(std::uint32_t slot, const WorldObject& object) {
  Placed& placed = objects_[slot];
  const Eigen::Vector3d c_W = object.X_WO * object.tree->center();
  // The matrix norm of a difference is no greater than Frobenius'.
  const double turned = (object.X_WO.linear() - placed.X_WO.linear()).norm();
  const double moved = (c_W - placed.c_W).norm() + placed.radius * turned;
  const double rounding = kRoundingOfPoses * (c_W.lpNorm<1>() + placed.reach);
  // Rounded up: after a long way, a short step must not be lost.
  travels_[slot] = std::nextafter(travels_[slot] + moved * (1.0 + kRoundingOfPoses) + rounding,
                                  std::numeric_limits<double>::infinity());
  placed.X_WO = object.X_WO;
  placed.c_W = c_W;
}

double PlacedObjects::gap_of_spheres(std::uint32_t slot_a, std::uint32_t slot_b) const {
  const Placed& a = objects_[slot_a];
  const Placed& b = objects_[slot_b];
  const double coordinates = a.c_W.lpNorm<1>() + b.c_W.lpNorm<1>() + a.X_WO.translation().lpNorm<1>() +
                             b.X_WO.translation().lpNorm<1>() + a.reach + b.reach;
  return (a.c_W - b.c_W).norm() - a.radius - b.radius - 8.0 * kRotation * (a.reach + b.reach) -
         8.0 * kRoundingOfPoses * coordinates;
}

double PlacedObjects::apart_until(std::uint32_t slot_a, std::uint32_t slot_b, double gap) const {
  const Placed& a = objects_[slot_a];
  const Placed& b = objects_[slot_b];
  const double now = motion(slot_a, slot_b);
  // Rotations keep distances but for their defect; poses seen from each other are rounded, too.
  const Eigen::Vector3d& p_a = a.X_WO.translation();
  const Eigen::Vector3d& p_b = b.X_WO.translation();
  const double span = (p_a - p_b).norm() + a.reach + b.reach;
  return now + gap - 8.0 * kRotation * span - kRoundingOfPoses * (p_a.lpNorm<1>() + p_b.lpNorm<1>() + now);
}

}  // namespace glissade::collision
