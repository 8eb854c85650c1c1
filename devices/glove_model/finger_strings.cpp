#include <algorithm>
#include <array>

#include "glove_model/finger_actuators.h"
#include "glove_model/finger_table.h"

namespace glissade::devices {

FingerStrings::FingerStrings(const GloveModel& model)
    : string_(model.string),
      servo_(model.servo),
      period_(nanoseconds_of(1.0 / model.servo.rate)),
      delay_(nanoseconds_of(model.servo.delay)),
      on_the_way_(delay_line_capacity(model.servo.delay, model.servo.rate)) {
  for (std::size_t f = 0; f < kFingers; ++f) {
    for (const std::size_t joint : kFlexionsOfFingers[f])
      open_[f] += radians(hands::kJointRanges[joint].upper_deg);
  }
  wanted_ = held_ = open_;
}

/// The driver's limit of each finger: the string becomes taut where a contact closes, if the joints go on in the
/// proportion of their ranges.
FingerStrings::CurlValues FingerStrings::limits_of(const FingerOrder& order,
                                                   const hands::JointValues& angles) const noexcept {
  if (order.taut_sums != nullptr) return *order.taut_sums;
  CurlValues curls = open_;
  if (order.limits == nullptr || order.age > order.limits->expiry) return curls;
  for (std::size_t f = 0; f < kFingers; ++f) {
    hands::JointValues measured{};
    std::array<JointWay, 3> ways{};
    double sum = 0.0;
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const std::size_t joint = kFlexionsOfFingers[f][i];
      measured[joint] = quantised(angles[joint], servo_.resolution);
      sum += measured[joint];
      ways[i] = {joint, radians(hands::kJointRanges[joint].upper_deg)};
    }
    curls[f] = std::min(curls[f], sum + open_[f] * way_left(ways, *order.limits, measured));
  }
  return curls;
}

void FingerStrings::advance(std::chrono::nanoseconds now, double h, const FingerOrder& order,
                            const hands::JointValues& angles, const hands::JointValues& rates) noexcept {
  if (now >= next_) {
    on_the_way_.push(limits_of(order, angles), now + delay_);
    next_ += period_;
  }
  on_the_way_.take(now, wanted_);
  for (std::size_t f = 0; f < kFingers; ++f) {
    held_[f] += std::clamp(wanted_[f] - held_[f], -string_.speed * h, string_.speed * h);
    double excess = -held_[f];
    double rate = 0.0;
    for (const std::size_t joint : kFlexionsOfFingers[f]) {
      excess += angles[joint];
      rate += rates[joint];
    }
    const double pull = excess > 0.0 ? string_.stiffness * excess + string_.damping * rate : 0.0;
    for (const std::size_t joint : kFlexionsOfFingers[f])
      torques_[joint] = -std::clamp(pull, 0.0, string_.torque);
  }
}

}  // namespace glissade::devices
