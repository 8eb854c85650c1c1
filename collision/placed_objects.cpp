#include "placed_objects.h"

namespace glissade::collision {
namespace {

// Entries of RᵀR − 1, added up. What a quaternion gives stays below 1e-15.
constexpr double kRotation = 1e-12;
// Of coordinates: rounded a few times.
constexpr double kRounding = 1e-14;

bool is_rotation(const Eigen::Matrix3d& R) {
  return (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().sum() < kRotation;
}

}  // namespace

void PlacedObjects::place(std::uint32_t slot, const WorldObject& object) {
  const DopTree& tree = *object.tree;
  objects_[slot] = {object.X_WO, object.X_WO * tree.center(),      tree.radius(), tree.center().norm() + tree.radius(),
                    0.0,         is_rotation(object.X_WO.linear())};
}

void PlacedObjects::move(std::uint32_t slot, const WorldObject& object) {
  Placed& placed = objects_[slot];
  const Eigen::Vector3d c_W = object.X_WO * object.tree->center();
  // The matrix norm of a difference is no greater than Frobenius'.
  const double turned = (object.X_WO.linear() - placed.X_WO.linear()).norm();
  const double moved = (c_W - placed.c_W).norm() + placed.radius * turned;
  placed.travel += moved * (1.0 + kRounding) + kRounding * 0.1 * (c_W.lpNorm<1>() + placed.reach);
  placed.X_WO = object.X_WO;
  placed.c_W = c_W;
  placed.is_rotation = is_rotation(object.X_WO.linear());
}

double PlacedObjects::apart_until(std::uint32_t slot_a, std::uint32_t slot_b, double gap) const {
  const Placed& a = objects_[slot_a];
  const Placed& b = objects_[slot_b];
  if (!a.is_rotation || !b.is_rotation) return -1.0;
  // Rotations keep distances but for their defect; poses seen from each other are rounded, too.
  const Eigen::Vector3d& p_a = a.X_WO.translation();
  const Eigen::Vector3d& p_b = b.X_WO.translation();
  const double span = (p_a - p_b).norm() + a.reach + b.reach;
  const double now = a.travel + b.travel;
  return now + gap - 8.0 * kRotation * span - kRounding * (p_a.lpNorm<1>() + p_b.lpNorm<1>() + now);
}

}  // namespace glissade::collision
