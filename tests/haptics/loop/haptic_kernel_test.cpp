#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include <glissade/contact/spring.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/haptic_kernel.h>

#include "allocation_counter.h"
#include "kernel_fixture.h"
#include "loop/hand_in_device.h"

namespace glissade::haptics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

TEST_F(Kernel, TheFirstStateGraspsThePartWhereItLies) {
  const Vector3d beside(0.2, 0.0, 0.5);  // the hand is not where the part is
  tick(hand_at(beside), no_answer());
  EXPECT_TRUE(X_WG_.isApprox(kStart));
  tick(hand_at(beside + Vector3d(0.0, 5e-4, 0.0)), no_answer());
  EXPECT_TRUE(X_WG_.translation().isApprox(Vector3d(0.0, 5e-4, 0.5)));
}

TEST_F(Kernel, PushesBackWithTheStiffnessTimesTheDepth) {
  tick(hand_at({0.0, 0.0, 0.5}), floor_below(0.0));
  const HandTick last = settle(hand_at({0.0, 0.0, 0.498}), floor_below(0.0));
  EXPECT_TRUE(last.command.values().f_H_W.isApprox(Vector3d(0.0, 0.0, 2.0), 1e-9));
  EXPECT_TRUE(last.command.values().t_H_W.isZero(1e-9));
}

TEST_F(Kernel, TheForceStaysWhereItIsWhenTheReferencePointMoves) {
  tick(hand_at({0.0, 0.0, 0.5}), floor_below(0.0));
  settle(hand_at({0.0, 0.0, 0.498}), floor_below(0.0));
  ContactSet set = floor_below(0.0);
  set.parts[0].p_Vref = Vector3d(0.05, 0.0, 0.0);
  set.row_array[0].r = Vector3d(-0.05, 0.0, 0.0);  // the same contact
  const contact::Wrench contacts = tick(hand_at({0.0, 0.0, 0.498}), set).contacts;
  EXPECT_NEAR(contacts.f.z(), 2.0, 0.3);
  EXPECT_NEAR(contacts.t.y(), 0.1, 0.02) << "2 N at -0.05 m from the point";
}

TEST_F(Kernel, AHandBesideThePartFeelsTheTorqueOfItsLever) {
  tick(hand_at({0.2, 0.0, 0.5}), floor_below(0.0));
  const HandTick last = settle(hand_at({0.2, 0.0, 0.498}), floor_below(0.0));
  const double force = last.command.values().f_H_W.z();
  EXPECT_TRUE(last.command.values().f_H_W.isApprox(Vector3d(0.0, 0.0, force), 1e-9));
  EXPECT_TRUE(last.command.values().t_H_W.isApprox(Vector3d(0.0, 0.2 * force, 0.0), 1e-9));  // (−0.2, 0, 0) × f
  // So far away, the spring is as stiff as the damping against turning allows (`LeverLimit`).
  const double share = force / 2.0;
  const double limit = device_.damping / 0.5e-3;
  const double rotational_limit = device_.rotational_damping / 0.5e-3;
  const auto& [K, K_r] = kKernelStiffness;
  EXPECT_NEAR((limit - share * K) * (rotational_limit - share * K_r) / (share * K * limit * 0.2 * 0.2), 1.0, 0.02);
}

// What the hand still feels of a part that it has let go is no stiffer than the part was.
TEST_F(Kernel, ForceDoesNotRiseOnReleaseOfALongPart) {
  tick(hand_at({0.4, 0.0, 0.5}), floor_below(0.0));
  double last = settle(hand_at({0.4, 0.0, 0.46}), floor_below(0.0)).command.values().f_H_W.z();
  EXPECT_GT(last, 1.0);
  devices::GloveState state = hand_at({0.4, 0.0, 0.46});
  ++state.grip;
  for (int ms = 0; ms < 100; ++ms) {
    const double force = tick(state, floor_below(0.0)).command.values().f_H_W.z();
    ASSERT_LE(force, last + 1e-3) << ms << " ms";
    last = force;
  }
  EXPECT_EQ(last, 0.0);
}

TEST_F(Kernel, ADeepHandFeelsTheLargestForceHoweverSoftTheCoupling) {
  tick(hand_at({0.4, 0.0, 0.5}), floor_below(0.0));
  HandTick last;
  for (int i = 0; i < 4; ++i)  // a soft coupling changes its force slowly
    last = settle(hand_at({0.4, 0.0, 0.2}), floor_below(0.0));
  EXPECT_NEAR(last.command.values().f_H_W.norm(), device_.max_force, 1e-6);
}

