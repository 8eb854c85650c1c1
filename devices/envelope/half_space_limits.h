#pragma once

/// The half-spaces of the hand root on their way to a device which holds them by itself.

#include <chrono>
#include <optional>

#include "envelope/fade.h"
#include "envelope/forces.h"
#include "envelope/simple_limits.h"
#include "envelope/strokes.h"

namespace glissade::devices {

/// What the energy limit is to know of half-spaces.
struct HeldEnergy {
  bool presses = false;   ///< the hand is in a contact
  bool rests = false;     ///< the hand has not moved for 0.2 s
  double gain = 0.0;      ///< that the spring would gain in this period by a change of the half-spaces, J
  double returned = 0.0;  ///< that a fade has taken from a hand which is still there, J; once, after the fade
};

/// Keeps half-spaces within the device's force, torque and passive stiffness. Lets them change so that the wrench on
/// the hand, where it is now, changes no faster than the device's rates. Drops them in a fade. Its only means is the
/// largest force of the spring: it falls with the old half-spaces, or rises with the new ones.
///
/// Half-spaces that stand still are a spring, which gives back no more than the hand has put in. Only half-spaces that
/// move against the hand give energy: the difference of what the spring stores, for which the account of the hand pays.
class HalfSpaceLimits {
 public:
  HalfSpaceLimits(const DeviceDescriptor& descriptor, const RateLimit& rates, double period_s);

  /// Whether the device takes half-spaces. Otherwise there are none.
  bool are_taken() const noexcept { return descriptor_.tool_command == ToolCommand::kHalfSpaces; }

  /// The half-spaces for this period, `dt` (seconds) after the last one, before the energy limit. No force exceeds
  /// `most_N`. `state` is the newest of the device.
  HeldEnergy want(const HalfSpaces& wanted, const GloveState& state, bool is_fading, const Fade& fade, double most_N,
                  double dt, LimitReasons& reasons) noexcept;

  /// Gives the same half-spaces if their spring gains no more than is available (J), else with a smaller force. Returns
  /// what the spring gains.
  double give(double available_J, double dt, LimitReasons& reasons) noexcept;

  /// The device has dropped what was given. Returns whether there was anything.
  bool drop() noexcept;

  /// What was given, and its wrench on the hand; the wrench of what was wanted.
  const HalfSpaces& given() const noexcept { return last_; }
  const HandWrench& given_wrench() const noexcept { return given_wrench_; }
  const HandWrench& wanted_wrench() const noexcept { return wanted_wrench_; }

 private:
  HalfSpaces within_device(const HalfSpaces& wanted, double most_N, LimitReasons& reasons) const noexcept;
  bool change_softly(double dt) noexcept;
  void observe_rest(const Eigen::Isometry3d& X_WH, double dt) noexcept;
  void begin_fade() noexcept;
  double take_back() noexcept;

  const DeviceDescriptor& descriptor_;
  const RateLimit& rates_;
  double lag_s_;              // of the device's own loop
  double translational_ = 0;  // N/m: largest passive stiffness at the hand root
  double rotational_ = 0;     // Nm/rad
  double fade_s_;
  std::chrono::nanoseconds expiry_;
  HalfSpaces last_;
  HalfSpaces next_;
  Eigen::Isometry3d X_WH_ = Eigen::Isometry3d::Identity();
  HandWrench wanted_wrench_;
  HandWrench given_wrench_;
  std::optional<HalfSpaces> before_fade_;
  double left_J_ = 0.0;  // of the energy in the spring when the fade began, where the hand has been since
  PoseInPlay pose_;
  double speed_m_per_s_ = 0.0;  // smoothed
  double resting_for_s_ = 0.0;
};

}  // namespace glissade::devices
