#include "pipeline/placed_objects.h"

#include <cmath>

#include <glissade/base/assert.h>
#include <glissade/collision/dop_tree.h>

namespace glissade::collision {
namespace {

// Bound on the sum of the absolute entries of RᵀR − 1 in a world.
constexpr double kRotation = 1e-12;
// Relative to coordinates, which are rounded a few times.
constexpr double kRounding = 1e-14;

}  // namespace

void PlacedObjects::place(std::uint32_t slot, const WorldObject& object) {
  GLISSADE_ASSERT(slot < bodies_.size() && object.tree != nullptr);
  const DopTree& tree = *object.tree;
  Body& body = bodies_[slot];
  body.R_WO = object.X_WO.linear();
  body.c_O = tree.center();
  body.radius = tree.radius();
  body.reach = tree.center().norm() + tree.radius();
  places_[slot] = {object.X_WO * tree.center(), 0.0};
}

// A difference of two rotations has the singular values s, s and 0, so its Frobenius norm is √2 times the largest.
//
// Later rounding is compensated here: the error of places is proportional to the coordinates of the object, and the
// error of sums of `turned` to `turned`.
Eigen::Vector3d PlacedObjects::move(std::uint32_t slot, const WorldObject& object) {
  Body& body = bodies_[slot];
  Place& place = places_[slot];
  const Eigen::Vector3d c_W = object.X_WO * body.c_O;
  const Eigen::Vector3d step = c_W - place.c_W;
  const double turn = std::sqrt(0.5) * (object.X_WO.linear() - body.R_WO).norm() + 4.0 * kRotation;
  place.turned += body.radius * turn + kRounding * (c_W.lpNorm<1>() + body.reach);
  place.turned *= 1.0 + 0x1p-50;
  place.c_W = c_W;
  body.R_WO = object.X_WO.linear();
  return step;
}

void PlacedObjects::give_room(std::uint32_t slot, const Eigen::AlignedBox3d& room) {
  const Place& place = places_[slot];
  bodies_[slot].lower_W = (place.c_W + room.min()).array() - place.turned;
  bodies_[slot].upper_W = (place.c_W + room.max()).array() + place.turned;
}

bool PlacedObjects::has_room(std::uint32_t slot) const {
  const Place& place = places_[slot];
  return (place.c_W.array() - place.turned >= bodies_[slot].lower_W.array()).all() &&
         (place.c_W.array() + place.turned <= bodies_[slot].upper_W.array()).all();
}

double PlacedObjects::gap_of_spheres(std::uint32_t slot_a, std::uint32_t slot_b) const {
  const Eigen::Vector3d& c_a = places_[slot_a].c_W;
  const Eigen::Vector3d& c_b = places_[slot_b].c_W;
  const Body& a = bodies_[slot_a];
  const Body& b = bodies_[slot_b];
  const double reach = a.reach + b.reach;
  return (c_a - c_b).norm() - a.radius - b.radius - 8.0 * kRotation * reach -
         16.0 * kRounding * (c_a.lpNorm<1>() + c_b.lpNorm<1>() + reach);
}

Eigen::Vector3d PlacedObjects::between(std::uint32_t slot_a, std::uint32_t slot_b) const {
  return places_[slot_b].c_W - places_[slot_a].c_W;
}

// Compensates for the rounding of relative poses, and for the defect of rotations, by which lengths and directions
// change.
Separation PlacedObjects::separation(std::uint32_t slot_a, std::uint32_t slot_b, const Eigen::Vector3d& n_W,
                                     double gap) const {
  const Place& a = places_[slot_a];
  const Place& b = places_[slot_b];
  const double reach = bodies_[slot_a].reach + bodies_[slot_b].reach;
  const double span = (a.c_W - b.c_W).norm() + 2.0 * reach;
  const double coordinates = a.c_W.lpNorm<1>() + b.c_W.lpNorm<1>() + reach + a.turned + b.turned;
  GLISSADE_ASSERT(n_W.squaredNorm() > 0.0);
  const Eigen::Vector3d unit = n_W.normalized();
  return {unit, along(slot_a, slot_b, unit) - gap + 8.0 * kRotation * span + 2.0 * kRounding * coordinates};
}

}  // namespace glissade::collision
