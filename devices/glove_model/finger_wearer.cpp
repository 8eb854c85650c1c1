#include "glove_model/finger_wearer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "glove_model/random_numbers.h"

namespace glissade::devices {

FingerWearer::FingerWearer(const FingerWearerModel& model, const hands::JointValues& angles, std::uint64_t seed,
                           double h)
    : model_(model),
      short_steps_(static_cast<std::size_t>(std::lround(model.short_latency / h))),
      long_steps_(static_cast<std::size_t>(std::lround(model.long_latency / h))),
      felt_angles_(angles),
      felt_share_(h / (model.long_latency + h)) {
  past_loads_.resize(std::max(short_steps_, long_steps_) + 1);
  constexpr std::uint64_t kStream = 1;
  RandomNumbers random(seed, kStream);
  for (std::size_t i = 0; i < hands::kJoints; ++i) {
    const double frequency = std::lerp(model.tremor_lowest, model.tremor_highest, random.uniform());
    const double phase = 2.0 * std::numbers::pi * random.uniform();
    phasors_[i] = std::polar(std::numbers::sqrt2 * model.tremor, phase);
    turns_[i] = std::polar(1.0, 2.0 * std::numbers::pi * frequency * h);
  }
}

void FingerWearer::advance(const hands::JointValues& angles, const hands::JointValues& loads) noexcept {
  newest_ = (newest_ + 1) % past_loads_.size();
  short_ = (newest_ + past_loads_.size() - short_steps_) % past_loads_.size();
  long_ = (newest_ + past_loads_.size() - long_steps_) % past_loads_.size();
  for (std::size_t i = 0; i < hands::kJoints; ++i) {
    past_loads_[newest_][i] = std::abs(loads[i]);
    felt_angles_[i] += felt_share_ * (angles[i] - felt_angles_[i]);
    const std::complex<double> phasor = phasors_[i];
    const std::complex<double> turn = turns_[i];
    // Not operator*, which handles infinity and costs more.
    phasors_[i] = {phasor.real() * turn.real() - phasor.imag() * turn.imag(),
                   phasor.real() * turn.imag() + phasor.imag() * turn.real()};
  }
}

double FingerWearer::stiffness(std::size_t joint, double grip) const noexcept {
  const double reflex = model_.reflex_gain * 0.5 * (past_loads_[short_][joint] + past_loads_[long_][joint]);
  return model_.stiffness + model_.stiffness_per_grip * (grip + reflex);
}

double FingerWearer::aim(std::size_t joint, double wanted, double grip) const noexcept {
  const double tremor = phasors_[joint].real();
  if (grip <= 0.0) return wanted + tremor;
  const double felt = felt_angles_[joint];
  const double reach = grip / stiffness(joint, grip);
  return std::clamp(wanted, felt - reach, felt + reach) + tremor;
}

}  // namespace glissade::devices
