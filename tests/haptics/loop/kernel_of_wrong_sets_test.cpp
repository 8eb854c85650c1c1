/// What a hand gets from a kernel whose contact sets are wrong.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "kernel_fixture.h"

namespace glissade::haptics {
namespace {

using Eigen::Vector3d;

/// What a simulation never tells: one number of a contact set is not one.
class BrokenSet : public Kernel {
 protected:
  using Break = std::function<void(ContactSet& set)>;

  static std::vector<std::pair<std::string, Break>> ways_to_break() {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    return {{"normal", [=](ContactSet& set) { set.row_array[0].n.x() = nan; }},
            {"lever", [=](ContactSet& set) { set.row_array[0].r.y() = nan; }},
            {"bound", [=](ContactSet& set) { set.row_array[0].bound = nan; }},
            {"infinite bound", [=](ContactSet& set) { set.row_array[0].bound = infinity; }},
            {"huge bound", [](ContactSet& set) { set.row_array[0].bound = 1e300; }},
            {"range", [=](ContactSet& set) { set.row_array[0].range = nan; }},
            {"approach", [=](ContactSet& set) { set.row_array[0].approach = infinity; }},
            {"friction", [=](ContactSet& set) { set.row_array[0].friction_ratio_W.x() = nan; }},
            {"visible pose", [=](ContactSet& set) { set.parts[0].X_WV.translation().x() = nan; }},
            {"pose of the rows", [=](ContactSet& set) { set.parts[0].X_WV_of_rows.linear()(1, 2) = nan; }},
            {"ghost", [=](ContactSet& set) { set.parts[0].X_WG.translation().z() = infinity; }},
            {"reference point", [=](ContactSet& set) { set.parts[0].p_Vref.x() = nan; }},
            {"target", [=](ContactSet& set) { set.parts[0].X_GT.translation().z() = nan; }}};
  }

  static ContactSet broken(const Break& breaks) {
    ContactSet set = floor_below(0.0);
    set.row_array[0].pushes = true;
    breaks(set);
    return set;
  }

  /// A tick with this set; checks what the hand gets.
  void tick_and_check(const Vector3d& p_WH, const ContactSet& set) {
    const devices::GloveCommand command = tick(hand_at(p_WH), set).command.values();
    ASSERT_TRUE(command.f_H_W.allFinite());
    ASSERT_TRUE(command.t_H_W.allFinite());
    ASSERT_TRUE(std::isfinite(command.supply));
    ASSERT_TRUE(X_WG_.matrix().allFinite());
    ASSERT_LE((command.f_H_W - f_W_).norm(), device_.max_force / 7.0 * (1.0 + 1e-9));
    f_W_ = command.f_H_W;
  }

  Vector3d f_W_ = Vector3d::Zero();  // in the last tick that was checked
};

TEST_F(BrokenSet, ForceFadesToZeroAndReturnsAfterwards) {
  const Vector3d deep(0.0, 0.0, 0.498);
  tick(hand_at({0.0, 0.0, 0.5}), floor_below(0.0));
  for (const auto& [what, breaks] : ways_to_break()) {
    SCOPED_TRACE(what);
    f_W_ = settle(hand_at(deep), floor_below(0.0)).command.values().f_H_W;
    EXPECT_NEAR(f_W_.z(), 2.0, 1e-9);
    for (int i = 0; i < 200 && !HasFatalFailure(); ++i)
      tick_and_check(deep, broken(breaks));
    EXPECT_EQ(f_W_, Vector3d::Zero()) << "nothing is known of the contacts";
  }
  EXPECT_NEAR(settle(hand_at(deep), floor_below(0.0)).command.values().f_H_W.z(), 2.0, 1e-9);
}

TEST_F(BrokenSet, GraspKeepsThePoseOfThePart) {
  const Vector3d aside(0.1, 0.0, 0.5);
  for (const auto& [what, breaks] : ways_to_break()) {
    SCOPED_TRACE(what);
    settle(hand_at({0.0, 0.0, 0.5}), no_answer());
    kernel_.release(0);
    tick(hand_at(aside), no_answer());
    kernel_.grasp(0, 0);
    tick_and_check(aside, broken(breaks));
    tick(hand_at(aside), no_answer());
    EXPECT_TRUE(X_WG_.isApprox(kStart)) << "as the part last lay";
  }
}

/// A hand of 0.8 kg that nobody holds.
struct FreeHand {
  void step(const Vector3d& f_W) {
    constexpr double kTick_s = 1e-3;
    v_W += kTick_s / 0.8 * (f_W - devices::kArmDamping * v_W);
    p_W += kTick_s * v_W;
    given_J += kTick_s * f_W.dot(v_W);
  }

  Vector3d p_W{0.0, 0.0, 0.5};
  Vector3d v_W = Vector3d::Zero();
  double given_J = 0.0;  ///< by the force
};

/// The normal of the floor is reversed, and the part shall go into it wherever it is: a force that never ends.
TEST_F(Kernel, ContactsThatPushTheWrongWayGiveNoMoreEnergyThanTheEnvelopeAllows) {
  FreeHand hand;
  settle(hand_at(hand.p_W), floor_below(0.0));
  settle(hand_at(hand.p_W), floor_below(0.0));  // the return from the start is over
  double greatest_N = 0.0;
  for (int ms = 1; ms <= 5000; ++ms) {
    ContactSet set = floor_below(0.0);
    set.parts[0].X_WV_of_rows = X_WG_;
    set.parts[0].X_WG = X_WG_;
    set.row_array[0].n = -Vector3d::UnitZ();
    set.row_array[0].bound = 5e-3;
    set.row_array[0].pushes = true;
    devices::GloveState state = hand_at(hand.p_W);
    state.v_WH = hand.v_W;
    const HandTick now = tick(state, set);
    const Vector3d f_W = now.command.values().f_H_W;
    ASSERT_LE(f_W.norm(), device_.max_force);
    greatest_N = std::max(greatest_N, f_W.norm());
    hand.step(f_W);
    ASSERT_LE(hand.given_J, 0.1 + 6e-4 * ms) << ms << " ms";
  }
  EXPECT_GT(greatest_N, 4.0) << "it has pushed";
  EXPECT_GT(hand.given_J, 0.05);
}

}  // namespace
}  // namespace glissade::haptics
