#pragma once

/// The limits of finger joints on their way to a device which holds them by itself.

#include <chrono>
#include <optional>

#include "envelope/fade.h"
#include "envelope/forces.h"

namespace glissade::devices {

/// Keeps limits within the device's torque and stiffness. Lets them tighten so that no torque rises faster than the
/// device's rate, and the springs gain no more energy than an account pays for. Opens them in a fade.
///
/// A limit that stands still is a spring, which gives back no more than the finger has put in. Only a limit that moves
/// against a finger gives energy: the difference of what its spring stores. The account begins with 20 mJ, and gets
/// back what limits give up that move away, what a fade has taken from fingers that are still there, and 5 mW, to at
/// most the largest torque times 0.5 rad. Once all fingers have rested for 0.2 s, it gets 0.2 W, so that limits return
/// to fingers that went into an object during an interruption.
class FingerLimits {
 public:
  explicit FingerLimits(const DeviceDescriptor& descriptor, double period_s);

  /// The limits for this period, `dt` (seconds) after the last one. `angles` are the newest of the device (rad).
  const JointLimits& limit(const JointLimits& wanted, const hands::JointValues& angles, bool is_fading,
                           const Fade& fade, double dt, LimitReasons& reasons) noexcept;

  /// The device has dropped the limits. Returns whether there were any.
  bool drop() noexcept;

 private:
  JointLimit within_device(std::size_t joint, const JointLimit& wanted, LimitReasons& reasons) const noexcept;
  bool tighten(JointLimit& limit, const JointLimit& last, double angle, double dt) const noexcept;
  void observe_rates(const hands::JointValues& angles, double dt) noexcept;
  void remember() noexcept;
  void settle_fade(const hands::JointValues& angles) noexcept;
  bool pay(const hands::JointValues& angles, JointLimits& next, double dt) noexcept;

  const DeviceDescriptor& descriptor_;
  double stiffness_;    // Nm/rad, at most
  double torque_rate_;  // Nm/s
  double fade_s_;
  std::chrono::nanoseconds expiry_;
  double energy_;  // J
  JointLimits last_;
  std::optional<JointLimits> before_fade_;
  hands::JointValues angles_before_fade_{};
  hands::JointValues newest_angles_{};  // in the last call
  hands::JointValues last_angles_{};    // within their play
  hands::JointValues rates_{};          // rad/s, smoothed
  double resting_for_s_ = 0.0;          // all fingers
};

}  // namespace glissade::devices
