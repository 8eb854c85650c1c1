#pragma once

/// A haptic kernel with one hand that holds a box, tick by tick.

#include <chrono>
#include <cstdint>
#include <memory>

#include <gtest/gtest.h>

#include <glissade/contact/contact_body.h>
#include <glissade/contact/spring.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/haptics/haptic_kernel.h>

namespace glissade::haptics {

inline const contact::CouplingStiffness kKernelStiffness{1000.0, 2.0};

class Kernel : public ::testing::Test {
 protected:
  /// A glove state with the hand at `p_WH`.
  static devices::GloveState hand_at(const Eigen::Vector3d& p_WH) {
    devices::GloveState state;
    state.X_WH.translation() = p_WH;
    return state;
  }

  /// The part may sink by `depth` from where it starts.
  static ContactSet floor_below(double depth) {
    ContactSet set;
    set.sequence = 1;
    set.parts[0].X_WV_of_rows = kStart;
    set.parts[0].X_WV = kStart;
    set.parts[0].hold = 1;  // the first
    set.row_count = 1;
    set.row_array[0] = {{{Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero(), -depth}}};
    return set;
  }

  /// A set before the simulation's first answer.
  static ContactSet no_answer() {
    ContactSet set;
    set.parts[0].X_WV = kStart;
    return set;
  }

  /// One tick later; state and set are new.
  HandTick tick(devices::GloveState state, ContactSet set) {
    now_ += kTickPeriod;
    state.time = now_;
    state.sequence = ++sequence_;
    set.time = now_;
    return tick_at(state, set);
  }

  /// A tick now.
  HandTick tick_at(const devices::GloveState& state, const ContactSet& set) {
    const devices::GloveState* const newest = &state;
    const HapticTick tick = kernel_.tick({&newest, 1}, set, now_);
    X_WG_ = tick.ghosts.parts[0].X_WG;
    return tick.hands[0];
  }

  HandTick settle(const devices::GloveState& state, const ContactSet& set) {
    HandTick last;
    for (int i = 0; i < 500; ++i)
      last = tick(state, set);
    return last;
  }

  static inline const Eigen::Isometry3d kStart{Eigen::Translation3d(0.0, 0.0, 0.5)};
  contact::SlidingPart part_{std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.1, 0.1}, 12))};
  devices::DeviceDescriptor device_ = devices::simulated_glove_descriptor();
  HapticKernel kernel_{{{part_.p_Vref(), part_.radius(), kKernelStiffness}}, {{device_, 0}}};
  std::chrono::nanoseconds now_{0};
  std::int64_t sequence_ = 0;
  Eigen::Isometry3d X_WG_;  // after the last tick
};

}  // namespace glissade::haptics
