#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Geometry>

namespace glissade::contact {

/// A motion of all movers. The parameter t runs from 0 to 1.
class BodiesMotion {
 public:
  virtual ~BodiesMotion() = default;

  /// Writes the pose X_WM of each mover at t, one entry for each mover.
  virtual void poses(double t, std::span<Eigen::Isometry3d> X_WM) const = 0;
  /// Upper bound (metres) of |x(t) − x(0)| for every point x of a mover and every t.
  virtual double length(std::size_t mover) const = 0;
  /// Upper bound (metres) of |d²x/dt²| for every point x of a mover and every t.
  virtual double acceleration(std::size_t mover) const = 0;
};

}  // namespace glissade::contact
