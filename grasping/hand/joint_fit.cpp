#include "hand/joint_fit.h"

#include <cmath>

#include <Eigen/Geometry>

namespace glissade::grasping {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// How well a turn by the angle a about an axis matches: sine · sin(a) + cosine · cos(a), to be maximised.
struct Match {
  double sine = 0.0;
  double cosine = 0.0;

  double angle() const { return std::atan2(sine, cosine); }
};

/// Of the turn that takes `from` to `to`.
Match match(const Vector3d& axis, const Vector3d& from, const Vector3d& to) {
  return {axis.dot(from.cross(to)), from.dot(to) - axis.dot(from) * axis.dot(to)};
}

Matrix3d rotation(double angle, const Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

}  // namespace

double hinge_angle(const Matrix3d& R, const Vector3d& axis) {
  const Vector3d twice_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return Match{axis.dot(twice_sine), R.trace() - axis.dot(R * axis)}.angle();
}

TwoAngles two_hinge_angles(const Matrix3d& R, const Vector3d& first, const Vector3d& second, const Vector3d& bone,
                           double weight) {
  constexpr int kRounds = 12;  // coordinate ascent; the second round is exact if R is a product
  const Match of_second = match(first, second, R * second);
  TwoAngles angles{of_second.angle(), 0.0};
  for (int round = 0; round < kRounds; ++round) {
    angles.second = match(second, bone, rotation(-angles.first, first) * (R * bone)).angle();
    if (weight == 0.0) break;
    const Match of_bone = match(first, rotation(angles.second, second) * bone, R * bone);
    angles.first = Match{of_second.sine + weight * of_bone.sine, of_second.cosine + weight * of_bone.cosine}.angle();
  }
  return angles;
}

}  // namespace glissade::grasping
