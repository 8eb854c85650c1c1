#pragma once

/// Scenes of primitives, in which ODE is an honest reference for where a held part comes to rest.

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>

#include "ode_reference.h"

namespace glissade::test_support {

/// A block among the obstacles, and where its surface is to be moved by the margin.
struct OdeBlock {
  Eigen::Vector3d size;
  Eigen::Isometry3d X_W;
  Eigen::Vector3d towards_part;  ///< unit; zero where the margin is not to be added
};

struct OdeScene {
  std::string name;
  OdePart part;
  std::vector<OdePlane> planes;
  std::vector<OdeBlock> blocks;
  Eigen::Isometry3d X_start;
  Eigen::Isometry3d X_WG;
  /// Metres that the mesh is nearer to its middle than the primitive it stands for.
  double sagitta = 0.0;
};

std::vector<OdeScene> ode_scenes();

/// Where both have come to rest with the ghost at `X_WG`, led there in 200 ms.
struct OdeComparison {
  bool at_rest = false;               ///< both
  geometry::Displacement difference;  ///< from ODE's part to ours
  double force = 0.0;                 ///< of ODE's spring, newtons
  double torque = 0.0;                ///< of ODE's spring, newton metres
  double force_difference = 0.0;      ///< in parts of the force
  double wrench_difference = 0.0;     ///< in parts of the wrench, in the norm √(|f|²/k_t + |t|²/k_r)
  double ode_imbalance = 0.0;         ///< the same for spring and contacts of ODE
  int ode_steps = 0;                  ///< to come to rest
  int contacts = 0;                   ///< of ours that push
};

OdeComparison compare_with_ode(const OdeScene& scene);

}  // namespace glissade::test_support
