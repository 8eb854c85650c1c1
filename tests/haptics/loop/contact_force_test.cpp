#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include <glissade/contact/spring.h>

#include "loop/contact_projection.h"
#include "one_hand_force.h"
#include "poses.h"

namespace glissade::haptics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using test_support::at;
using test_support::OneHandForce;

constexpr double kTick_s = 1e-3;
constexpr double kStiffness = 1000.0;  // N/m
constexpr double kRadius = 0.1;
constexpr double kMaxForce = 20.0;  // N

/// The set of a part at the origin whose lowest point may sink by `depth` before it meets a floor.
ContactSet floor_below(double depth) {
  ContactSet set;
  set.sequence = 1;
  set.row_count = 1;
  set.row_array[0] = {{{Vector3d::UnitZ(), Vector3d::Zero(), -depth}}};
  return set;
}

OneHandForce at_origin() {
  return {Vector3d::Zero(), kRadius, {kStiffness, 10.0}, kMaxForce, Isometry3d::Identity()};
}

/// Lets the force come up to its set.
contact::Wrench settle(OneHandForce& contacts, const ContactSet& set, const Isometry3d& X_WG) {
  for (int i = 0; i < 1000; ++i)
    contacts.update(set, nanoseconds(0), X_WG, kTick_s);
  return contacts.update(set, nanoseconds(0), X_WG, kTick_s);
}

TEST(ContactForce, IsExactlyZeroInFreeSpace) {
  OneHandForce contacts = at_origin();
  Isometry3d X_WG = at(1e-4, 0.0, -1e-4);
  X_WG.rotate(Eigen::AngleAxisd(1e-3, Vector3d(1.0, 2.0, 3.0).normalized()));
  const contact::Wrench& wrench = contacts.update(floor_below(1e-3), nanoseconds(0), X_WG, kTick_s);
  EXPECT_EQ(wrench.f, Vector3d::Zero());
  EXPECT_EQ(wrench.t, Vector3d::Zero());
}

TEST(ContactForce, IsZeroAsLongAsTheSimulationHasNotAnswered) {
  OneHandForce contacts = at_origin();
  EXPECT_EQ(settle(contacts, ContactSet{}, at(0.0, 0.0, -0.05)).f, Vector3d::Zero());
}

TEST(ContactForce, AnOldSetDoesNotHoldTheHandBackAlongTheFloor) {
  OneHandForce contacts = at_origin();
  const ContactSet set = floor_below(1e-3);
  settle(contacts, set, at(0.0, 0.0, -3e-3));
  for (int i = 1; i <= 200; ++i) {  // 0.5 m/s
    const contact::Wrench& wrench = contacts.update(set, milliseconds(i), at(i * 5e-4, 0.0, -3e-3), kTick_s);
    EXPECT_LE(wrench.f.head<2>().norm(), 1e-9);
    EXPECT_NEAR(wrench.f.z(), kStiffness * 2e-3 * force_share(milliseconds(i)), 1e-9) << i;
  }
}

TEST(ContactForce, FadesWithTheAgeOfTheSet) {
  EXPECT_EQ(force_share(milliseconds(-1)), 1.0);
  EXPECT_EQ(force_share(kFullForce), 1.0);
  EXPECT_NEAR(force_share(milliseconds(60)), 0.5, 1e-12);
  EXPECT_EQ(force_share(kForceless), 0.0);
  EXPECT_EQ(force_share(std::chrono::hours(1)), 0.0);
}

TEST(ContactForce, FollowsANewContactNoFasterThanTheSlew) {
  OneHandForce contacts = at_origin();
  settle(contacts, floor_below(5e-3), at(0.0, 0.0, -3e-3));
  // A floor appears 2 mm above the ghost, which stands still.
  double force = 0.0;
  for (int i = 0; i < 20; ++i) {
    const double next = contacts.update(floor_below(1e-3), nanoseconds(0), at(0.0, 0.0, -3e-3), kTick_s).f.z();
    EXPECT_LE(next - force, kStiffness * contact::kSlew_m * (1.0 + 1e-9));
    force = next;
  }
  EXPECT_NEAR(force, 2.0, 1e-9);
}

