#include <stdexcept>

#include <glissade/devices/glove_model.h>

#include "glove_model/finger_dynamics.h"
#include "glove_model/finger_table.h"

namespace glissade::devices {
namespace {

/// The model whose motors exert a given torque at once: the firmware has the loop and its delay.
GloveModel without_loop(GloveModel model) {
  validate(model);
  if (model.fingers == FingerKind::kCurlLimit) return model;
  if (model.fingers != FingerKind::kJointLimit)
    throw std::invalid_argument("Glove model '" + model.name +
                                "': an emulated firmware drives fingers of kind joint-limit or curl-limit only.");
  model.fingers = FingerKind::kTorque;
  model.servo.rate = 1.0 / std::chrono::duration<double>(kFingerStep).count();
  model.servo.delay = 0.0;
  return model;
}

DrivenFingers::PerFinger open_sums() {
  hands::JointValues angles{};
  for (std::size_t i = 0; i < hands::kJoints; ++i)
    angles[i] = radians(hands::kJointRanges[i].upper_deg);
  return flexion_sums(angles);
}

}  // namespace

struct DrivenFingers::Drive {
  FingerDynamics dynamics;
  hands::JointValues torques{};
  PerFinger taut_sums = open_sums();
};

DrivenFingers::DrivenFingers(const GloveModel& model, const hands::JointValues& angles)
    : drive_(std::make_unique<Drive>(Drive{FingerDynamics(without_loop(model), angles)})) {}

DrivenFingers::~DrivenFingers() = default;

void DrivenFingers::set_torques(const hands::JointValues& torques) noexcept {
  drive_->torques = torques;
}

void DrivenFingers::set_strings(const PerFinger& taut_sums) noexcept {
  drive_->taut_sums = taut_sums;
}

void DrivenFingers::advance(std::chrono::nanoseconds dt, const hands::JointValues& aims, bool is_closed) noexcept {
  drive_->dynamics.advance(dt, aims, is_closed, {.torques = drive_->torques, .taut_sums = &drive_->taut_sums});
}

const hands::JointValues& DrivenFingers::angles() const noexcept {
  return drive_->dynamics.angles();
}

const hands::JointValues& DrivenFingers::actuator_angles() const noexcept {
  return drive_->dynamics.actuator_angles();
}

const hands::JointValues& DrivenFingers::actuator_rates() const noexcept {
  return drive_->dynamics.actuator_rates();
}

DrivenFingers::PerFinger DrivenFingers::flexion_sums() const noexcept {
  return devices::flexion_sums(angles());
}

DrivenFingers::PerFinger flexion_sums(const hands::JointValues& angles) noexcept {
  DrivenFingers::PerFinger sums{};
  for (std::size_t f = 0; f < sums.size(); ++f) {
    for (const std::size_t joint : kFlexionsOfFingers[f])
      sums[f] += angles[joint];
  }
  return sums;
}

}  // namespace glissade::devices
