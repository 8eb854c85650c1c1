#include "lcm/constraint_messages.h"

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace glissade::devices {
namespace {

constexpr double kLargestStiffness = 1e6;  // N/m, Nm/rad
constexpr double kLargestDamping = 1e6;    // N s/m
constexpr std::int32_t kLargestCount = kMaxHalfSpaces;

}  // namespace

half_spaces_t half_spaces_message(const HalfSpaces& half_spaces) noexcept {
  half_spaces_t message{};
  message.expire_ns = half_spaces.expiry.count();
  if (!half_spaces.any()) return message;
  message.count = static_cast<std::int32_t>(half_spaces.count);
  put(Eigen::Vector3d(half_spaces.X_WB.translation()), message.position_WB_m);
  put(Eigen::Matrix3d(half_spaces.X_WB.linear()), message.orientation_WB_wxyz);
  put(half_spaces.p_HR, message.position_HR_m);
  for (std::size_t i = 0; i < half_spaces.count; ++i) {
    const HalfSpace& row = half_spaces.rows[i];
    put(row.n_W, message.rows[i].n_W);
    put(row.r_W, message.rows[i].r_W_m);
    message.rows[i].bound_m = row.bound;
  }
  message.stiffness_N_per_m = half_spaces.stiffness;
  message.rotational_stiffness_Nm_per_rad = half_spaces.rotational_stiffness;
  message.damping_N_s_per_m = half_spaces.damping;
  message.max_force_N = half_spaces.max_force;
  message.max_torque_Nm = half_spaces.max_torque;
  return message;
}

HalfSpaces half_spaces_of(const half_spaces_t& message) noexcept {
  HalfSpaces half_spaces;
  half_spaces.expiry = std::chrono::nanoseconds(message.expire_ns);
  if (message.count == 0) return half_spaces;
  half_spaces.count = static_cast<std::size_t>(message.count);
  half_spaces.X_WB = pose_of(message.position_WB_m, message.orientation_WB_wxyz);
  half_spaces.p_HR = Eigen::Vector3d(message.position_HR_m);
  for (std::size_t i = 0; i < half_spaces.count; ++i) {
    const half_space_t& row = message.rows[i];
    half_spaces.rows[i] = {Eigen::Vector3d(row.n_W).normalized(), Eigen::Vector3d(row.r_W_m), row.bound_m};
  }
  half_spaces.stiffness = message.stiffness_N_per_m;
  half_spaces.rotational_stiffness = message.rotational_stiffness_Nm_per_rad;
  half_spaces.damping = message.damping_N_s_per_m;
  half_spaces.max_force = message.max_force_N;
  half_spaces.max_torque = message.max_torque_Nm;
  return half_spaces;
}

void check_half_spaces(const half_spaces_t& message, FieldCheck& fields) noexcept {
  fields.between("half_spaces.count", message.count, 0, kLargestCount);
  fields.time("half_spaces.expire_ns", message.expire_ns);
  if (message.count == 0) return;
  fields.magnitude("half_spaces.position_WB_m", message.position_WB_m, kLargestPosition);
  fields.unit_vector("half_spaces.orientation_WB_wxyz", message.orientation_WB_wxyz);
  fields.magnitude("half_spaces.position_HR_m", message.position_HR_m, kLargestPosition);
  for (std::int32_t i = 0; i < std::clamp(message.count, 0, kLargestCount); ++i) {
    const half_space_t& row = message.rows[i];
    fields.unit_vector("half_spaces.rows.n_W", row.n_W);
    fields.magnitude("half_spaces.rows.r_W_m", row.r_W_m, kLargestPosition);
    fields.magnitude("half_spaces.rows.bound_m", row.bound_m, kLargestPosition);
  }
  fields.amount("half_spaces.stiffness_N_per_m", message.stiffness_N_per_m, kLargestStiffness);
  fields.amount("half_spaces.rotational_stiffness_Nm_per_rad", message.rotational_stiffness_Nm_per_rad,
                kLargestStiffness);
  fields.amount("half_spaces.damping_N_s_per_m", message.damping_N_s_per_m, kLargestDamping);
  fields.amount("half_spaces.max_force_N", message.max_force_N, kLargestForce);
  fields.amount("half_spaces.max_torque_Nm", message.max_torque_Nm, kLargestTorque);
}

}  // namespace glissade::devices
