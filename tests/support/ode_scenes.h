#pragma once

/// Scenes of primitives, in which ODE is a valid reference for the rest pose of a held part.

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>

#include "ode_reference.h"

namespace glissade::test_support {

/// A block among the obstacles, and the direction in which the margin moves its surface.
struct OdeBlock {
  Eigen::Vector3d size;
  Eigen::Isometry3d X_W;
  Eigen::Vector3d towards_part;  ///< unit vector; zero if the margin is not added
};

struct OdeScene {
  std::string name;
  OdePart part;
  std::vector<OdePlane> planes;
  std::vector<OdeBlock> blocks;
  Eigen::Isometry3d X_start;
  Eigen::Isometry3d X_WG;
  /// Distance in metres by which the mesh lies inside the primitive that it approximates.
  double sagitta = 0.0;
};

std::vector<OdeScene> ode_scenes();

/// Comparison at rest, after a motion of the ghost to `X_WG` in 200 ms.
struct OdeComparison {
  bool at_rest = false;               ///< both
  geometry::Displacement difference;  ///< from ODE's part to ours
  double force = 0.0;                 ///< of ODE's spring, newtons
  double torque = 0.0;                ///< of ODE's spring, newton metres
  double force_difference = 0.0;      ///< relative to the force
  double wrench_difference = 0.0;     ///< relative to the wrench, in the norm √(|f|²/k_t + |t|²/k_r)
  double ode_imbalance = 0.0;         ///< the same for spring and contacts of ODE
  int ode_steps = 0;                  ///< to come to rest
  int contacts = 0;                   ///< of ours that push
};

OdeComparison compare_with_ode(const OdeScene& scene);

}  // namespace glissade::test_support
