#pragma once

/// The wearer's muscles: stiffness by grip and reflex, and tremor.

#include <array>
#include <chrono>
#include <complex>
#include <vector>

#include <glissade/devices/glove_model.h>
#include <glissade/hands/hand.h>

namespace glissade::devices {

/// One step after the other, all of the same length. Allocates only at construction.
class FingerWearer {
 public:
  /// The fingers rest at `angles` (rad). `h` is the length of a step, s.
  FingerWearer(const FingerWearerModel& model, const hands::JointValues& angles, std::uint64_t seed, double h);

  /// Call this function once a step, before the functions below. `angles` are those of the joints (rad), `loads` the
  /// torques of the device on them (Nm).
  void advance(const hands::JointValues& angles, const hands::JointValues& loads) noexcept;

  /// Stiffness of a joint (Nm/rad) with this voluntary grip (Nm). Cost O(1).
  double stiffness(std::size_t joint, double grip) const noexcept;
  /// The angle (rad) at which the wearer's spring is at rest, for a hand that intends to be at `wanted`. A finger that
  /// is stopped presses with the grip: the angle is no farther away than the grip over the stiffness from where the
  /// wearer feels the finger, i.e. from its angle behind a lag of the long latency. Without a grip, the finger is a
  /// spring about `wanted`. The angle trembles.
  double aim(std::size_t joint, double wanted, double grip) const noexcept;

 private:
  FingerWearerModel model_;
  std::vector<hands::JointValues> past_loads_;  ///< absolute values, a ring of one entry per step
  std::size_t short_steps_;                     ///< the latencies
  std::size_t long_steps_;
  std::size_t newest_ = 0;  ///< entries of now and of the latencies ago
  std::size_t short_ = 0;
  std::size_t long_ = 0;
  hands::JointValues felt_angles_;  ///< rad, those of the joints behind a first-order lag of the long latency
  double felt_share_;               ///< of the way to the angles, in a step
  std::array<std::complex<double>, hands::kJoints> phasors_{};
  std::array<std::complex<double>, hands::kJoints> turns_{};  ///< of a phasor in a step
};

}  // namespace glissade::devices
