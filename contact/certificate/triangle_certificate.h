#pragma once

/// The certificate that two triangles stay apart on the whole path of a step, for pairs that `path_certificate.h`
/// cannot certify as boxes.

#include <cstdint>

#include <Eigen/Core>

#include <glissade/geometry/triangle_pair.h>

#include "certificate/moving_bodies.h"

namespace glissade::contact {

/// Certifies one triangle pair along the present step of `bodies`. Not thread-safe.
///
/// A pair must keep the minimum clearance of its bodies. A pair that starts the step nearer must keep 0.95 of its
/// distance; a pair that touches cannot be certified. A pair stays apart over a stretch of the path if one direction
/// separates it at both ends by more than the curvature of the paths can take away in between. Otherwise the stretch is
/// halved, up to five times.
class TriangleCertificate {
 public:
  /// `min_clearance` in metres; distances below `rounding` (metres) are not certain. `bodies` must outlive this object.
  TriangleCertificate(MovingBodies& bodies, const TrianglesOfBodies& pair, double min_clearance, double rounding)
      : bodies_(bodies), pair_(pair), min_clearance_(min_clearance), rounding_(rounding) {}

  /// Whether the pair is certified; the direction `n_hint` is tried first. `n_start` is the unit direction, from the
  /// obstacle to the part, that separates the pair on the whole path, or else at the start of the step.
  bool prove(const Eigen::Vector3d& n_hint, Eigen::Vector3d& n_start);

  /// Number of stretches that `prove` had to look at with the distances of the triangles: a measure of its work.
  int stretches() const { return stretches_; }

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
    double needed;  ///< metres of gap at both ends that keep the minimum clearance in between
  };

  bool prove_stretch(int begin, int end, const Moment& at_begin, const geometry::TriangleDistance& closest);
  bool separates(const Eigen::Vector3d& n, const Stretch& stretch) const;
  bool separates_turning(const Eigen::Vector3d& n_begin, const Eigen::Vector3d& n_end, const Stretch& stretch) const;
  Moment at(int moment);
  double needed(int begin, int end) const;

  MovingBodies& bodies_;
  TrianglesOfBodies pair_;
  double min_clearance_;
  double rounding_;
  int stretches_ = 0;
};

}  // namespace glissade::contact
