/// The clasp: fingers close tight round an object and never go in.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/sliding_rules.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/clasp.h>
#include <glissade/shapes/household_objects.h>

#include "clasped_hand.h"
#include "mesh_oracle.h"
#include "poses.h"
#include "wild_hand.h"

namespace glissade::grasping {
namespace {

using test_support::at;
using test_support::bent_hand;
using test_support::ClaspedHand;
using test_support::hand_chain;
using test_support::MeshOracle;
using test_support::open_hand;
using test_support::WildHand;

/// A ball in front of the palm.
const Eigen::Isometry3d kAtPalm = at(0.095, 0.0, -0.056);
geometry::TriangleMesh ball() {
  return geometry::make_sphere(0.035, 2000);
}
ClaspedHand hand_at_ball() {
  return {ball(), kAtPalm};
}

void close(Clasp& clasp, double angle, int calls) {
  for (int i = 1; i <= calls; ++i)
    clasp.advance(bent_hand(angle * std::min(1.0, 2.0 * i / calls)));
}

/// Measures triangle by triangle, without trees: where a flex value stops short of its target, one of the links that it
/// moves is within 0.1 mm of the object at the palm. Returns how many flex values do.
int expect_stopped_at_object(const Posture& posture, const Posture& target, const geometry::TriangleMesh& object) {
  constexpr double kTight_m = 0.1e-3;
  geometry::TriangleMesh object_W = object;
  for (Eigen::Vector3d& vertex : object_W.vertices)
    vertex = kAtPalm * vertex;
  const KinematicChain& chain = *hand_chain();
  std::vector<Eigen::Isometry3d> X_WL(chain.links().size());
  chain.poses(posture.X_WR, posture.values, X_WL);
  std::vector<bool> is_near(X_WL.size());
  for (std::size_t link = 0; link < X_WL.size(); ++link) {
    const auto& mesh = chain.links()[link].mesh;
    is_near[link] = mesh != nullptr && !MeshOracle(object_W, *mesh).pairs_within(X_WL[link], kTight_m).empty();
  }
  int stopped = 0;
  for (std::size_t v = 0; v < target.values.size(); ++v) {
    if (posture.values[v] == target.values[v]) continue;
    ++stopped;
    bool is_at_object = false;
    for (std::size_t link = 0; link < X_WL.size(); ++link)
      is_at_object = is_at_object || (is_near[link] && chain.moves(v, link));
    EXPECT_TRUE(is_at_object) << "nothing stops " << chain.values()[v].name;
  }
  return stopped;
}

TEST(Clasp, FollowsATargetThatTouchesNothing) {
  ClaspedHand hand(geometry::make_sphere(0.03, 200), at(1.0, 0.0, 0.0));
  hand.clasp.advance(open_hand());
  EXPECT_EQ(hand.clasp.state(), ClaspState::kClasping);
  Posture target = bent_hand(0.8);
  target.X_WR = at(0.01, 0.02, 0.03);
  for (int i = 0; i < 40; ++i)
    hand.clasp.advance(target);
  EXPECT_EQ(hand.clasp.posture().values, target.values);
  EXPECT_TRUE(hand.clasp.posture().X_WR.isApprox(target.X_WR, 1e-12));
  EXPECT_TRUE(hand.clasp.contacts().empty());
}

TEST(Clasp, ClosesTightRoundABallAndStaysOutside) {
  ClaspedHand hand = hand_at_ball();
  Posture last = open_hand();
  hand.clasp.advance(last);
  for (int i = 1; i <= 200; ++i) {
    hand.clasp.advance(bent_hand(1.2 * std::min(1.0, i / 100.0)));
    ASSERT_FALSE(hand.collides(hand.clasp.posture())) << i;
    ASSERT_FALSE(hand.way_collides(last, 4)) << i;
    last = hand.clasp.posture();
  }
  const auto count = std::count(hand.clasp.touching().begin(), hand.clasp.touching().end(), 1);
  EXPECT_GE(count, 4) << "segments that touch";
  EXPECT_GE(expect_stopped_at_object(hand.clasp.posture(), bent_hand(1.2), ball()), 8)
      << "flex values that something stops";
}

TEST(Clasp, TouchesAnObstacleWithAWideMarginToo) {
  constexpr double kMargin_m = contact::kGreatestMargin_m;
  const auto ball = std::make_shared<const contact::ContactBody>(
      std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(0.035, 2000)));
  Clasp clasp(hand_chain(), {{ball, at(0.095, 0.0, -0.056), "the ball", kMargin_m}}, {});
  clasp.advance(open_hand());
  close(clasp, 1.2, 200);
  EXPECT_GE(std::count(clasp.touching().begin(), clasp.touching().end(), 1), 4);
  for (const LinkContact& touch : clasp.contacts())
    EXPECT_GE(touch.contact.gap, 0.9 * kMargin_m);
}

// A hand at rest may take more of margins than one that moves, but an obstacle with a small margin of its own stops it.
TEST(Clasp, GoesIntoNoObstacleWithASmallMargin) {
  const geometry::TriangleMesh mesh = shapes::household_objects()[0].make(8e-3);
  ClaspedHand check(mesh, Eigen::Isometry3d::Identity());
  const auto body = std::make_shared<const contact::ContactBody>(std::make_shared<const geometry::TriangleMesh>(mesh));
  Clasp clasp(hand_chain(), {{body, Eigen::Isometry3d::Identity(), "the ball", 2e-6}}, {});
  const WildHand wild(700000, test_support::WildMotion::kRandom, mesh);
  clasp.move_cart(wild.at_ms(0));
  for (int ms = 0; ms < WildHand::kMs + 400; ++ms) {
    clasp.advance(wild.at_ms(std::min(ms, WildHand::kMs)));
    for (const Posture& posture : clasp.way())
      ASSERT_FALSE(check.collides(posture)) << ms << " ms";
  }
  EXPECT_FALSE(clasp.contacts().empty());
}

TEST(Clasp, GoesOnInTheNextCallsWhereTheBudgetOfWorkIsUsedUp) {
  const auto ball = std::make_shared<const contact::SlidingPart>(
      std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(0.035, 2000)));
  Clasp clasp(hand_chain(), {}, {ball}, {.work_budget = 1});
  clasp.place_object(0, at(0.095, 0.0, -0.056));
  clasp.advance(open_hand());
  const Posture fist = bent_hand(1.2);
  clasp.advance(fist);
  EXPECT_EQ(clasp.way().size(), 1U) << "no call is without a step";
  for (int i = 0; i < 300; ++i) {
    clasp.advance(fist);
    ASSERT_LE(clasp.way().size(), 1U);
  }
  EXPECT_GE(std::count(clasp.touching().begin(), clasp.touching().end(), 1), 4);
}

