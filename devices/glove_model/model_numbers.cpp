#include "glove_model/model_numbers.h"

#include <algorithm>

#include <glissade/files/text.h>

#include "glove_model/finger_dynamics.h"
#include "glove_model/finger_table.h"

namespace glissade::devices {
namespace {

using enum ModelSection;

constexpr double kMost = 1e6;      // of a number that physics bounds, not the simulation
constexpr double kFastest = 8000;  // Hz; the step of the fingers
constexpr double kLongest = 0.4;   // s

void add_wrist(GloveModel& m, std::vector<ModelNumber>& numbers) {
  WristModel& w = m.wrist;
  numbers.insert(numbers.end(),
                 {{kWrist, "position_noise_m", &w.position_noise, 0, 1, false},
                  {kWrist, "rotation_noise_rad", &w.rotation_noise, 0, 1, false},
                  {kGroundedWrist, "max_force_N", &w.max_force, 0, kMost, true},
                  {kGroundedWrist, "max_torque_Nm", &w.max_torque, 0, kMost, true},
                  {kGroundedWrist, "max_stiffness_N_per_m", &w.max_stiffness, 0, kMost, true},
                  {kGroundedWrist, "max_rotational_stiffness_Nm_per_rad", &w.max_rotational_stiffness, 0, kMost, true},
                  {kGroundedWrist, "max_damping_N_s_per_m", &w.max_damping, 0, kMost, true},
                  {kGroundedWrist, "damping_N_s_per_m", &w.damping, 0, 100, true},
                  {kGroundedWrist, "rotational_damping_Nm_s_per_rad", &w.rotational_damping, 0, 1, true},
                  {kHoldingWrist, "loop_rate_Hz", &w.loop_rate, 1, kFastest, true},
                  {kHoldingWrist, "loop_delay_s", &w.loop_delay, 0, kLongest, true}});
}

void add_wearer(GloveModel& m, std::vector<ModelNumber>& numbers) {
  FingerWearerModel& w = m.wearer;
  numbers.insert(numbers.end(), {{kWearer, "stiffness_Nm_per_rad", &w.stiffness, 0, 100, false},
                                 {kWearer, "damping_time_s", &w.damping_time, 0, kLongest, false},
                                 {kWearer, "stiffness_per_grip_per_rad", &w.stiffness_per_grip, 0, 100, false},
                                 {kWearer, "grip_Nm", &w.grip, 0, 10, false},
                                 {kWearer, "open_grip_Nm", &w.open_grip, 0, 10, false},
                                 {kWearer, "reflex_gain", &w.reflex_gain, 0, 10, false},
                                 {kWearer, "short_latency_s", &w.short_latency, 0, kLongest, false},
                                 {kWearer, "long_latency_s", &w.long_latency, 0, kLongest, false},
                                 {kWearer, "tremor_rad", &w.tremor, 0, 0.1, false},
                                 {kWearer, "tremor_lowest_Hz", &w.tremor_lowest, 0, 100, false},
                                 {kWearer, "tremor_highest_Hz", &w.tremor_highest, 0, 100, false},
                                 {kWearer, "glove_tip_mass_kg", &w.glove_tip_mass, 0, 1, false}});
}

void add_actuators(GloveModel& m, std::vector<ModelNumber>& numbers) {
  ActuatorModel& a = m.actuator;
  ServoModel& s = m.servo;
  StringModel& g = m.string;
  numbers.insert(numbers.end(), {{kIdealFingers, "max_joint_torque_Nm", &m.max_joint_torque, 0, 100, true},
                                 {kIdealFingers, "joint_damping_Nm_s_per_rad", &m.joint_damping, 0, 100, true},
                                 {kActuator, "motor_torque_Nm", &a.motor_torque, 0, 100, true},
                                 {kActuator, "brake_torque_Nm", &a.brake_torque, 0, 100, true},
                                 {kActuator, "gear_ratio", &a.gear_ratio, 1e-3, 1e4, true},
                                 {kActuator, "rotor_inertia_kg_m2", &a.rotor_inertia, 1e-12, 1, true},
                                 {kActuator, "coulomb_friction_Nm", &a.coulomb_friction, 0, 100, true},
                                 {kActuator, "viscous_friction_Nm_s_per_rad", &a.viscous_friction, 0, 100, true},
                                 {kActuator, "backlash_rad", &a.backlash, 0, 1, true},
                                 {kActuator, "link_stiffness_Nm_per_rad", &a.link_stiffness, 1e-3, kMost, true},
                                 {kActuator, "link_damping_Nm_s_per_rad", &a.link_damping, 0, 100, true},
                                 {kActuator, "bandwidth_Hz", &a.bandwidth, 1, kMost, true},
                                 {kServo, "rate_Hz", &s.rate, 1, kFastest, true},
                                 {kServo, "delay_s", &s.delay, 0, kLongest, true},
                                 {kServo, "resolution_rad", &s.resolution, 0, 1, true},
                                 {kServo, "max_stiffness_Nm_per_rad", &s.max_stiffness, 0, kMost, true},
                                 {kString, "stiffness_Nm_per_rad", &g.stiffness, 0, kMost, true},
                                 {kString, "damping_Nm_s_per_rad", &g.damping, 0, kMost, true},
                                 {kString, "torque_Nm", &g.torque, 0, 100, true},
                                 {kString, "speed_rad_per_s", &g.speed, 0, 1000, true}});
}

bool has_loop(FingerKind kind) {
  return kind == FingerKind::kTorque || kind == FingerKind::kJointLimit || kind == FingerKind::kCurlLimit ||
         kind == FingerKind::kBrake;
}

/// The strings pull explicitly. Semi-implicit Euler is stable while h² k + 2 h b < 4 / Σ 1/inertia; a quarter of that
/// keeps a margin.
bool are_strings_stable(const GloveModel& model) {
  double yielding = 0.0;
  for (const std::size_t joint : kFlexionsOfFingers.front()) {
    const CarriedPart& part = kCarriedParts[joint];
    yielding += 1.0 / (part.inertia + model.wearer.glove_tip_mass * part.lever * part.lever);
  }
  yielding += 1.0 / kFinger.inertia;
  const double h = std::chrono::duration<double>(kFingerStep).count();
  return (h * h * model.string.stiffness + 2.0 * h * model.string.damping) * yielding < 1.0;
}

}  // namespace

std::vector<ModelNumber> numbers_of(GloveModel& m) {
  std::vector<ModelNumber> numbers{{kRoot, "update_rate_Hz", &m.update_rate, 1, 1e5, true},
                                   {kRoot, "measurement_delay_s", &m.measurement_delay, 0, kLongest, false}};
  add_wrist(m, numbers);
  add_wearer(m, numbers);
  add_actuators(m, numbers);
  JointSensorModel& s = m.sensor;
  LinkModel& l = m.link;
  numbers.insert(numbers.end(), {{kSensor, "resolution_rad", &s.resolution, 0, 1, false},
                                 {kSensor, "noise_rad", &s.noise, 0, 1, false},
                                 {kSensor, "drift_rad", &s.drift, 0, 1, false},
                                 {kSensor, "drift_time_s", &s.drift_time, 1e-3, kMost, false},
                                 {kLink, "delay_s", &l.delay, 0, kLongest, false},
                                 {kLink, "jitter_s", &l.jitter, 0, kLongest, false},
                                 {kLink, "loss", &l.loss, 0, 1, false}});
  return numbers;
}

std::string_view key_of(ModelSection section) noexcept {
  constexpr std::array<std::string_view, 11> kKeys{"",
                                                   "wrist",
                                                   "wrist",
                                                   "wrist",
                                                   "fingers",
                                                   "fingers.wearer",
                                                   "fingers.actuator",
                                                   "fingers.servo",
                                                   "fingers.string",
                                                   "fingers.sensor",
                                                   "link"};
  return kKeys[static_cast<std::size_t>(section)];
}

bool has_section(const GloveModel& model, ModelSection section) noexcept {
  const FingerKind kind = model.fingers;
  switch (section) {
    case kGroundedWrist:
      return model.wrist.is_grounded;
    case kHoldingWrist:
      return model.wrist.holds_half_spaces;
    case kIdealFingers:
      return kind == FingerKind::kIdeal;
    case kWearer:
    case kSensor:
      return kind != FingerKind::kAbsent && kind != FingerKind::kIdeal;
    case kActuator:
      return has_loop(kind) && kind != FingerKind::kCurlLimit;
    case kServo:
      return has_loop(kind);
    case kString:
      return kind == FingerKind::kCurlLimit;
    default:
      return true;
  }
}

std::string contradiction_in(const GloveModel& model) {
  if (model.wearer.tremor_lowest > model.wearer.tremor_highest)
    return "the lowest frequency of the tremor must not exceed the highest";
  if (has_section(model, kActuator)) {
    const auto& driven = model.actuator.is_driven;
    if (std::none_of(driven.begin(), driven.end(), [](bool is) { return is; })) return "the actuators drive no joint";
    if (model.fingers == FingerKind::kBrake && model.actuator.motor_torque > 0.0)
      return "fingers of kind brake have no motor, so motor_torque_Nm must be 0";
    if (model.fingers == FingerKind::kTorque && model.actuator.brake_torque > 0.0)
      return "fingers of kind torque have no brake, so brake_torque_Nm must be 0";
  }
  if (model.fingers == FingerKind::kCurlLimit && !are_strings_stable(model))
    return "the strings are too stiff or too damped to be simulated at 8 kHz";
  return "";
}

std::string out_of_range(const ModelNumber& number, double value) {
  return "must lie between " + files::format_number(number.least) + " and " + files::format_number(number.most) +
         ", not " + files::format_number(value);
}

}  // namespace glissade::devices