TEST_F(Kernel, NeverExceedsTheDevice) {
  tick(hand_at({0.0, 0.0, 0.5}), floor_below(0.0));
  const HandTick last = settle(hand_at({0.0, 0.0, 0.3}), floor_below(0.0));
  EXPECT_NEAR(last.command.values().f_H_W.norm(), device_.max_force, 1e-9);
  EXPECT_TRUE(last.command.reasons().force_limited);
}

TEST_F(Kernel, NonFiniteStateGivesNoForceAndHasNoAftereffect) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  tick(hand_at({nan, 0.0, 0.5}), floor_below(0.0));  // not even grasped by
  settle(hand_at({0.0, 0.0, 0.5}), floor_below(0.0));
  const HandTick last = tick(hand_at({0.0, 0.0, nan}), floor_below(0.0));
  EXPECT_EQ(last.command.values().f_H_W, Vector3d::Zero());
  EXPECT_EQ(last.command.values().t_H_W, Vector3d::Zero());
  EXPECT_TRUE(last.command.reasons().not_finite);
  EXPECT_TRUE(X_WG_.isApprox(kStart));
  const HandTick next = settle(hand_at({0.0, 0.0, 0.498}), floor_below(0.0));
  EXPECT_TRUE(next.command.values().f_H_W.isApprox(Vector3d(0.0, 0.0, 2.0), 1e-9));
}

TEST_F(Kernel, ASimulationThatHaltsLetsTheForceFade) {
  settle(hand_at({0.0, 0.0, 0.498}), floor_below(0.0));
  ContactSet set = floor_below(0.0);
  set.time = now_;
  HandTick last;
  for (int i = 0; i < 100; ++i) {  // the hand slides on at 0.1 m/s
    devices::GloveState state = hand_at({1e-4 * i, 0.0, 0.498});
    state.v_WH.x() = 0.1;
    now_ += kTickPeriod;
    state.time = now_;
    state.sequence = ++sequence_;
    last = tick_at(state, set);
    EXPECT_LE(last.command.values().f_H_W.head<2>().norm(), 0.02 * std::abs(last.command.values().f_H_W.z()));
  }
  EXPECT_EQ(last.command.values().f_H_W, Vector3d::Zero());
}

/// The floor comes up at 0.1 m/s.
TEST_F(Kernel, TheSupplyIsTheWorkOfTheExertedForceOnly) {
  constexpr double kWay_m = 0.1 * 1e-3;
  ContactSet rising = floor_below(0.0);
  rising.row_array[0].approach = 0.1;
  tick(hand_at({0.0, 0.0, 0.5}), rising);
  double before = settle(hand_at({0.0, 0.0, 0.498}), rising).command.values().supply;
  const auto supplied = [&](const HandTick& now) {
    return now.command.values().supply - std::exchange(before, now.command.values().supply);
  };
  EXPECT_NEAR(supplied(tick(hand_at({0.0, 0.0, 0.498}), rising)), 2.0 * kWay_m, 1e-9);
  settle(hand_at({0.0, 0.0, 0.3}), rising);
  before = tick(hand_at({0.0, 0.0, 0.3}), rising).command.values().supply;
  EXPECT_NEAR(supplied(tick(hand_at({0.0, 0.0, 0.3}), rising)), device_.max_force * kWay_m, 1e-9)
      << "more than the device gives is not exerted";

  // The simulation halts, and answers again: the force returns over 200 ms.
  for (int i = 0; i < 4; ++i)  // the jump out of the floor counts as work of the force
    settle(hand_at({0.0, 0.0, 0.498}), rising);
  ContactSet old = rising;
  old.time = now_;
  for (int i = 0; i < 200; ++i) {
    now_ += kTickPeriod;
    devices::GloveState state = hand_at({0.0, 0.0, 0.498});
    state.time = now_;
    state.sequence = ++sequence_;
    before = tick_at(state, old).command.values().supply;
  }
  for (int i = 0; i < 100; ++i) {
    const HandTick now = tick(hand_at({0.0, 0.0, 0.498}), rising);
    ASSERT_LT(now.contacts.f.z(), 1.1);
    ASSERT_NEAR(supplied(now), now.contacts.f.z() * kWay_m, 2e-6) << i;
  }
}

/// The hand sinks by 10 mm while there is no force, and is lifted when the force is back.
class SunkenHand : public Kernel {
 protected:
  /// The simulation halts.
  void sink() {
    press();
    ContactSet old = floor_below(0.0);
    old.time = now_;
    for (int i = 0; i < 300; ++i) {
      now_ += kTickPeriod;
      devices::GloveState state = sinking_hand(i);
      state.time = now_;
      state.sequence = ++sequence_;
      tick_at(state, old);
    }
  }