TEST(Clasp, NoFlexValueAloneCanComeNearerToItsTarget) {
  ClaspedHand hand = hand_at_ball();
  hand.clasp.advance(open_hand());
  close(hand.clasp, 1.2, 300);
  const Posture target = bent_hand(1.2);
  constexpr double kFarther_rad = 0.2e-3 / 0.02;  // moves the point of a finger that is 20 mm from the joint by 0.2 mm
  for (std::size_t v = 0; v < target.values.size(); ++v) {
    const double left = target.values[v] - hand.clasp.posture().values[v];
    if (std::abs(left) < kFarther_rad) continue;
    Posture nearer = hand.clasp.posture();
    nearer.values[v] += std::copysign(kFarther_rad, left);
    EXPECT_TRUE(hand.collides(nearer)) << hand_chain()->values()[v].name << " stopped " << left << " rad too early";
  }
}

TEST(Clasp, OpensAgain) {
  ClaspedHand hand = hand_at_ball();
  hand.clasp.advance(open_hand());
  close(hand.clasp, 1.2, 200);
  for (int i = 0; i < 100; ++i)
    hand.clasp.advance(open_hand());
  EXPECT_EQ(hand.clasp.posture().values, open_hand().values);
  EXPECT_TRUE(hand.clasp.contacts().empty());
}

TEST(Clasp, SlidesAlongAPlateThatThePalmIsPressedOn) {
  ClaspedHand hand(geometry::make_plate({0.6, 0.6}, 200), at(0.1, 0.0, -0.08));
  hand.clasp.advance(open_hand());
  Posture pressed = open_hand();
  for (int i = 0; i < 100; ++i) {
    pressed.X_WR = at(0.0, 0.0, -1e-3 * i);
    hand.clasp.advance(pressed);
  }
  const double height = hand.clasp.posture().X_WR.translation().z();
  EXPECT_GT(height, -0.08);
  for (int i = 0; i < 100; ++i) {
    pressed.X_WR = at(0.0, 0.5e-3 * i, -0.1);
    hand.clasp.advance(pressed);
  }
  EXPECT_FALSE(hand.collides(hand.clasp.posture()));
  EXPECT_NEAR(hand.clasp.posture().X_WR.translation().y(), 0.0495, 1e-3);
}

TEST(Clasp, PassesThroughNoSheetHoweverFastTheHand) {
  ClaspedHand hand(geometry::make_plate({0.6, 0.6}, 200), at(0.1, 0.0, -0.08));
  hand.clasp.advance(open_hand());
  Posture beyond = open_hand();
  beyond.X_WR = at(0.0, 0.0, -0.3);
  for (int i = 0; i < 100; ++i)
    hand.clasp.advance(beyond);
  EXPECT_GT(hand.clasp.posture().X_WR.translation().z(), -0.08) << "the target itself is free";
}

