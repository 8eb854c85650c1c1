#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <glissade/devices/glove_model.h>
#include <glissade/devices/simulated_glove.h>

#include "glove_model/modelled_glove.h"

namespace glissade::devices {
namespace {

constexpr std::chrono::nanoseconds kLargestStep = std::chrono::milliseconds(1);
// Periods of the device.
constexpr double kCommandLasts = 3.0;
constexpr double kCommandFades = 7.0;

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

/// Axis times angle, 0 to π.
Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& q) {
  const Eigen::AngleAxisd turn(q);
  return turn.angle() * turn.axis();
}

Eigen::Quaterniond from_rotation_vector(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

void check_sign(std::string_view name, double value, bool may_be_zero) {
  const bool is_fine = std::isfinite(value) && (may_be_zero ? value >= 0.0 : value > 0.0);
  if (is_fine) return;
  throw std::invalid_argument("Simulated glove: " + std::string(name) + " must be finite and " +
                              (may_be_zero ? "not negative." : "positive."));
}

/// Semi-implicit Euler of a mass on a spring and damper is stable while h² k + 2 h b < 4 m; half of that keeps a margin
/// for the stiffness that is rendered on top.
void check_stable(std::string_view what, double inertia, double stiffness, double damping) {
  const double h = std::chrono::duration<double>(kLargestStep).count();
  if (h * h * stiffness + 2.0 * h * damping < 2.0 * inertia) return;
  throw std::invalid_argument("Simulated glove: the wearer's " + std::string(what) +
                              " stiffness or damping is too large for the inertia to be simulated in steps of 1 ms.");
}

void check_posture(std::string_view name, const hands::JointValues& posture) {
  for (std::size_t i = 0; i < hands::kJoints; ++i) {
    if (std::isfinite(posture[i])) continue;
    throw std::invalid_argument("Simulated glove: " + std::string(name) + " of " + std::string(hands::kJointNames[i]) +
                                " is not finite.");
  }
}

void check(const SimulatedGloveParameters& p) {
  check_sign("mass", p.mass, false);
  check_sign("rotational_inertia", p.rotational_inertia, false);
  check_sign("arm_damping", p.arm_damping, true);
  check_sign("arm_rotational_damping", p.arm_rotational_damping, true);
  check_sign("wearer_stiffness", p.wearer_stiffness, false);
  check_sign("wearer_damping", p.wearer_damping, true);
  check_sign("wearer_rotational_stiffness", p.wearer_rotational_stiffness, false);
  check_sign("wearer_rotational_damping", p.wearer_rotational_damping, true);
  check_sign("finger_stiffness", p.finger_stiffness, false);
  check_sign("finger_time_constant", p.finger_time_constant, false);
  check_stable("linear", p.mass, p.wearer_stiffness, p.wearer_damping + p.arm_damping);
  check_stable("rotational", p.rotational_inertia, p.wearer_rotational_stiffness,
               p.wearer_rotational_damping + p.arm_rotational_damping);
  check_posture("grasp_posture", p.grasp_posture);
  if (p.open_posture) check_posture("open_posture", *p.open_posture);
  for (std::size_t i = 0; i < p.fingers.size(); ++i) {
    check_posture("fingers", p.fingers[i].angles);
    if (i > 0 && p.fingers[i].time <= p.fingers[i - 1].time)
      throw std::invalid_argument("Simulated glove: the times of the fingers must rise.");
  }
}

/// The wearer's parameters with the arm of the model.
SimulatedGloveParameters of_model(SimulatedGloveParameters parameters, const GloveModel& model) {
  validate(model);
  parameters.arm_damping = model.wrist.damping;
  parameters.arm_rotational_damping = model.wrist.rotational_damping;
  return parameters;
}

}  // namespace

hands::JointValues angles_at(const std::vector<TimedAngles>& timed, std::chrono::nanoseconds time) noexcept {
  const auto next =
      std::upper_bound(timed.begin(), timed.end(), time,
                       [](std::chrono::nanoseconds t, const TimedAngles& entry) { return t < entry.time; });
  if (next == timed.begin()) return timed.front().angles;
  if (next == timed.end()) return timed.back().angles;
  const TimedAngles& before = *(next - 1);
  const double share =
      static_cast<double>((time - before.time).count()) / static_cast<double>((next->time - before.time).count());
  hands::JointValues angles{};
  for (std::size_t i = 0; i < angles.size(); ++i)
    angles[i] = before.angles[i] + share * (next->angles[i] - before.angles[i]);
  return angles;
}

DeviceDescriptor simulated_glove_descriptor() {
  DeviceDescriptor descriptor;
  descriptor.name = "simulated glove";
  descriptor.max_force = 20.0;
  descriptor.max_torque = 1.0;
  descriptor.max_stiffness = 4000.0;
  descriptor.max_rotational_stiffness = 10.0;
  descriptor.max_damping = 30.0;
  descriptor.max_joint_torque = 0.5;
  descriptor.damping = kArmDamping;
  descriptor.rotational_damping = kArmRotationalDamping;
  descriptor.joint_damping = kJointDamping;
  descriptor.max_power = 40.0;
  for (std::size_t i = 0; i < hands::kJointRanges.size(); ++i) {
    descriptor.joint_lower[i] = hands::kJointRanges[i].lower_deg * kRadiansPerDegree;
    descriptor.joint_upper[i] = hands::kJointRanges[i].upper_deg * kRadiansPerDegree;
  }
  descriptor.update_rate = 1000.0;
  return descriptor;
}

SimulatedGlove::SimulatedGlove(geometry::PoseTrajectory script_X_WH, const SimulatedGloveParameters& parameters)
    : script_X_WH_(std::move(script_X_WH)),
      parameters_(parameters),
      descriptor_(simulated_glove_descriptor()),
      script_time_(script_X_WH_.first_time()) {
  check(parameters_);
  descriptor_.frozen = parameters_.frozen;
  truth_.time = script_time_;
  truth_.grip = grip_at(script_time_);
  truth_.X_WH = script_X_WH_.pose_at(script_time_);
  q_WH_ = Eigen::Quaterniond(truth_.X_WH.linear());
  const hands::JointValues aim = aim_of_fingers();
  for (std::size_t i = 0; i < hands::kJoints; ++i) {
    truth_.joint_angles[i] = std::clamp(aim[i], descriptor_.joint_lower[i], descriptor_.joint_upper[i]);
  }
  state_ = truth_;
}

SimulatedGlove::SimulatedGlove(geometry::PoseTrajectory script_X_WH, const SimulatedGloveParameters& parameters,
                               const GloveModel& model)
    : SimulatedGlove(std::move(script_X_WH), of_model(parameters, model)) {
  descriptor_ = descriptor_of(model);
  descriptor_.frozen = parameters.frozen;
  if (model.fingers == FingerKind::kAbsent) truth_.joint_angles = {};
  state_ = truth_;
  modelled_ = std::make_unique<ModelledGlove>(model, truth_);
}

SimulatedGlove::SimulatedGlove(const SimulatedGlove& other)
    : script_X_WH_(other.script_X_WH_),
      parameters_(other.parameters_),
      descriptor_(other.descriptor_),
      truth_(other.truth_),
      state_(other.state_),
      script_time_(other.script_time_),
      q_WH_(other.q_WH_),
      felt_torques_(other.felt_torques_),
      modelled_(other.modelled_ ? std::make_unique<ModelledGlove>(*other.modelled_) : nullptr) {}

SimulatedGlove::SimulatedGlove(SimulatedGlove&&) noexcept = default;
SimulatedGlove::~SimulatedGlove() = default;

SimulatedGlove& SimulatedGlove::operator=(SimulatedGlove other) noexcept {
  script_X_WH_ = std::move(other.script_X_WH_);
  parameters_ = std::move(other.parameters_);
  descriptor_ = std::move(other.descriptor_);
  truth_ = other.truth_;
  state_ = other.state_;
  script_time_ = other.script_time_;
  q_WH_ = other.q_WH_;
  felt_torques_ = other.felt_torques_;
  modelled_ = std::move(other.modelled_);
  return *this;
}

LinkLosses SimulatedGlove::link_losses() const noexcept {
  return modelled_ ? modelled_->losses() : LinkLosses{};
}

GloveState SimulatedGlove::step(std::chrono::nanoseconds dt, const SafeCommand& newest, double pace) noexcept {
  if (modelled_) modelled_->hear(newest, truth_.time);
  const GloveCommand& command = modelled_ ? modelled_->command().values() : newest.values();
  const std::chrono::nanoseconds heard_at = modelled_ ? modelled_->heard_at() : truth_.time;
  const double arm = !modelled_ || modelled_->model().wrist.is_grounded ? 1.0 : 0.0;
  ToolLoop* const tool = modelled_ ? modelled_->tool() : nullptr;
  const std::chrono::nanoseconds step = tool != nullptr ? kFingerStep : kLargestStep;
  for (std::chrono::nanoseconds passed{0}; passed < dt;) {
    const std::chrono::nanoseconds now = std::min(dt - passed, step);
    const std::chrono::nanoseconds age = truth_.time - heard_at;
    const double h = std::chrono::duration<double>(now).count();
    const double share = share_of_command(age + now / 2);
    const HandWrench held = tool != nullptr ? tool->advance(truth_, command.half_spaces, age) : HandWrench{};
    move_hand(h, pace, arm * share * command.f_H_W + held.f_H_W);
    turn_hand(h, pace, arm * share * command.t_H_W + held.t_H_W);
    if (modelled_ && modelled_->fingers() != nullptr) {
      move_modelled_fingers(now, age, share, command);
    } else {
      move_fingers(h, share, command.joint_torques);
    }
    truth_.time += now;
    script_time_ += pace == 1.0 ? now : std::chrono::nanoseconds(std::llround(pace * static_cast<double>(now.count())));
    passed += now;
  }
  ++truth_.sequence;
  truth_.grip = grip_at(script_time_);
  if (modelled_) modelled_->measure(truth_);
  state_ = modelled_ ? modelled_->state() : truth_;
  return state_;
}

/// What the glove still exerts of a command that has not been renewed for so long.
double SimulatedGlove::share_of_command(std::chrono::nanoseconds age) const noexcept {
  const double periods = std::chrono::duration<double>(age).count() * descriptor_.update_rate;
  return std::clamp(1.0 - (periods - kCommandLasts) / kCommandFades, 0.0, 1.0);
}

std::int64_t SimulatedGlove::grip_at(std::chrono::nanoseconds time) const noexcept {
  const auto& changes = parameters_.grip_changes;
  return (parameters_.starts_closed ? 1 : 0) +
         (std::upper_bound(changes.begin(), changes.end(), time) - changes.begin());
}

hands::JointValues SimulatedGlove::aim_of_fingers() const noexcept {
  if (!parameters_.fingers.empty()) return angles_at(parameters_.fingers, script_time_);
  const bool is_open = grip_at(script_time_) % 2 == 0;
  return is_open && parameters_.open_posture ? *parameters_.open_posture : parameters_.grasp_posture;
}

void SimulatedGlove::move_hand(double h, double pace, const Eigen::Vector3d& f_H_W) noexcept {
  const Eigen::Vector3d p_WScript = script_X_WH_.pose_at(script_time_).translation();
  const Eigen::Vector3d v_WScript = pace * script_X_WH_.velocity_at(script_time_).v_WB;
  const Eigen::Vector3d sum_W = parameters_.wearer_stiffness * (p_WScript - truth_.X_WH.translation()) +
                                parameters_.wearer_damping * (v_WScript - truth_.v_WH) -
                                parameters_.arm_damping * truth_.v_WH + f_H_W;
  truth_.v_WH += h / parameters_.mass * sum_W;
  truth_.X_WH.translation() += h * truth_.v_WH;
}

void SimulatedGlove::turn_hand(double h, double pace, const Eigen::Vector3d& t_H_W) noexcept {
  const Eigen::Quaterniond q_WScript(script_X_WH_.pose_at(script_time_).linear());
  const Eigen::Vector3d w_WScript = pace * script_X_WH_.velocity_at(script_time_).w_WB;
  const Eigen::Vector3d to_script_W = rotation_vector(q_WScript * q_WH_.conjugate());
  // The inertia is the same about every axis, so there is no gyroscopic torque.
  const Eigen::Vector3d sum_W = parameters_.wearer_rotational_stiffness * to_script_W +
                                parameters_.wearer_rotational_damping * (w_WScript - truth_.w_WH) -
                                parameters_.arm_rotational_damping * truth_.w_WH + t_H_W;
  truth_.w_WH += h / parameters_.rotational_inertia * sum_W;
  q_WH_ = (from_rotation_vector(h * truth_.w_WH) * q_WH_).normalized();
  truth_.X_WH.linear() = q_WH_.toRotationMatrix();
}

// Fingers weigh little: each approaches the equilibrium of the wearer's grip and the torque without overshoot.
void SimulatedGlove::move_fingers(double h, double share, const hands::JointValues& torques) noexcept {
  const double part = -std::expm1(-h / parameters_.finger_time_constant);
  const hands::JointValues aim = aim_of_fingers();
  for (std::size_t i = 0; i < hands::kJoints; ++i) {
    felt_torques_[i] = share * torques[i];
    const double balance = aim[i] + felt_torques_[i] / parameters_.finger_stiffness;
    double& angle = truth_.joint_angles[i];
    angle = std::clamp(angle + part * (balance - angle), descriptor_.joint_lower[i], descriptor_.joint_upper[i]);
  }
}

void SimulatedGlove::move_modelled_fingers(std::chrono::nanoseconds dt, std::chrono::nanoseconds age, double share,
                                           const GloveCommand& command) noexcept {
  FingerOrder order{.torques = command.joint_torques, .limits = &command.joint_limits, .age = age};
  for (double& torque : order.torques)
    torque *= share;
  FingerDynamics& fingers = *modelled_->fingers();
  fingers.advance(dt, aim_of_fingers(), grip_at(script_time_) % 2 == 1, order);
  truth_.joint_angles = fingers.angles();
  felt_torques_ = fingers.loads();
}

}  // namespace glissade::devices
