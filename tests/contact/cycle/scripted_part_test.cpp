// Parts that scripts move beside the one in the hand: a ram that pushes, a lift that waits, another hand.

#include <chrono>
#include <stdexcept>

#include <gtest/gtest.h>

#include <glissade/contact/sliding.h>
#include <glissade/reference/brute_force.h>
#include <glissade/reference/sliding_method.h>

#include "held_part.h"
#include "poses.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using std::chrono::milliseconds;
using test_support::cube;
using test_support::pose;
using test_support::wall;

constexpr double kTwoMargins = 20e-6;

/// A cube of 40 mm that goes along x at 0.1 m/s, from -30 mm to -20 mm: its face from -10 mm to 0.
ScriptedPart ram() {
  return {.part_B = cube(0.04),
          .script_X_WB = geometry::PoseTrajectory(
              {{milliseconds(0), pose({-0.03, 0.0, 0.0})}, {milliseconds(100), pose({-0.02, 0.0, 0.0})}}),
          .name = "the ram"};
}

/// A cube of 20 mm in the hand, which is where the ram comes by, and a wall behind it.
Sliding cube_before(const ScriptedPart& ram, double wall_x) {
  return {{wall(wall_x)}, cube(0.02), pose({0.005, 0.0, 0.0}), {}, {ram}};
}

double x_of(const Isometry3d& X) {
  return X.translation().x();
}

/// The hand holds still.
void wait(Sliding& sliding, int calls) {
  const Isometry3d X_WG = sliding.result().X_WG;
  for (int i = 0; i < calls; ++i) {
    sliding.advance(X_WG);
    ASSERT_FALSE(reference::brute_force_intersects(cube(0.04)->tree.mesh(), sliding.part().tree.mesh(),
                                                   sliding.scripted_X_WB()[0].inverse() * sliding.result().X_WV));
  }
}

TEST(ScriptedPart, PushesThePartOutOfItsWayAndTheHandFeelsIt) {
  Sliding sliding = cube_before(ram(), 1.0);
  wait(sliding, 120);
  EXPECT_NEAR(x_of(sliding.scripted_X_WB()[0]), -0.02, kTwoMargins) << "it goes where it wants";
  EXPECT_NEAR(x_of(sliding.result().X_WV), 0.01, 2.0 * kTwoMargins) << "the part gives way by 5 mm";
  EXPECT_NEAR(test_support::sum_of_contacts(sliding).f.x(), 5.0, 0.05) << "1000 N/m";
  for (const Contact& contact : sliding.result().contacts)
    EXPECT_EQ(contact.obstacle, 2) << "of the bodies: the wall, the part, and then what moves";
}

TEST(ScriptedPart, ContactReportsTheApproachSpeed) {
  Sliding sliding = cube_before(ram(), 1.0);
  wait(sliding, 80);
  ASSERT_FALSE(sliding.result().contacts.empty());
  for (const Contact& contact : sliding.result().contacts)
    EXPECT_NEAR(contact.approach, 0.1, 1e-3) << "along the normal, towards the part";
  wait(sliding, 60);
  for (const Contact& contact : sliding.result().contacts)
    EXPECT_NEAR(contact.approach, 0.0, 1e-6) << "the script has ended";
}

TEST(ScriptedPart, WaitsWhereThePartCannotGiveWay) {
  Sliding sliding = cube_before(ram(), 0.018);
  wait(sliding, 200);
  EXPECT_NEAR(x_of(sliding.result().X_WV), 0.008, kTwoMargins) << "at the wall";
  EXPECT_NEAR(x_of(sliding.scripted_X_WB()[0]), -0.022, 2.0 * kTwoMargins);
}

TEST(ScriptedPart, GripStiffnessSharesTheLagWithTheHand) {
  ScriptedPart other_hand = ram();
  other_hand.grip_N_per_m = 1000.0;
  Sliding sliding = cube_before(other_hand, 1.0);
  wait(sliding, 150);
  EXPECT_NEAR(x_of(sliding.result().X_WV), 0.0075, kTwoMargins) << "half of 5 mm each";
  EXPECT_NEAR(x_of(sliding.scripted_X_WB()[0]), -0.0225, kTwoMargins);
}

