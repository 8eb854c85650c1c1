// Gloves of the C interface.

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glissade/geometry/pose_trajectory.h>

#include "call.h"
#include "convert.h"
#include "objects.h"

namespace glissade::c {

namespace {

using std::chrono::nanoseconds;

constexpr std::int64_t kLatest_ns = std::numeric_limits<std::int64_t>::max() / 4;

/// The header writes the bits of messages out.
constexpr bool is_bit_of(GlissadeReason reason, bool devices::LimitReasons::*flag) {
  return devices::kLimitReasons[static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(reason)))].flag == flag;
}
static_assert(is_bit_of(GLISSADE_REASON_STOPPED, &devices::LimitReasons::is_stopped));
static_assert(is_bit_of(GLISSADE_REASON_DISABLED, &devices::LimitReasons::is_disabled));
static_assert(is_bit_of(GLISSADE_REASON_REFUSED, &devices::LimitReasons::is_refused));
static_assert(is_bit_of(GLISSADE_REASON_NOT_FINITE, &devices::LimitReasons::not_finite));
static_assert(is_bit_of(GLISSADE_REASON_IMPLAUSIBLE, &devices::LimitReasons::is_implausible));
static_assert(is_bit_of(GLISSADE_REASON_STATE_OLD, &devices::LimitReasons::is_state_old));
static_assert(is_bit_of(GLISSADE_REASON_COMMAND_OLD, &devices::LimitReasons::is_command_old));
static_assert(is_bit_of(GLISSADE_REASON_RETURNING, &devices::LimitReasons::is_returning));
static_assert(is_bit_of(GLISSADE_REASON_FORCE_LIMITED, &devices::LimitReasons::force_limited));
static_assert(is_bit_of(GLISSADE_REASON_TORQUE_LIMITED, &devices::LimitReasons::torque_limited));
static_assert(is_bit_of(GLISSADE_REASON_JOINTS_LIMITED, &devices::LimitReasons::joints_limited));
static_assert(is_bit_of(GLISSADE_REASON_RATE_LIMITED, &devices::LimitReasons::rate_limited));
static_assert(is_bit_of(GLISSADE_REASON_POWER_LIMITED, &devices::LimitReasons::power_limited));
static_assert(is_bit_of(GLISSADE_REASON_MEAN_LIMITED, &devices::LimitReasons::mean_limited));
static_assert(is_bit_of(GLISSADE_REASON_ENERGY_LIMITED, &devices::LimitReasons::energy_limited));
static_assert(devices::kLimitReasons.size() == 15);

nanoseconds time_of(double seconds, const char* argument) {
  if (!(std::abs(seconds) < 1e9)) throw std::invalid_argument(std::string(argument) + " must be finite, below 1e9 s");
  return std::chrono::round<nanoseconds>(std::chrono::duration<double>(seconds));
}

devices::DeviceDescriptor descriptor_of(const char* name, const GlissadeDevice& device) {
  devices::DeviceDescriptor descriptor;
  descriptor.name = name;
  descriptor.max_force = device.max_force_N;
  descriptor.max_torque = device.max_torque_Nm;
  descriptor.max_joint_torque = device.max_joint_torque_Nm;
  descriptor.max_stiffness = device.max_stiffness_N_per_m;
  descriptor.max_rotational_stiffness = device.max_rotational_stiffness_Nm_per_rad;
  descriptor.damping = device.damping_Ns_per_m;
  descriptor.rotational_damping = device.rotational_damping_Nms_per_rad;
  descriptor.joint_damping = device.joint_damping_Nms_per_rad;
  descriptor.friction = device.friction_N;
  descriptor.joint_friction = device.joint_friction_Nm;
  descriptor.resolution = device.resolution_m;
  descriptor.joint_resolution = device.joint_resolution_rad;
  descriptor.update_rate = device.update_rate_Hz;
  descriptor.delay = time_of(device.delay_s, "delay_s");
  descriptor.max_power = device.max_power_W;
  descriptor.max_mean_force = device.max_mean_force_N;
  descriptor.max_force_rate = device.max_force_rate_N_per_s;
  descriptor.max_torque_rate = device.max_torque_rate_Nm_per_s;
  descriptor.max_joint_torque_rate = device.max_joint_torque_rate_Nm_per_s;
  descriptor.max_damping = device.max_damping_Ns_per_m;
  descriptor.frozen = time_of(device.frozen_s, "frozen_s");
  descriptor.max_speed = device.max_speed_m_per_s;
  descriptor.max_turn_rate = device.max_turn_rate_rad_per_s;
  descriptor.workspace_radius = device.workspace_radius_m;
  descriptor.joint_lower = joints_of(device.joint_lower_rad);
  descriptor.joint_upper = joints_of(device.joint_upper_rad);
  return descriptor;
}