// The simulation may learn at any moment that a face ends before the ghost.
TEST(ContactForce, FallsAtALimitedRateWhenTheRangeOfAContactShrinks) {
  OneHandForce contacts = at_origin();
  const Isometry3d X_WG = at(0.05, 0.0, -15e-3);
  ContactSet beside = floor_below(1e-3);
  beside.row_array[0].pushes = true;
  double force = settle(contacts, beside, X_WG).f.z();
  EXPECT_NEAR(force, 14.0, 1e-9);
  beside.row_array[0].range = 44e-3;
  const double fall = kMaxForce * kTick_s / std::chrono::duration<double>(kLongestFall).count();
  for (int i = 0; i < 75; ++i) {
    const double next = contacts.update(beside, nanoseconds(0), X_WG, kTick_s).f.z();
    EXPECT_LE(force - next, fall * (1.0 + 1e-9)) << i;
    force = next;
  }
  EXPECT_NEAR(force, 0.5 * 14.0, 1e-9);
}

/// With the ghost deep behind the floor, far beyond what the device can give.
TEST(ContactForce, IsZeroAt100MillisecondsAtAnyDepthAndStiffness) {
  for (const double stiffness : {300.0, 1000.0, 4000.0}) {
    for (const double depth : {0.02, 0.06, 0.4}) {
      OneHandForce contacts(Vector3d::Zero(), kRadius, {stiffness, 10.0}, kMaxForce, Isometry3d::Identity());
      const ContactSet set = floor_below(0.0);
      const double full = std::min(kMaxForce, stiffness * depth);
      EXPECT_NEAR(settle(contacts, set, at(0.0, 0.0, -depth)).f.z(), full, 1e-9);
      double last = full;
      for (int age = 0; age <= 100; ++age) {
        const double force = contacts.update(set, milliseconds(age), at(0.0, 0.0, -depth), kTick_s).f.z();
        EXPECT_LE(force, last + 1e-12);
        EXPECT_LE(last - force, kMaxForce / 50.0) << "a blow";
        last = force;
      }
      EXPECT_EQ(last, 0.0) << stiffness << " N/m, " << depth << " m";
    }
  }
}

/// Two contacts hold the part against a rotation, and their forces cancel.
TEST(ContactForce, PureTorqueIsZeroAt100Milliseconds) {
  OneHandForce contacts = at_origin();
  ContactSet set = floor_below(0.0);
  set.row_count = 2;
  set.row_array[0] = {{{Vector3d::UnitZ(), Vector3d(0.05, 0.0, 0.0), 0.0}}};
  set.row_array[1] = {{{-Vector3d::UnitZ(), Vector3d(-0.05, 0.0, 0.0), 0.0}}};
  const Isometry3d X_WG(Eigen::AngleAxisd(0.5, Vector3d::UnitY()));
  const contact::Wrench full = settle(contacts, set, X_WG);
  EXPECT_TRUE(full.f.isZero(1e-9));
  EXPECT_NEAR(full.t.norm(), kMaxForce * kRadius, 1e-9) << "5 Nm are more than the device gives";
  contact::Wrench last = full;
  for (int age = 0; age <= 100; ++age)
    last = contacts.update(set, milliseconds(age), X_WG, kTick_s);
  EXPECT_EQ(last.t, Vector3d::Zero());
}

TEST(ContactForce, ReturnsSoftlyAfterAHalt) {
  OneHandForce contacts = at_origin();
  const ContactSet set = floor_below(0.0);
  settle(contacts, set, at(0.0, 0.0, -0.01));
  for (int age = 0; age <= 200; ++age)
    contacts.update(set, milliseconds(age), at(0.0, 0.0, -0.01), kTick_s);
  for (int i = 1; i <= 200; ++i) {  // the hand moves on at 0.5 m/s
    const double force = contacts.update(set, nanoseconds(0), at(5e-4 * i, 0.0, -0.01), kTick_s).f.z();
    EXPECT_LE(force, 10.0 * i / 200.0 + 1e-9) << i;
  }
  EXPECT_NEAR(contacts.update(set, nanoseconds(0), at(0.1, 0.0, -0.01), kTick_s).f.z(), 10.0, 1e-9);
}

