#pragma once

/// ODE as the physics of a held part: a rigid body on a spring and damper to the ghost, among fixed planes and boxes.
/// When it has settled, damping and inertia vanish, and its pose is the optimum that sliding contact computes.
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

#include <glissade/contact/spring.h>

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
  /// Coulomb's coefficient in ODE's dContactApprox1: a pyramid instead of the cone, with the normal force as height. It
  /// agrees with the cone along `slip_W` and across.
  double friction = 0.0;
  Eigen::Vector3d slip_W = Eigen::Vector3d::UnitX();
};

/// A sphere, or a box if `size` is not zero. Its reference point is its centre, at the origin of its frame.
struct OdePart {
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

/// The part has a mass of 1 kg and an isotropic inertia for which both springs have the same frequency; the damping is
/// critical. Not thread-safe.
class OdeHeldPart {
 public:
  OdeHeldPart(const OdeWorld& world, const OdePart& part, const contact::CouplingStiffness& stiffness,
              const Eigen::Isometry3d& X_WV);
  ~OdeHeldPart();
  OdeHeldPart(const OdeHeldPart&) = delete;
  OdeHeldPart& operator=(const OdeHeldPart&) = delete;

  /// One step of a millisecond with the ghost at X_WG.
  void step(const Eigen::Isometry3d& X_WG);

  /// Steps until no point of a part of 0.1 m has been faster than 1e-9 m/s for 20 steps. Returns the number of steps,
  /// or nothing if `most_steps` did not suffice.
  std::optional<int> settle(const Eigen::Isometry3d& X_WG, int most_steps = 20'000);

  Eigen::Isometry3d X_WV() const;

  /// Wrench of the contacts on the part in the last step, about its centre.
  contact::Wrench contact_wrench() const;

  /// Speed of the centre, m/s.
  double speed() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace glissade::test_support
