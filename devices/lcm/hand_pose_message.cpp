#include "lcm/hand_pose_message.h"

#include <glissade/lcmtypes/hand_pose_t.hpp>

#include "lcm/message_fields.h"

namespace glissade::devices {
namespace {

DecodeResult check(const hand_pose_t& message) noexcept {
  FieldCheck fields;
  fields.between("valid", message.valid, 0, 1);
  fields.positive("session", message.session);
  fields.not_negative("sequence", message.sequence);
  fields.time("time_ns", message.time_ns);
  fields.between("has_velocity", message.has_velocity, 0, 1);
  if (message.valid == 0) return fields.result();
  fields.magnitude("position_WT_m", message.position_WT_m, kLargestPosition);
  fields.unit_vector("orientation_WT_wxyz", message.orientation_WT_wxyz);
  if (message.has_velocity == 0) return fields.result();
  fields.magnitude("v_WT_m_per_s", message.v_WT_m_per_s, kLargestVelocity);
  fields.magnitude("w_WT_rad_per_s", message.w_WT_rad_per_s, kLargestAngularVelocity);
  return fields.result();
}

}  // namespace

std::vector<std::uint8_t> encode(const PoseHeader& header, const TrackedPose& pose) {
  hand_pose_t message{};
  message.version = hand_pose_t::VERSION;
  message.valid = pose.is_valid ? 1 : 0;
  message.device = header.device;
  message.session = header.session;
  message.sequence = pose.sequence;
  message.time_ns = pose.time.count();
  put(Eigen::Vector3d(pose.X_WT.translation()), message.position_WT_m);
  put(Eigen::Matrix3d(pose.X_WT.linear()), message.orientation_WT_wxyz);
  message.has_velocity = pose.has_velocity ? 1 : 0;
  put(pose.v_WT, message.v_WT_m_per_s);
  put(pose.w_WT, message.w_WT_rad_per_s);
  return to_bytes(message);
}

DecodeResult decode(std::span<const std::uint8_t> bytes, PoseHeader& header, TrackedPose& pose) noexcept {
  hand_pose_t message{};
  DecodeResult result = from_bytes(bytes, message);
  if (result == MessageError::kNone) result = check(message);
  if (result != MessageError::kNone) return result;
  header = {.device = message.device, .session = message.session};
  pose = {
      .sequence = message.sequence, .time = std::chrono::nanoseconds(message.time_ns), .is_valid = message.valid != 0};
  if (!pose.is_valid) return result;
  pose.X_WT = pose_of(message.position_WT_m, message.orientation_WT_wxyz);
  pose.has_velocity = message.has_velocity != 0;
  if (pose.has_velocity) pose.v_WT = Eigen::Vector3d(message.v_WT_m_per_s);
  if (pose.has_velocity) pose.w_WT = Eigen::Vector3d(message.w_WT_rad_per_s);
  return result;
}

}  // namespace glissade::devices