TEST(ContactForce, IsZeroWithin75MillisecondsAfterTheContactVanishes) {
  for (const double stiffness : {300.0, 1000.0}) {
    OneHandForce contacts(Vector3d::Zero(), kRadius, {stiffness, 10.0}, kMaxForce, Isometry3d::Identity());
    EXPECT_NEAR(settle(contacts, floor_below(0.0), at(0.0, 0.0, -0.4)).f.z(), kMaxForce, 1e-9);
    ContactSet free = floor_below(0.0);
    free.row_count = 0;
    for (int i = 0; i < 75; ++i)
      contacts.update(free, nanoseconds(0), at(0.0, 0.0, -0.4), kTick_s);
    EXPECT_NEAR(contacts.update(free, nanoseconds(0), at(0.0, 0.0, -0.4), kTick_s).f.z(), 0.0, 1e-9);
  }
}

/// A part that lags far behind on a ball, because the simulation is late: the plane at its old place is no wall.
TEST(ContactForce, APartThatLagsBehindOnABallDoesNotHoldTheHandBack) {
  OneHandForce contacts = at_origin();
  ContactSet set = floor_below(0.0);
  set.row_array[0].pushes = true;
  set.row_array[0].range = 1e-3;
  double sideways = 0.0;
  double normal = 0.0;
  constexpr double kBall = 0.35;   // radius, metres
  for (int i = 0; i < 400; ++i) {  // the hand goes round the ball at 0.5 m/s, 10 mm deep, and the set stays fresh
    const double angle = 5e-4 * i / kBall;
    const double r = kBall - 0.01;
    const Isometry3d X_WG = at(r * std::sin(angle), 0.0, r * std::cos(angle) - kBall);
    const Vector3d f = contacts.update(set, nanoseconds(0), X_WG, kTick_s).f;
    const Vector3d out(std::sin(angle), 0.0, std::cos(angle));
    sideways = std::max(sideways, (f - out.dot(f) * out).norm());
    normal = std::max(normal, out.dot(f));
    if (5e-4 * i > 0.012) {
      EXPECT_EQ(f, Vector3d::Zero()) << i;
    }
  }
  EXPECT_GT(normal, 5.0);
  EXPECT_LT(sideways, 0.02 * normal);
}

TEST(ContactForce, ATrackerThatJumpsDoesNotMakeTheForceJump) {
  OneHandForce contacts = at_origin();
  const double before = settle(contacts, floor_below(0.0), at(0.0, 0.0, -3e-3)).f.z();
  const contact::Wrench& wrench = contacts.update(floor_below(0.0), nanoseconds(0), at(0.1, 0.0, -0.1), kTick_s);
  EXPECT_EQ(wrench.f.head<2>(), Eigen::Vector2d::Zero()) << "along the floor there is no force";
  EXPECT_LE(wrench.f.z() - before, kStiffness * (contact::kSlew_m + 2.0 * 2e-3) * (1.0 + 1e-9));
}

TEST(ContactForce, StaysInTheConeOfBothNormalsWhenTheSetChanges) {
  OneHandForce contacts = at_origin();
  settle(contacts, floor_below(0.0), at(2e-3, 0.0, -3e-3));
  ContactSet wall = floor_below(0.0);
  wall.row_array[0].n = -Vector3d::UnitX();
  for (int i = 0; i < 100; ++i) {
    const contact::Wrench& wrench = contacts.update(wall, nanoseconds(0), at(2e-3, 0.0, -3e-3), kTick_s);
    EXPECT_GE(wrench.f.z(), 0.0);
    EXPECT_LE(wrench.f.x(), 0.0);
    EXPECT_EQ(wrench.f.y(), 0.0);
  }
  EXPECT_NEAR(contacts.update(wall, nanoseconds(0), at(2e-3, 0.0, -3e-3), kTick_s).f.x(), -2.0, 1e-9);
}

