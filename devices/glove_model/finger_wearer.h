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
  /// `h` is the length of a step, s.
  FingerWearer(const FingerWearerModel& model, std::uint64_t seed, double h);

  /// Call this function once a step, before the functions below. `loads` are the torques of the device on the joints,
  /// Nm.
  void advance(const hands::JointValues& loads) noexcept;

  /// Stiffness of a joint (Nm/rad) with this voluntary grip (Nm). Cost O(1).
  double stiffness(std::size_t joint, double grip) const noexcept;
  /// Deviation of a joint's intended angle, rad.
  double tremor(std::size_t joint) const noexcept { return phasors_[joint].real(); }

 private:
  FingerWearerModel model_;
  std::vector<hands::JointValues> past_loads_;  ///< absolute values, a ring of one entry per step
  std::size_t short_steps_;                     ///< the latencies
  std::size_t long_steps_;
  std::size_t newest_ = 0;  ///< entries of now and of the latencies ago
  std::size_t short_ = 0;
  std::size_t long_ = 0;
  std::array<std::complex<double>, hands::kJoints> phasors_{};
  std::array<std::complex<double>, hands::kJoints> turns_{};  ///< of a phasor in a step
};

}  // namespace glissade::devices
