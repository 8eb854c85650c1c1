#pragma once

/// One slide of a study, with its parameters applied.

#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/sliding.h>
#include <glissade/simulation/scene.h>
#include <glissade/study/study.h>

namespace glissade::study {

/// A displacement of a body: a translation in world axes (metres), and a rotation about a point by angles (degrees)
/// about the fixed axes x, y and z of the world.
using DisplacementValues = Eigen::Matrix<double, 6, 1>;

/// The body at X_WB, displaced; it turns about its point p_B.
Eigen::Isometry3d displaced(const Eigen::Isometry3d& X_WB, const DisplacementValues& by, const Eigen::Vector3d& p_B);

struct Variant {
  simulation::Scene scene;
  std::size_t trajectory = 0;
  DisplacementValues path = DisplacementValues::Zero();
  DisplacementValues start = DisplacementValues::Zero();
  DisplacementValues end = DisplacementValues::Zero();
  contact::Metaphor metaphor{};
  double stiffness_N_per_m = 0.0;
  contact::SlidingRules rules{};

  /// The displacement of the path at a moment: 0 at its start, 1 at its end.
  DisplacementValues of_path(double share) const { return path + (1.0 - share) * start + share * end; }
};

/// The study with these values of its parameters. Throws std::invalid_argument, naming the object, if a shape or a mesh
/// cannot have these values.
Variant variant_of(const Study& study, const std::vector<double>& values);

}  // namespace glissade::study
