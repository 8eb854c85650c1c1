#include "glove_model/modelled_glove.h"

#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace glissade::devices {
namespace {

constexpr std::uint64_t kSensorStream = 2;
constexpr std::uint64_t kLinkStream = 3;

bool has_dynamics(FingerKind kind) {
  return kind != FingerKind::kAbsent && kind != FingerKind::kIdeal;
}

Eigen::Vector3d normal_vector(RandomNumbers& random, double deviation) noexcept {
  const double x = random.normal();
  const double y = random.normal();
  const double z = random.normal();
  return deviation * Eigen::Vector3d(x, y, z);
}

/// Rotation of a vector of axis times angle.
Eigen::Quaterniond turned_by(const Eigen::Vector3d& rotation) noexcept {
  const double angle = rotation.norm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation / angle));
}

}  // namespace

ModelledGlove::ModelledGlove(const GloveModel& model, const GloveState& start)
    : model_(model),
      sensor_random_(model.seed, kSensorStream),
      link_random_(model.seed, kLinkStream),
      period_(nanoseconds_of(1.0 / model.update_rate)),
      next_(start.time + period_),
      last_measured_(start),
      states_(delay_line_capacity(model.measurement_delay + model.link.delay + model.link.jitter, model.update_rate)),
      state_(start),
      commands_(delay_line_capacity(model.link.delay + model.link.jitter, model.update_rate)),
      heard_at_(start.time) {
  if (has_dynamics(model.fingers)) fingers_.emplace(model, start.joint_angles);
  if (model.wrist.holds_half_spaces) tool_.emplace(model.wrist, start.time);
}

std::chrono::nanoseconds ModelledGlove::link_delay() noexcept {
  return nanoseconds_of(model_.link.delay + model_.link.jitter * link_random_.uniform());
}

void ModelledGlove::hear(const SafeCommand& newest, std::chrono::nanoseconds now) noexcept {
  if (std::exchange(has_measured_, false)) {
    if (is_lost()) {
      ++lost_.commands;
    } else {
      commands_.push(newest, now + link_delay());
    }
  }
  if (commands_.take(now, command_)) heard_at_ = now;
}

void ModelledGlove::measure(const GloveState& truth) noexcept {
  if (truth.time >= next_) {
    while (next_ <= truth.time)
      next_ += period_;
    last_measured_ = measured(truth);
    has_measured_ = true;
    if (is_lost()) {
      ++lost_.states;
    } else {
      states_.push(last_measured_, truth.time + nanoseconds_of(model_.measurement_delay) + link_delay());
    }
  }
  states_.take(truth.time, state_);
}

/// A tracker with noise finds velocities from two poses.
GloveState ModelledGlove::measured(const GloveState& truth) noexcept {
  GloveState state = truth;
  state.sequence = last_measured_.sequence + 1;
  const WristModel& wrist = model_.wrist;
  const double dt = std::chrono::duration<double>(truth.time - last_measured_.time).count();
  if (wrist.position_noise > 0.0) {
    state.X_WH.translation() += normal_vector(sensor_random_, wrist.position_noise);
    state.v_WH = (state.X_WH.translation() - last_measured_.X_WH.translation()) / dt;
  }
  if (wrist.rotation_noise > 0.0) {
    const Eigen::Quaterniond noise = turned_by(normal_vector(sensor_random_, wrist.rotation_noise));
    state.X_WH.linear() = (noise * Eigen::Quaterniond(truth.X_WH.linear())).toRotationMatrix();
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(state.X_WH.linear() * last_measured_.X_WH.linear().transpose()));
    state.w_WH = turn.angle() / dt * turn.axis();
  }
  if (!fingers_) return state;
  const JointSensorModel& sensor = model_.sensor;
  const double kept = std::exp(-dt / sensor.drift_time);
  const double added = sensor.drift * std::sqrt(1.0 - kept * kept);
  for (std::size_t i = 0; i < hands::kJoints; ++i) {
    if (sensor.drift > 0.0) drifts_[i] = kept * drifts_[i] + added * sensor_random_.normal();
    const double noise = sensor.noise > 0.0 ? sensor.noise * sensor_random_.normal() : 0.0;
    state.joint_angles[i] = quantised(truth.joint_angles[i] + drifts_[i] + noise, sensor.resolution);
  }
  return state;
}

}  // namespace glissade::devices