TEST(ScriptedPart, FollowsTheTimeOfCalls) {
  ScriptedPart late = ram();
  late.start = milliseconds(40);
  Sliding sliding({wall(1.0)}, cube(0.02), pose({0.1, 0.0, 0.0}), {}, {late});
  const auto expect_at = [&](double milliseconds_of_script) {
    EXPECT_NEAR(x_of(sliding.scripted_X_WB()[0]), -0.03 + 1e-4 * milliseconds_of_script, 1e-12);
  };
  expect_at(40.0);
  sliding.advance(pose({0.1, 0.0, 0.0}), 0.0);
  expect_at(40.0);
  sliding.advance(pose({0.1, 0.0, 0.0}));
  expect_at(41.0);
  sliding.advance(pose({0.1, 0.0, 0.0}), 2.5);
  expect_at(43.5);
}

TEST(ScriptedPart, StopsAtAReleasedPart) {
  Sliding sliding = cube_before(ram(), 1.0);
  sliding.release();
  wait(sliding, 150);
  EXPECT_EQ(x_of(sliding.result().X_WV), 0.005);
  EXPECT_NEAR(x_of(sliding.scripted_X_WB()[0]), -0.025, kTwoMargins) << "it has come to the part";
}

TEST(ScriptedPart, LeavesThePartAloneWhereTheyDoNotMeet) {
  Sliding alone({wall(0.02)}, cube(0.02), pose({0.005, 0.0, 0.0}));
  ScriptedPart aside = ram();
  aside.script_X_WB = geometry::PoseTrajectory(
      {{milliseconds(0), pose({-0.03, 0.2, 0.0})}, {milliseconds(100), pose({0.03, 0.2, 0.0})}});
  Sliding beside = cube_before(aside, 0.02);
  for (int i = 0; i < 100; ++i) {
    const Isometry3d X_WG = pose({0.005 + 1e-4 * i, 2e-5 * i, 0.0});
    ASSERT_LT((alone.advance(X_WG).X_WV.translation() - beside.advance(X_WG).X_WV.translation()).norm(), 1e-9)
        << "call " << i;
  }
}

TEST(ScriptedPart, ContactsReferToItsCurrentPose) {
  // It comes near, by 1 mm in 10 ms, and goes away again, and never touches.
  ScriptedPart visitor = ram();
  visitor.script_X_WB = geometry::PoseTrajectory({{milliseconds(0), pose({-0.0262, 0.0, 0.0})},
                                                  {milliseconds(10), pose({-0.0252, 0.0, 0.0})},
                                                  {milliseconds(20), pose({-0.0262, 0.0, 0.0})}});
  Sliding sliding({wall(1.0)}, cube(0.02), pose({0.005, 0.0, 0.0}), {.rules = {.contacts_ahead_ms = 3.0}}, {visitor});
  int seen = 0;
  for (int i = 0; i < 20; ++i) {
    sliding.advance(sliding.result().X_WG);
    const double gap = (x_of(sliding.result().X_WV) - 0.01) - (x_of(sliding.scripted_X_WB()[0]) + 0.02);
    for (const Contact& contact : sliding.result().contacts) {
      EXPECT_NEAR(contact.gap, gap, 1e-12) << "call " << i;
      EXPECT_NEAR(contact.q_W().x(), x_of(sliding.scripted_X_WB()[0]) + 0.02, 1e-12);
      ++seen;
    }
  }
  EXPECT_GT(seen, 4);
}

TEST(ScriptedPart, NeitherSearchesInASpiralNorIsDepenetrated) {
  const SlidingOptions options{.rules = {.overlap = OverlapRule::kDepenetrate, .spiral_search = true}};
  Sliding waiting({wall(0.018)}, cube(0.02), pose({0.005, 0.0, 0.0}), options, {ram()});
  wait(waiting, 200);
  const Isometry3d X_WB = waiting.scripted_X_WB()[0];
  for (int i = 0; i < 500; ++i) {
    wait(waiting, 1);
    ASSERT_LT((waiting.scripted_X_WB()[0].translation() - X_WB.translation()).norm(), kTwoMargins) << "call " << i;
  }
  EXPECT_THROW(Sliding({wall(-0.03)}, cube(0.02), pose({0.1, 0.0, 0.0}), options, {ram()}), std::invalid_argument);
}

TEST(ScriptedPart, IsRefusedWhereItCollidesAtItsStart) {
  ScriptedPart inside = ram();
  inside.start = milliseconds(90);
  EXPECT_THROW(cube_before(inside, 1.0), std::invalid_argument);
}

TEST(ScriptedPart, IsRefusedByThePaperMethod) {
  EXPECT_THROW(reference::make_sliding(reference::SlidingMethod::kPaper, {wall(1.0)}, cube(0.02),
                                       pose({0.005, 0.0, 0.0}), {}, {ram()}),
               std::invalid_argument);
}

}  // namespace
}  // namespace glissade::contact