geometry::PoseTrajectory script_of(const double* times_s, const GlissadePose* X_WH, std::size_t count) {
  array(times_s, count, "times_s");
  array(X_WH, count, "X_WH");
  std::vector<geometry::TimedPose> rows;
  for (std::size_t i = 0; i < count; ++i)
    rows.push_back({time_of(times_s[i], "times_s"), pose_of(X_WH[i], "X_WH")});
  return geometry::PoseTrajectory(std::move(rows));
}

}  // namespace

}  // namespace glissade::c

using namespace glissade::c;
using namespace glissade;

GlissadeStatus glissade_device_default(GlissadeDevice* device) {
  return call([&] {
    const devices::DeviceDescriptor usual;
    at(device, "device") = {};
    device->update_rate_Hz = usual.update_rate;
    device->max_power_W = usual.max_power;
    device->max_speed_m_per_s = usual.max_speed;
    device->max_turn_rate_rad_per_s = usual.max_turn_rate;
    device->workspace_radius_m = usual.workspace_radius;
  });
}

GlissadeStatus glissade_glove_state_default(GlissadeGloveState* state) {
  return call([&] {
    at(state, "state") = {};
    state->X_WH.qw = 1.0;
    state->grip = 1;
    state->is_enabled = 1;
  });
}

GlissadeStatus glissade_glove_new(const char* name, const GlissadeDevice* device, GlissadeGlove* glove) {
  return call([&] {
    at(glove, "glove");
    auto object = std::make_shared<GloveObject>();
    object->relay = std::make_unique<devices::RelayGlove>(descriptor_of(&at(name, "name"), at(device, "device")));
    glove->id = gloves().add(std::move(object));
  });
}

GlissadeStatus glissade_glove_new_simulated(const double* times_s, const GlissadePose* X_WH, size_t count,
                                            GlissadeGlove* glove) {
  return call([&] {
    at(glove, "glove");
    auto object = std::make_shared<GloveObject>();
    object->simulated = std::make_unique<SimulatedGloveObject>(script_of(times_s, X_WH, count));
    glove->id = gloves().add(std::move(object));
  });
}

GlissadeStatus glissade_glove_free(GlissadeGlove glove) {
  return call([&] { gloves().remove(glove.id); });
}

GlissadeStatus glissade_glove_put(GlissadeGlove glove, const GlissadeGloveState* given) {
  return call_with(gloves(), glove.id, [&](GloveObject& object) {
    if (!object.relay) throw std::invalid_argument("the glove is simulated, so it drives itself");
    devices::GloveState state;
    // The envelope adds and subtracts times.
    if (at(given, "state").time_ns > kLatest_ns || given->time_ns < -kLatest_ns)
      throw std::invalid_argument("time_ns is beyond 73 years");
    state.time = nanoseconds(given->time_ns);
    state.X_WH = pose_of(given->X_WH, "X_WH");
    state.v_WH = vector_of(given->velocity_m_per_s, "velocity_m_per_s");
    state.w_WH = vector_of(given->angular_velocity_rad_per_s, "angular_velocity_rad_per_s");
    state.joint_angles = joints_of(given->joint_angles_rad);
    if (!std::all_of(state.joint_angles.begin(), state.joint_angles.end(), [](double a) { return std::isfinite(a); }))
      throw std::invalid_argument("joint_angles_rad has a number that is not finite");
    state.grip = given->grip;
    state.is_enabled = given->is_enabled != 0;
    object.relay->publish(state);
  });
}

GlissadeStatus glissade_glove_command(GlissadeGlove glove, GlissadeGloveCommand* out) {
  return call_with(gloves(), glove.id, [&](GloveObject& object) {
    at(out, "command");
    const devices::SafeCommand command =
        object.relay ? object.relay->newest_command() : object.simulated->exerted.latest();
    *out = {};
    copy(command.values().f_H_W, out->force_N);
    copy(command.values().t_H_W, out->torque_Nm);
    copy(command.values().joint_torques, out->joint_torques_Nm);
    out->reasons = devices::to_bits(command.reasons());
    out->age_ns = command.age().count();
  });
}

GlissadeStatus glissade_reason_text(int32_t reasons, int64_t age_ns, char* text, size_t capacity) {
  return call([&] {
    at(text, "text");
    if (capacity == 0) throw std::invalid_argument("capacity is 0");
    const std::string sentence = devices::to_text(devices::limit_reasons_from_bits(reasons), nanoseconds(age_ns));
    const std::size_t length = std::min(sentence.size(), capacity - 1);
    std::copy_n(sentence.begin(), length, text);
    text[length] = '\0';
  });
}