TEST(ContactForce, AnOffsetOfTheGraspIsNotFelt) {
  OneHandForce contacts = at_origin();
  ContactSet set = floor_below(0.0);
  set.parts[0].X_GT = at(0.0, 0.0, 0.02);  // the part is to follow 20 mm above the ghost
  EXPECT_EQ(settle(contacts, set, at(0.0, 0.0, -0.02)).f, Vector3d::Zero());
}

TEST(ContactForce, FrictionIsItsRatioTimesTheNormalForce) {
  OneHandForce contacts = at_origin();
  ContactSet set = floor_below(0.0);
  set.row_array[0].friction_ratio_W = Vector3d(0.3, 0.0, 0.0);
  const contact::Wrench wrench = settle(contacts, set, at(-3e-3, 0.0, -2e-3));
  EXPECT_TRUE(wrench.f.isApprox(Vector3d(0.6, 0.0, 2.0), 1e-9));
}

// It was found for the lag of the set, and the ghost has moved since: a force that knew only its ratio would drive the
// hand.
TEST(ContactForce, FrictionHoldsBackAndNeverDrives) {
  OneHandForce contacts = at_origin();
  ContactSet set = floor_below(0.0);
  set.row_array[0].friction_ratio_W = Vector3d(0.3, 0.0, 0.0);
  EXPECT_TRUE(settle(contacts, set, at(-0.1e-3, 0.0, -2e-3)).f.isApprox(Vector3d(0.1, 0.0, 2.0), 1e-9))
      << "no farther than where the part is";
  EXPECT_TRUE(settle(contacts, set, at(1e-3, 0.0, -2e-3)).f.isApprox(Vector3d(0.0, 0.0, 2.0), 1e-9)) << "not beyond it";
}

/// The first part slides on the floor; the second is near it and touches nothing.
TEST(ContactForce, FrictionOfOnePartIsNotFeltByAnotherThatItDoesNotTouch) {
  ContactSet set = floor_below(0.0);
  set.part_count = 2;
  set.row_array[0].friction_ratio_W = Vector3d(0.3, 0.0, 0.0);
  set.row_count = 2;
  set.row_array[1] = {{{Vector3d::UnitY(), Vector3d::Zero(), -5e-3}, 0, 1}};
  std::array<LedPart, 2> parts;
  for (LedPart& part : parts)
    part = {.stiffness = {kStiffness, 10.0}, .acts = true};
  parts[0].X_WG = at(-5e-3, 0.0, -5e-3);
  parts[1].X_WG = at(-5e-3, 0.0, 0.0);
  ContactProjection projection(2);
  projection.update(set, nanoseconds(0), parts, kTick_s);
  EXPECT_TRUE(projection.of_part(0).wrench.f.isApprox(Vector3d(1.5, 0.0, 5.0), 1e-9));
  EXPECT_EQ(projection.of_part(1).wrench.f, Vector3d::Zero());
}

/// The first part slides on the second one. Both lag behind by what friction holds back, 1 N, and the first by more.
TEST(ContactForce, FrictionOfTwoPartsActsOnBoth) {
  ContactSet set;
  set.sequence = 1;
  set.part_count = 2;
  set.row_count = 1;
  set.row_array[0] = {{{Vector3d::UnitZ(), Vector3d::Zero(), 0.0}, 0, 1}};
  set.row_array[0].friction_ratio_W = Vector3d(0.5, 0.0, 0.0);
  std::array<LedPart, 2> parts;
  for (LedPart& part : parts)
    part = {.stiffness = {kStiffness, 10.0}, .acts = true};
  parts[0].X_WG = at(-1e-3, 0.0, -4e-3);
  parts[1].X_WG = at(1e-3, 0.0, 0.0);
  ContactProjection projection(2);
  projection.update(set, nanoseconds(0), parts, kTick_s);
  EXPECT_TRUE(projection.of_part(0).wrench.f.isApprox(Vector3d(1.0, 0.0, 2.0), 1e-9)) << "2 mm each";
  EXPECT_TRUE(projection.of_part(1).wrench.f.isApprox(Vector3d(-1.0, 0.0, -2.0), 1e-9));
  parts[0].X_WG = at(-9e-3, 0.0, -4e-3);
  projection.update(set, nanoseconds(0), parts, kTick_s);
  EXPECT_LE(projection.of_part(0).wrench.f.x(), 1.0 + 1e-9) << "no greater than its cone";
}

