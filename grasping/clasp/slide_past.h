#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/displacement.h>

namespace glissade::grasping {

/// A contact of a rigid body, to first order: the body's point r_W (metres, from the body's reference point) must not
/// move farther than `room` (metres) against the unit normal. A negative room demands motion along it.
struct ContactPlane {
  Eigen::Vector3d n_W;
  Eigen::Vector3d r_W;
  double room;
};

/// The displacement of a rigid body, nearest to `wanted`, that all contacts allow: so a hand that presses on something
/// slides along it, and a part yields to a hand. Nearest in the metric |v|² + (ρ |w|)², with ρ = `radius` (metres). By
/// Hildreth's method, to a tenth of a per cent. `forces` is scratch memory. Contacts give way by `compliance` times
/// their push: contacts from all sides, which no displacement satisfies, then balance.
geometry::Displacement slide_past(const geometry::Displacement& wanted, std::span<const ContactPlane> planes,
                                  double radius, std::vector<double>& forces, double compliance = 0.0);

}  // namespace glissade::grasping
