#pragma once

/// ODE as the physics of a held part: a rigid body on a spring and damper to the ghost, among planes and boxes that
/// stand still. Once it has settled, damping and inertia are out of it, and what remains is the optimum that sliding
/// contact looks for.
///
/// Only for primitives: a contact of a box or sphere with a plane or box has the depth and normal of the shapes
/// themselves. ODE knows no margin; callers move its obstacles by it.
///
/// Settings: double precision, dWorldStep (Dantzig's exact solver), steps of 1 ms, ERP 0.2, CFM 1e-9, no gravity, up to
/// 16 contacts a pair. In the steady state a contact is F h CFM / ERP deep at most, below 1e-10 m for all forces here.

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/haptics/coupling.h>

namespace glissade::test_support {

/// The half-space n·x < d is solid.
struct OdePlane {
  Eigen::Vector3d n;
  double d;  ///< metres
};

struct OdeBox {
  Eigen::Vector3d size;
  Eigen::Isometry3d X_W;
};

struct OdeWorld {
  std::vector<OdePlane> planes;
  std::vector<OdeBox> boxes;
  /// Coulomb's coefficient, used as ODE's dContactApprox1 does: a pyramid instead of the cone, whose height is the
  /// normal force. It agrees with the cone along the directions `slip_W` and across.
  double friction = 0.0;
  Eigen::Vector3d slip_W = Eigen::Vector3d::UnitX();
};

/// A sphere, or a box where `size` is given; its reference point is its middle, at the origin of its frame.
struct OdePart {
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

/// The part's mass is 1 kg, its inertia isotropic and such that both springs swing alike; the damping is critical.
/// Not thread-safe.
class OdeHeldPart {
 public:
  OdeHeldPart(const OdeWorld& world, const OdePart& part, const haptics::CouplingStiffness& stiffness,
              const Eigen::Isometry3d& X_WV);
  ~OdeHeldPart();
  OdeHeldPart(const OdeHeldPart&) = delete;
  OdeHeldPart& operator=(const OdeHeldPart&) = delete;

  /// One step of a millisecond with the ghost at X_WG.
  void step(const Eigen::Isometry3d& X_WG);

  /// Steps until no point of a part of 0.1 m has been faster than 1e-9 m/s for 20 steps. Returns their number, or
  /// nothing if that did not happen in time.
  std::optional<int> settle(const Eigen::Isometry3d& X_WG, int most_steps = 20'000);

  Eigen::Isometry3d X_WV() const;

  /// What the contacts did to the part in the last step, about its middle.
  haptics::Wrench contact_wrench() const;

  /// Speed of the middle, m/s.
  double speed() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace glissade::test_support