  /// The part is to go up and down at once.
  void sink_without_a_solution() {
    press();
    ContactSet set = floor_below(-1e-3);
    set.row_count = 2;
    set.row_array[1] = {{{-Vector3d::UnitZ(), Vector3d::Zero(), 1e-3}}};
    for (int i = 0; i < 300; ++i)
      EXPECT_TRUE(tick(sinking_hand(i), set).is_unsolved);
  }

  void press() {
    tick(hand_at({0.0, 0.0, 0.5}), floor_below(0.0));
    settle(hand_at({0.0, 0.0, 0.498}), floor_below(0.0));
  }

  static devices::GloveState sinking_hand(int ms) {
    return hand_at({0.0, 0.0, 0.498 - 1e-4 * std::clamp(ms - 150, 0, 100)});
  }

  /// J, told as supply.
  double lift() {
    const double before = settle(hand_at({0.0, 0.0, 0.488}), floor_below(0.0)).command.values().supply;
    HandTick last;
    for (int i = 0; i < 100; ++i)
      last = tick(hand_at({0.0, 0.0, 0.488 + 1e-4 * i}), floor_below(0.0));
    return last.command.values().supply - before;
  }
};

TEST(HandInDevice, ServersThatTakeOverAgainAndAgainLiftItWithNoMoreThanATenthOfAWatt) {
  double lifted = 0.0;
  for (int server = 0; server < 10; ++server) {
    const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
    HandInDevice hand{.contacts = {0.05, {1000.0, 1.0}, device.max_force}, .envelope = devices::SafetyEnvelope(device)};
    for (int ms = 0; ms < 1000; ++ms)
      lifted += hand.lift(0.01, -0.01, 1e-3);  // 10 W against a force that was withheld
  }
  EXPECT_NEAR(lifted, 0.1 * 10.0, 1e-9);
}

TEST_F(SunkenHand, SupplyIsTheWorkOfTheReturningForce) {
  sink();
  EXPECT_NEAR(lift(), 0.5 * (2.0 + 12.0) * 10e-3, 2e-3) << "the work that the force would have taken";
}

TEST_F(SunkenHand, SupplyIsTheWorkOfTheLastForceIfRowsHadNoSolution) {
  sink_without_a_solution();
  EXPECT_NEAR(lift(), 2.0 * 10e-3, 2e-3);
}

TEST_F(SunkenHand, SupplyIsZeroAfterTheContactHasEnded) {
  sink();
  tick(hand_at({0.0, 0.0, 0.488}), floor_below(1.0));
  EXPECT_EQ(lift(), 0.0);
}

TEST_F(Kernel, GripCountRestartsWithTheGlove) {
  devices::GloveState state = hand_at({0.5, 0.0, 0.5});  // so far from the part that it could not take it again
  state.grip = 3;
  EXPECT_EQ(settle(state, no_answer()).part, 0U);
  sequence_ = 0;
  state.grip = 1;
  EXPECT_EQ(settle(state, no_answer()).part, 0U) << "it is closed, as before";
  state.grip = 2;
  EXPECT_FALSE(settle(state, no_answer()).part.has_value());
}

TEST_F(Kernel, CutsTheCouplingToWhatTheDeviceCanRender) {
  devices::DeviceDescriptor weak = device_;
  weak.max_stiffness = 400.0;
  weak.max_rotational_stiffness = 0.3;
  weak.max_damping = 1.0;
  const Coupling coupling = coupling_for(weak, kKernelStiffness);
  EXPECT_EQ(coupling.stiffness.translational, 400.0);
  EXPECT_EQ(coupling.stiffness.rotational, 0.3);
  EXPECT_EQ(coupling.damping.translational, 1.0);
  EXPECT_EQ(HapticKernel({{part_.p_Vref(), part_.radius(), kKernelStiffness}}, {{weak, 0}})
                .coupling(0, 0)
                .stiffness.translational,
            400.0);
}

TEST_F(Kernel, ADeviceThatRendersNoStiffnessIsRefused) {
  devices::DeviceDescriptor forceless = device_;
  forceless.max_rotational_stiffness = 0.0;
  EXPECT_THROW(coupling_for(forceless, kKernelStiffness), std::invalid_argument);
}

