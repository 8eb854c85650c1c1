#pragma once

/// The proof that two triangles stay apart on the whole way of a step: what `path_certificate.h` comes down to where
/// it cannot prove more at once.

#include <cstdint>

#include <Eigen/Core>

#include <glissade/geometry/triangle_pair.h>

#include "certificate/moving_bodies.h"

namespace glissade::haptics {

/// Proves pairs of triangles apart along the step that `bodies` are in. Not thread-safe.
///
/// A pair must keep the min_clearance of its bodies; one that starts the step nearer keeps 0.95 of its distance, and
/// one that touches cannot be proved apart at all. It is apart over a stretch of the path if one direction separates it
/// at both ends by more than the curvature of the paths can take away in between; otherwise the stretch is halved, up
/// to five times.
class TriangleCertificate {
 public:
  /// Metres: distances below `rounding` are not certain. `bodies` must outlive this object.
  TriangleCertificate(MovingBodies& bodies, const TrianglesOfBodies& pair, double min_clearance, double rounding)
      : bodies_(bodies), pair_(pair), min_clearance_(min_clearance), rounding_(rounding) {}

  /// Whether the pair is proved apart; the direction `n_hint` is tried first. If not, `n_start` is the unit direction,
  /// from the obstacle to the part, that holds it apart at the start of the step.
  bool prove(const Eigen::Vector3d& n_hint, Eigen::Vector3d& n_start);

 private:
  /// Both triangles at one moment of the path.
  struct Moment {
    geometry::TrianglePoints obstacle;
    geometry::TrianglePoints part;
  };
  /// A part of the path.
  struct Stretch {
    const Moment& begin;
    const Moment& end;
    double needed;  ///< metres of gap at both ends, so that the min_clearance is kept in between
  };

  bool prove_stretch(int begin, int end);
  bool separates(const Eigen::Vector3d& n, const Stretch& stretch) const;
  Moment at(int moment);
  double needed(int begin, int end) const;

  MovingBodies& bodies_;
  TrianglesOfBodies pair_;
  double min_clearance_;
  double rounding_;
};

}  // namespace glissade::haptics
