#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <glissade/devices/calibration.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/files/text.h>

namespace glissade::devices {
namespace {

/// A limit that stands for none stays none.
double reported_limit(const JointCalibration& joint, double limit) noexcept {
  if (std::abs(limit) >= kNoLimit_rad) return limit;
  constexpr double kFarthest_rad = 0.999 * kNoLimit_rad;
  return std::clamp(joint.reported(limit), -kFarthest_rad, kFarthest_rad);
}

}  // namespace

void Calibration::apply(GloveState& state) const noexcept {
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j]) state.joint_angles[j] = joints[j]->angle(state.joint_angles[j]);
  }
  const Eigen::Vector3d p_TH_W = state.X_WH.linear() * X_TH.translation();
  state.v_WH += state.w_WH.cross(p_TH_W);
  state.X_WH = state.X_WH * X_TH;
}

JointLimits Calibration::to_device(const JointLimits& limits) const noexcept {
  JointLimits reported = limits;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (!joints[j]) continue;
    JointLimit& limit = reported.joints[j];
    limit.lower = reported_limit(*joints[j], limit.lower);
    limit.upper = reported_limit(*joints[j], limit.upper);
    // The device multiplies them by its own angle and rate.
    limit.stiffness *= joints[j]->gain;
    limit.damping *= joints[j]->gain;
  }
  return reported;
}

DeviceDescriptor Calibration::calibrated(const DeviceDescriptor& descriptor) const {
  DeviceDescriptor result = descriptor;
  double greatest_gain = 1.0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const bool is_absent = descriptor.joint_lower[j] == 0.0 && descriptor.joint_upper[j] == 0.0;
    if (!joints[j] || is_absent) continue;
    result.joint_lower[j] = joints[j]->angle(descriptor.joint_lower[j]);
    result.joint_upper[j] = joints[j]->angle(descriptor.joint_upper[j]);
    greatest_gain = std::max(greatest_gain, joints[j]->gain);
  }
  result.joint_resolution *= greatest_gain;
  result.max_limit_stiffness /= greatest_gain;
  return result;
}

void check_calibration(const Calibration& calibration, const DeviceDescriptor& descriptor, hands::HandSide side) {
  const std::string of = "the calibration of " + files::in_quotes(calibration.user);
  if (calibration.device != descriptor.name)
    throw std::invalid_argument(of + " is for the device " + files::in_quotes(calibration.device) + ", not for " +
                                files::in_quotes(descriptor.name));
  if (calibration.side != side) throw std::invalid_argument(of + " is for the other hand");
  for (std::size_t j = 0; j < calibration.joints.size(); ++j) {
    const auto& joint = calibration.joints[j];
    if (!joint) continue;
    const std::string name(hands::kJointNames[j]);
    if (!(joint->gain >= kLeastGain && joint->gain <= kGreatestGain))
      throw std::invalid_argument(of + ": the gain of " + name + " must lie between 0.2 and 5");
    if (!std::isfinite(joint->offset)) throw std::invalid_argument(of + ": the offset of " + name + " is not finite");
  }
  if (!calibration.X_TH.matrix().allFinite() || !calibration.X_TH.linear().isUnitary(1e-6))
    throw std::invalid_argument(of + ": the pose of the hand in the frame of the tracker is none");
  const bool has_offset = !calibration.X_TH.matrix().isIdentity(0.0);
  if (has_offset && (descriptor.max_force > 0.0 || descriptor.max_torque > 0.0))
    throw std::invalid_argument(of + " has a tracker, but " + files::in_quotes(descriptor.name) +
                                " exerts force on the hand and must report the place of the force itself");
}

SafeCommand SafeCommand::for_device(const Calibration& calibration) const noexcept {
  SafeCommand command = *this;
  command.values_.joint_limits = calibration.to_device(values_.joint_limits);
  return command;
}

}  // namespace glissade::devices
