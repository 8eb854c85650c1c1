#pragma once

/// The emulated Inverse3 and the hand that holds it.

#include <chrono>
#include <cstdint>

#include <Eigen/Core>

#include <glissade/bridges/haply.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>

namespace glissade::bridges {

/// Weakens a force that turns round often.
class OscillationGate {
 public:
  /// The share of the force that passes.
  double pass(const Eigen::Vector3d& force, std::chrono::nanoseconds now, double gain);

 private:
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero();
  std::chrono::nanoseconds window_start_{0};
  int turns_ = 0;
  bool is_closed_ = false;
};

/// One thread.
class EmulatedArm {
 public:
  EmulatedArm(devices::SimulatedGlove hand, const HaplyFilters& filters, std::chrono::nanoseconds now);

  /// The force `f_C_D` has acted since the last call. The wearer's script runs if `goes_on`.
  void advance(std::chrono::nanoseconds now, const Eigen::Vector3d& f_C_D, double damping_N_s_per_m, bool goes_on);

  /// What the arm exerts, after the filters.
  const Eigen::Vector3d& force() const noexcept { return exerted_; }
  /// What it measures, in the frame of the device.
  const devices::GloveState& state() const noexcept { return hand_.state(); }

 private:
  devices::SimulatedGlove hand_;
  devices::SafetyEnvelope envelope_;
  HaplyFilters filters_;
  OscillationGate gate_;
  std::chrono::nanoseconds last_;
  Eigen::Vector3d exerted_ = Eigen::Vector3d::Zero();
  std::int64_t commands_ = 0;
};

}  // namespace glissade::bridges