TEST(Clasp, WaitsWhileTheStartIsInsideAnObject) {
  ClaspedHand hand(geometry::make_sphere(0.035, 2000), at(0.095, 0.0, 0.0));
  hand.clasp.advance(open_hand());
  EXPECT_EQ(hand.clasp.state(), ClaspState::kWaiting);
  EXPECT_TRUE(hand.clasp.contacts().empty());
  Posture away = open_hand();
  away.X_WR = at(0.0, 0.0, 0.2);
  hand.clasp.advance(away);
  EXPECT_EQ(hand.clasp.state(), ClaspState::kClasping);
  EXPECT_EQ(hand.clasp.posture().values, away.values);
}

TEST(Clasp, WaitsAfterTheCartHasMovedTheHandIntoAnObject) {
  ClaspedHand hand = hand_at_ball();
  hand.clasp.advance(open_hand());
  Posture inside = open_hand();
  inside.X_WR = at(0.0, 0.0, -0.05);
  hand.clasp.move_cart(inside);
  EXPECT_EQ(hand.clasp.state(), ClaspState::kWaiting);
  hand.clasp.advance(inside);
  EXPECT_EQ(hand.clasp.state(), ClaspState::kWaiting);
  EXPECT_TRUE(hand.clasp.contacts().empty());
  hand.clasp.advance(open_hand());
  EXPECT_EQ(hand.clasp.state(), ClaspState::kClasping);
}

TEST(Clasp, WaitsWhenAnObjectIsPlacedInsideTheHand) {
  ClaspedHand hand = hand_at_ball();
  hand.clasp.advance(open_hand());
  hand.clasp.place_object(0, at(0.095, 0.0, 0.0));
  EXPECT_EQ(hand.clasp.state(), ClaspState::kWaiting);
}

// Open meshes have no inside, so only surfaces count.
TEST(Clasp, AHandWithinASolidCountsAsFreeAndStaysWithin) {
  ClaspedHand hand(geometry::make_box({1.0, 1.0, 1.0}, 1000), Eigen::Isometry3d::Identity());
  hand.clasp.advance(open_hand());
  EXPECT_EQ(hand.clasp.state(), ClaspState::kClasping);
  Posture beyond = open_hand();
  beyond.X_WR = at(0.0, 0.0, 2.0);
  for (int i = 0; i < 500; ++i)
    hand.clasp.advance(beyond);
  EXPECT_GT(hand.clasp.posture().X_WR.translation().z(), 0.4);
  EXPECT_LT(hand.clasp.posture().X_WR.translation().z(), 0.5);
  EXPECT_FALSE(hand.clasp.contacts().empty());
}

TEST(Clasp, APeaWithinThePalmCountsAsFreeAndHoldsThePalm) {
  ClaspedHand hand(geometry::make_sphere(0.006, 500), at(0.045, 0.01, 0.0));
  hand.clasp.advance(open_hand());
  EXPECT_EQ(hand.clasp.state(), ClaspState::kClasping);
  Posture away = open_hand();
  away.X_WR = at(0.0, 0.0, 0.2);
  for (int i = 0; i < 500; ++i) {
    const Posture last = hand.clasp.posture();
    hand.clasp.advance(away);
    ASSERT_FALSE(hand.way_collides(last, 4)) << i;
  }
  EXPECT_LT(hand.clasp.posture().X_WR.translation().z(), 0.05) << "the palm has slid along the pea within it";
  EXPECT_FALSE(hand.clasp.contacts().empty());
}

TEST(Clasp, IgnoresATargetThatIsNotFinite) {
  ClaspedHand hand = hand_at_ball();
  hand.clasp.advance(open_hand());
  Posture bad = bent_hand(0.5);
  bad.values[5] = std::numeric_limits<double>::quiet_NaN();
  hand.clasp.advance(bad);
  EXPECT_EQ(hand.clasp.posture().values, open_hand().values);
  bad = open_hand();
  bad.X_WR.translation().x() = std::numeric_limits<double>::infinity();
  hand.clasp.advance(bad);
  EXPECT_EQ(hand.clasp.posture().values, open_hand().values);
}

TEST(Clasp, GivesTheSameBitsAgain) {
  ClaspedHand first = hand_at_ball();
  ClaspedHand second = hand_at_ball();
  for (ClaspedHand* hand : {&first, &second}) {
    hand->clasp.advance(open_hand());
    close(hand->clasp, 1.0, 100);
  }
  EXPECT_EQ(first.clasp.posture().values, second.clasp.posture().values);
  EXPECT_EQ(first.clasp.posture().X_WR.matrix(), second.clasp.posture().X_WR.matrix());
}

}  // namespace
}  // namespace glissade::grasping