TEST_F(Kernel, ATickAllocatesNothing) {
  if (!test_support::allocations_are_counted()) GTEST_SKIP() << "a sanitizer's allocator cannot be interposed";
  ContactSet set = floor_below(1e-3);
  set.row_count = static_cast<std::int32_t>(kMaxContactRows);
  for (std::size_t i = 0; i < kMaxContactRows; ++i) {
    const double angle = 0.7 * static_cast<double>(i);
    set.row_array[i] = {{{Vector3d(0.3 * std::cos(angle), 0.3 * std::sin(angle), 1.0).normalized(),
                          Vector3d(0.05 * std::cos(angle), 0.05 * std::sin(angle), -0.05), -1e-4}}};
  }
  const std::int64_t at_start = test_support::allocations_of_this_thread();
  ::operator delete(::operator new(8));  // unlike a new-expression, these calls cannot be optimized away
  ASSERT_GT(test_support::allocations_of_this_thread(), at_start) << "the counter does not count";

  const std::int64_t before = test_support::allocations_of_this_thread();
  for (int i = 0; i < 1000; ++i)
    tick(hand_at({1e-5 * i, 0.0, 0.5 - 1e-5 * i}), set);
  EXPECT_EQ(test_support::allocations_of_this_thread(), before);
}

/// Two parts side by side, with as many rows as fit: with the floor, and with each other.
ContactSet crowded_set() {
  ContactSet set;
  set.sequence = 1;
  set.part_count = 2;
  for (PartAnswer& part : set.parts)
    part.hold = 1;
  set.parts[0].X_WV = Isometry3d(Eigen::Translation3d(-0.05, 0.0, 0.5));
  set.parts[1].X_WV = Isometry3d(Eigen::Translation3d(0.05, 0.0, 0.5));
  for (PartAnswer& part : set.parts)
    part.X_WV_of_rows = part.X_WV;
  set.row_count = 2 * static_cast<std::int32_t>(kMaxContactRows);
  for (std::int32_t i = 0; i < set.row_count; ++i) {
    ContactRow& row = set.row_array[static_cast<std::size_t>(i)];
    const double offset = 1e-3 * (i % 16) - 8e-3;
    row.part = i / static_cast<std::int32_t>(kMaxContactRows);
    const bool is_mutual = i % 2 == 1;
    const double outward = row.part == 0 ? -1.0 : 1.0;
    row.n = is_mutual ? Vector3d(outward, offset, 0.0).normalized() : Vector3d(offset, 0.0, 1.0).normalized();
    row.r = is_mutual ? Vector3d(-0.05 * outward, offset, offset) : Vector3d(offset, offset, -0.05);
    row.bound = -1e-4;
    row.pushes = true;
    row.friction_ratio_W = 0.2 * row.n.unitOrthogonal();
    if (!is_mutual) continue;
    row.other = 1 - row.part;
    row.r_other = Vector3d(0.05 * outward, offset, offset);
  }
  return set;
}

TEST(KernelOfTwoHands, ATickOnCoupledPartsAllocatesNothing) {
  if (!test_support::allocations_are_counted()) GTEST_SKIP() << "a sanitizer's allocator cannot be interposed";
  const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  const KernelPart part{.radius = 0.1, .stiffness = kKernelStiffness};
  HapticKernel kernel({part, part}, {{device, 0}, {device, 1}});
  ContactSet set = crowded_set();
  std::array<devices::GloveState, 2> states;
  const std::array<const devices::GloveState*, 2> newest{&states[0], &states[1]};
  std::array<double, 2> greatest_N{};
  const std::int64_t before = test_support::allocations_of_this_thread();
  for (int ms = 1; ms <= 1000; ++ms) {
    for (std::size_t h = 0; h < 2; ++h) {
      const double inward = h == 0 ? 1.0 : -1.0;
      states[h].time = std::chrono::milliseconds(ms);
      states[h].sequence = ms;
      states[h].X_WH.translation() = set.parts[h].X_WV.translation() + 5e-6 * ms * Vector3d(inward, 0.0, -1.0);
      states[h].v_WH = 5e-3 * Vector3d(inward, 0.0, -1.0);
    }
    if (ms == 600) kernel.release(1);  // then both hands hold one part
    if (ms == 601) kernel.grasp(1, 0);
    set.time = std::chrono::milliseconds(ms);
    const HapticTick tick = kernel.tick(newest, set, std::chrono::milliseconds(ms));
    set.parts[0].hold = tick.ghosts.parts[0].hold;
    set.parts[1].hold = tick.ghosts.parts[1].hold;
    for (std::size_t h = 0; h < 2; ++h)
      greatest_N[h] = std::max(greatest_N[h], tick.hands[h].command.values().f_H_W.norm());
  }
  EXPECT_EQ(test_support::allocations_of_this_thread(), before);
  EXPECT_GT(greatest_N[0], 1.0) << "the rows have done something";
  EXPECT_GT(greatest_N[1], 1.0);
}

}  // namespace
}  // namespace glissade::haptics
