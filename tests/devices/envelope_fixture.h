#pragma once

/// An envelope of the simulated glove, one period after the other.

#include <chrono>
#include <cstdint>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>

namespace glissade::devices {

inline const DeviceDescriptor kDevice = simulated_glove_descriptor();  // 20 N, 1 Nm, 0.5 Nm a joint, 1000 Hz
inline constexpr double kForceStep_N = 20.0 / 7.0;                     // in a period
inline constexpr double kSlack = 1.0 + 1e-12;

inline GloveCommand pull(double newtons) {
  GloveCommand command;
  command.f_H_W.x() = newtons;
  return command;
}

inline bool is_zero(const SafeCommand& command) {
  return command.values().is_at_rest();
}

/// A link of 1 kHz whose states are one millisecond old when they are answered. The clocks of glove and server differ.
class Envelope : public testing::Test {
 protected:
  /// One period with a new state.
  SafeCommand tick(GloveCommand wanted) {
    now_ += std::chrono::milliseconds(1);
    state_.time = now_ + kGloveClock - std::chrono::milliseconds(1);
    ++state_.sequence;
    wanted.state_time = state_.time;
    return checked(envelope_.limit(wanted, state_, now_));
  }

  /// One period in which no new state came.
  SafeCommand silent_tick(GloveCommand wanted) {
    now_ += std::chrono::milliseconds(1);
    wanted.state_time = state_.time;
    return checked(envelope_.limit(wanted, state_, now_));
  }

  /// So many periods of a hand that moves at `speed` along the wanted force of 20 N.
  SafeCommand push_at(double speed, int periods, double supply = 0.0) {
    state_.v_WH.x() = speed;
    SafeCommand safe;
    for (int i = 0; i < periods; ++i) {
      state_.X_WH.translation().x() += 1e-3 * speed;
      GloveCommand wanted = pull(20.0);
      wanted.session = session_;
      wanted.sequence = ++sequence_;
      wanted.supply = supply;
      safe = tick(wanted);
    }
    return safe;
  }

  std::int64_t session_ = 1;  // of the commands of push_at
  std::int64_t sequence_ = 0;

  SafeCommand settle(const GloveCommand& wanted) {
    SafeCommand safe;
    for (int i = 0; i < 500; ++i)
      safe = tick(wanted);
    return safe;
  }

  /// Number of periods until the force is zero.
  template <typename Tick>
  int periods_to_zero(Tick&& next) {
    for (int i = 1; i <= 100; ++i) {
      if (is_zero(next())) return i;
    }
    return -1;
  }

  /// Every command of every test keeps limit and rate: after a silence, that of two periods.
  SafeCommand checked(const SafeCommand& safe) {
    EXPECT_LE(safe.values().f_H_W.norm(), kDevice.max_force);
    const double periods = now_ - last_call_ > std::chrono::milliseconds(1) ? 2.0 : 1.0;
    EXPECT_LE((safe.values().f_H_W - last_f_).norm(), periods * kForceStep_N * kSlack);
    last_f_ = safe.values().f_H_W;
    last_call_ = now_;
    return safe;
  }

  static constexpr std::chrono::nanoseconds kGloveClock = std::chrono::hours(5);

  SafetyEnvelope envelope_{kDevice};
  GloveState state_;
  std::chrono::nanoseconds now_{std::chrono::milliseconds(100)};
  std::chrono::nanoseconds last_call_ = now_;
  Eigen::Vector3d last_f_ = Eigen::Vector3d::Zero();
};

}  // namespace glissade::devices
