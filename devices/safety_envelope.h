#pragma once

/// The safety envelope: the only way from a wanted command to a device. It keeps every limit of the device's
/// descriptor, and lets the force fade whenever its basis is old, implausible or not permitted.

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/devices/glove_device.h>

namespace glissade::devices {

/// Reasons why a command differs from the wanted one. The first seven let the force fade to zero.
struct LimitReasons {
  bool is_stopped = false;      ///< emergency stop
  bool is_disabled = false;     ///< the wearer does not hold the enable switch
  bool is_refused = false;      ///< the glove obeys another server
  bool not_finite = false;      ///< a number of the wanted command or of the state is NaN or infinite
  bool is_implausible = false;  ///< a state contradicts the descriptor or the states before, now or a short time ago
  bool is_state_old = false;    ///< the newest state was measured too long ago
  bool is_command_old = false;  ///< the wanted command answers a state that was measured too long ago, or never
  bool is_returning = false;    ///< the force returns softly, after the start or after one of the reasons above
  bool force_limited = false;   ///< the force was scaled down to the device's maximum
  bool torque_limited = false;  ///< the torque was scaled down to the device's maximum
  bool joints_limited = false;  ///< at least one joint torque was clamped
  bool rate_limited = false;    ///< force or torques may not change as fast as wanted
  bool power_limited = false;   ///< the wrench was scaled down to the largest power
  bool mean_limited = false;    ///< the force was scaled down because its mean is near the largest mean

  /// The force fades or is zero.
  bool is_fading() const noexcept {
    return is_stopped || is_disabled || is_refused || not_finite || is_implausible || is_state_old || is_command_old;
  }
  bool any() const noexcept {
    return is_fading() || is_returning || force_limited || torque_limited || joints_limited || rate_limited ||
           power_limited || mean_limited;
  }
};

struct NamedReason {
  bool LimitReasons::*flag;
  std::string_view name;
};

/// All reasons, the most serious first. Messages carry them as bits in this order.
inline constexpr std::array<NamedReason, 14> kLimitReasons{{{&LimitReasons::is_stopped, "stopped"},
                                                            {&LimitReasons::is_disabled, "disabled"},
                                                            {&LimitReasons::is_refused, "refused"},
                                                            {&LimitReasons::not_finite, "not-finite"},
                                                            {&LimitReasons::is_implausible, "implausible"},
                                                            {&LimitReasons::is_state_old, "state-old"},
                                                            {&LimitReasons::is_command_old, "command-old"},
                                                            {&LimitReasons::is_returning, "returning"},
                                                            {&LimitReasons::force_limited, "force"},
                                                            {&LimitReasons::torque_limited, "torque"},
                                                            {&LimitReasons::joints_limited, "joints"},
                                                            {&LimitReasons::rate_limited, "rate"},
                                                            {&LimitReasons::power_limited, "power"},
                                                            {&LimitReasons::mean_limited, "mean"}}};

/// A command that a device may execute. Only `SafetyEnvelope` makes one that is not zero.
class SafeCommand {
 public:
  /// No force.
  SafeCommand() = default;

  /// Sequences, times, forces and torques.
  const GloveCommand& values() const noexcept { return values_; }
  const LimitReasons& reasons() const noexcept { return reasons_; }
  /// Time since the measurement of the state that the command answers.
  std::chrono::nanoseconds age() const noexcept { return age_; }

 private:
  friend class SafetyEnvelope;

  GloveCommand values_;
  LimitReasons reasons_;
  std::chrono::nanoseconds age_{0};
};

/// The most serious reason in plain words, such as "no force: the glove's state is 14 ms old"; empty without reasons.
/// `age` is `SafeCommand::age`.
std::string to_text(const LimitReasons& reasons, std::chrono::nanoseconds age);

/// One envelope stands before each device: one at the server's end of a link and one at the glove's end, or one alone
/// for a device in the server's process. It remembers the last command and the last state, so call it once a period.
///
/// Ages are measured from the times of measurement that states carry. The clock of the glove and that of the caller may
/// differ: the fastest message so far gives the difference, which may grow by 0.2 ms a second. If all states of a
/// second are late, or if the glove's clock goes back, the difference is taken anew.
///
/// Force and torques fade within seven periods and return within 200 ms. A rate of the descriptor below `max_force` in
/// seven periods makes both slower. Not thread-safe. Real-time safe: no allocation, no lock, no system call.
class SafetyEnvelope {
 public:
  /// Ages up to `patience_periods` periods of the device are normal. Throws as `validate` does.
  explicit SafetyEnvelope(const DeviceDescriptor& descriptor, double patience_periods = 3.0);

  /// The command for this period: `wanted`, which answers one of the last states, reduced as far as the descriptor and
  /// the reasons demand. `newest` is the newest state; `now` is a time on the caller's clock. Sequences and times do
  /// not change. Each call changes the force by at most its rate times the time since the last call, of which at most
  /// two periods count.
  SafeCommand limit(const GloveCommand& wanted, const GloveState& newest, std::chrono::nanoseconds now) noexcept;

  /// Emergency stop: from now on the force fades to zero and stays there.
  void stop() noexcept { is_stopped_ = true; }

  const DeviceDescriptor& descriptor() const noexcept { return descriptor_; }

 private:
  struct Forces {
    Eigen::Vector3d f = Eigen::Vector3d::Zero();
    Eigen::Vector3d t = Eigen::Vector3d::Zero();
    JointValues joints{};
  };

  double seconds_since_last_call(std::chrono::nanoseconds now) noexcept;
  void observe(const GloveState& state, std::chrono::nanoseconds now) noexcept;
  bool is_plausible(const GloveState& state) noexcept;
  void update_offset(const GloveState& state, std::chrono::nanoseconds now) noexcept;
  LimitReasons faults(const GloveCommand& wanted, std::chrono::nanoseconds now) const noexcept;
  std::chrono::nanoseconds age_of(std::chrono::nanoseconds measured, std::chrono::nanoseconds now) const noexcept;
  void limit_norms(Forces& forces, LimitReasons& reasons) const noexcept;
  void limit_power(Forces& forces, LimitReasons& reasons) const noexcept;
  void limit_rates(Forces& forces, double seconds, LimitReasons& reasons) const noexcept;

  DeviceDescriptor descriptor_;
  std::chrono::nanoseconds period_;
  std::chrono::nanoseconds patience_;
  double force_rate_;
  double torque_rate_;
  double joint_torque_rate_;

  bool is_stopped_ = false;
  double gain_ = 0.0;
  double mean_force_ = 0.0;
  Forces wanted_;  // newest finite one
  Forces last_;
  bool has_been_called_ = false;
  std::chrono::nanoseconds last_call_{0};

  bool has_state_ = false;
  GloveState state_;                       // newest
  std::chrono::nanoseconds pose_time_{0};  // since when the pose repeats to the bit
  std::chrono::nanoseconds offset_{0};     // caller's clock minus glove's clock
  std::chrono::nanoseconds punctual_{0};   // when the last state was not late
  std::chrono::nanoseconds distrust_until_{0};
};

}  // namespace glissade::devices