TEST(ContactForce, AContactThatTheGhostHasLeftNoLongerActs) {
  OneHandForce contacts = at_origin();
  ContactSet set = floor_below(0.0);
  set.row_array[0].range = 4e-3;
  EXPECT_NEAR(settle(contacts, set, at(3.9e-3, 0.0, -2e-3)).f.z(), 2.0, 1e-9);
  EXPECT_NEAR(settle(contacts, set, at(0.0, 0.0, -5e-3)).f.z(), 5.0, 1e-9) << "motion along the normal does not count";
  EXPECT_EQ(settle(contacts, set, at(4.1e-3, 0.0, -2e-3)).f, Vector3d::Zero());
  set.parts[0].X_WG = at(1e-3, 0.0, 0.0);
  EXPECT_NEAR(settle(contacts, set, at(4.1e-3, 0.0, -2e-3)).f.z(), 2.0, 1e-9) << "the range begins at the set's ghost";
}

TEST(ContactForce, MotionOfAnApproachingBodyIsExtrapolated) {
  OneHandForce contacts = at_origin();
  ContactSet set = floor_below(0.0);
  settle(contacts, set, at(0.0, 0.0, -2e-3));
  set.row_array[0].approach = 0.1;  // a lift
  EXPECT_NEAR(contacts.update(set, milliseconds(1), at(0.0, 0.0, -2e-3), kTick_s).f.z(), 2.1, 1e-9);
  EXPECT_NEAR(contacts.update(set, milliseconds(2), at(0.0, 0.0, -2e-3), kTick_s).f.z(), 2.2, 1e-9);
}

TEST(ContactForce, RowsThatContradictEachOtherLetTheForceFadeAndAreTold) {
  OneHandForce contacts = at_origin();
  const ContactSet floor = floor_below(0.0);
  EXPECT_GT(settle(contacts, floor, at(0, 0, -0.01)).f.z(), 9.0);
  EXPECT_FALSE(contacts.is_unsolved());
  ContactSet vise = floor;  // 10 mm up from the floor, 10 mm down from the ceiling
  vise.row_count = 2;
  vise.row_array[0].bound = 0.01;
  vise.row_array[1] = {{{-Vector3d::UnitZ(), Vector3d::Zero(), 0.01}}};
  double last = 20.0;
  for (int i = 0; i < 100; ++i) {
    const double force = contacts.update(vise, nanoseconds(0), at(0, 0, -0.01), kTick_s).f.norm();
    ASSERT_TRUE(contacts.is_unsolved());
    ASSERT_LE(last - force, kMaxForce / 75.0 * 1.000001 + (i == 0 ? 20.0 : 0.0));
    last = force;
  }
  EXPECT_EQ(last, 0.0);
}

TEST(ContactForce, TorqueIsLeverTimesForce) {
  OneHandForce contacts = at_origin();
  ContactSet set = floor_below(0.0);
  set.row_array[0].r = Vector3d(0.01, 0.0, 0.0);
  const contact::Wrench wrench = settle(contacts, set, at(0.0, 0.0, -2e-3));
  EXPECT_GT(wrench.f.z(), 0.0);
  EXPECT_TRUE(wrench.t.isApprox(set.row_array[0].r.cross(wrench.f), 1e-12));
}

}  // namespace
}  // namespace glissade::haptics
