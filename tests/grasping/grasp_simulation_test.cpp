/// The life of a grasp: grasp, carry, slide, push, let go, one and two hands, and a hand that is lost.

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include <glissade/grasping/grasp_simulation.h>

#include "clasped_hand.h"
#include "hand/hand_links.h"
#include "hand_and_ball.h"
#include "poses.h"

namespace glissade::grasping {
namespace {

using hands::HandActivity;

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::at;
using test_support::bent_hand;
using test_support::hand_chain;
using test_support::open_hand;

Posture moved(Posture posture, double x, double y, double z) {
  posture.X_WR = at(x, y, z) * posture.X_WR;
  return posture;
}

void close_round_ball(HandAndBall& scene) {
  for (int ms = 0; ms <= 200; ++ms)
    scene.advance(bent_hand(1.2 * std::min(1.0, ms / 150.0)));
}

TEST(GraspSimulation, TakesHoldOfThePartThatTheHandClosesRound) {
  HandAndBall scene;
  scene.advance(open_hand());
  EXPECT_EQ(scene.simulation.activity(0), HandActivity::kFree);
  EXPECT_FALSE(scene.simulation.held_part(0));
  close_round_ball(scene);
  EXPECT_EQ(scene.simulation.activity(0), HandActivity::kHolding);
  EXPECT_EQ(scene.simulation.held_part(0), 0U);
}

TEST(GraspSimulation, PartDoesNotMoveWhenGrasped) {
  HandAndBall scene;
  int ms = 0;
  for (; ms < 400 && !scene.simulation.held_part(0); ++ms)
    scene.advance(bent_hand(1.2 * std::min(1.0, ms / 150.0)));
  ASSERT_TRUE(scene.simulation.held_part(0));
  const Isometry3d X_WV = scene.X_WV();
  for (int i = 0; i < 100; ++i) {
    scene.advance(bent_hand(1.2 * std::min(1.0, ++ms / 150.0)));
    ASSERT_LT((scene.X_WV().translation() - X_WV.translation()).norm(), 1e-6) << i << " ms after";
  }
}

/// The mean of the points of the ball that these hands touch, in the frame of the ball.
Vector3d middle_of_contacts(const GraspSimulation& simulation, const std::vector<std::size_t>& hands) {
  Vector3d sum = Vector3d::Zero();
  double count = 0.0;
  for (const std::size_t h : hands) {
    for (const LinkContact& touch : simulation.clasp(h).contacts()) {
      sum += touch.contact.q_W();
      count += 1.0;
    }
  }
  return simulation.parts().result(0).X_WV.inverse(Eigen::Isometry) * (sum / count);
}

TEST(GraspSimulation, CouplesAHeldPartWhereTheHandGripsIt) {
  HandAndBall scene;
  const Vector3d own = scene.simulation.parts().part(0).p_Vref();
  for (int ms = 0; ms < 400 && !scene.simulation.held_part(0); ++ms)
    scene.advance(bent_hand(1.2 * std::min(1.0, ms / 150.0)));
  ASSERT_TRUE(scene.simulation.held_part(0));
  const Vector3d grip = scene.simulation.parts().p_Vref(0);
  EXPECT_LT((grip - middle_of_contacts(scene.simulation, {0})).norm(), 1e-12);
  EXPECT_GT((grip - own).norm(), 1e-3) << "more fingers touch it on one side";
  for (int ms = 0; ms < 200; ++ms)
    scene.advance(bent_hand(1.2 * std::max(0.0, 1.0 - ms / 100.0)));
  EXPECT_FALSE(scene.simulation.held_part(0));
  EXPECT_EQ(scene.simulation.parts().p_Vref(0), own);
}

TEST(GraspSimulation, CouplesAHeldPartWhereTheSceneSays) {
  const auto ball = std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(kBallRadius_m, 2000));
  const Vector3d chosen(0.0, 0.0, 0.03);
  GraspSimulation simulation(
      {},
      {{.part_V = std::make_shared<const contact::SlidingPart>(ball, chosen), .X_WV_start = at(0.095, 0.0, -0.056)}},
      {test_support::hand_model()});
  for (int ms = 0; ms < 400 && !simulation.held_part(0); ++ms)
    simulation.advance(std::vector<std::optional<Posture>>{bent_hand(1.2 * std::min(1.0, ms / 150.0))});
  ASSERT_TRUE(simulation.held_part(0));
  EXPECT_EQ(simulation.parts().p_Vref(0), chosen);
}

TEST(GraspSimulation, CarriesAHeldPartRigidlyWithThePalm) {
  HandAndBall scene;
  close_round_ball(scene);
  const Isometry3d X_WV = scene.X_WV();
  const Posture closed = bent_hand(1.2);
  for (int ms = 1; ms <= 400; ++ms)
    scene.advance(moved(closed, 0.0, 0.0, 0.25e-3 * std::min(ms, 300)));
  EXPECT_EQ(scene.simulation.held_part(0), 0U);
  EXPECT_LT((scene.X_WV().translation() - X_WV.translation() - Vector3d(0.0, 0.0, 0.075)).norm(), 1e-3);
  const Posture& visible = scene.simulation.posture(0);
  EXPECT_LT((visible.X_WR.translation() - Vector3d(0.0, 0.0, 0.075)).norm(), 2e-3);
}

TEST(GraspSimulation, StopsAtAWallByThePartOrTheHand) {
  HandAndBall scene;
  close_round_ball(scene);
  const Posture closed = bent_hand(1.2);
  double furthest = 0.0;
  for (int ms = 1; ms <= 500; ++ms) {
    scene.advance(moved(closed, 0.3e-3 * ms, 0.1e-3 * ms, 0.0));
    furthest = std::max(furthest, scene.X_WV().translation().x());
  }
  EXPECT_EQ(scene.simulation.held_part(0), 0U);
  EXPECT_LT(furthest, 0.24 - kBallRadius_m);
  EXPECT_GT(scene.force(), 1.0) << "the hand feels the wall";
  EXPECT_GT(scene.X_WV().translation().y(), 0.03) << "it slides along the wall";
}

TEST(GraspSimulation, LetsGoWhenTheHandOpens) {
  HandAndBall scene;
  close_round_ball(scene);
  for (int ms = 0; ms < 200; ++ms)
    scene.advance(bent_hand(1.2 * std::max(0.0, 1.0 - ms / 100.0)));
  EXPECT_EQ(scene.simulation.activity(0), HandActivity::kFree);
  EXPECT_EQ(scene.force(), 0.0);
  const Isometry3d X_WV = scene.X_WV();
  for (int ms = 1; ms <= 200; ++ms)
    scene.advance(moved(open_hand(), 0.0, 0.0, 0.5e-3 * ms));
  EXPECT_EQ(scene.X_WV().matrix(), X_WV.matrix()) << "a part stays where it was left";
  EXPECT_LT((scene.simulation.posture(0).X_WR.translation() - Vector3d(0.0, 0.0, 0.1)).norm(), 1e-3);
}

TEST(GraspSimulation, PushesALoosePartAlongUntilTheWallStopsIt) {
  HandAndBall scene;
  // Straight fingers from the wrist push the ball with their tips: from x = -0.13 on.
  Posture hand = moved(open_hand(), -0.15, 0.0, -0.056);
  scene.advance(hand);
  const double z = scene.X_WV().translation().z();
  for (int ms = 1; ms <= 800; ++ms)
    scene.advance(moved(hand, 0.2e-3 * ms, 0.0, 0.0));
  EXPECT_FALSE(scene.simulation.held_part(0));
  EXPECT_GT(scene.X_WV().translation().x(), 0.15);
  EXPECT_LT(std::abs(scene.X_WV().translation().z() - z), 0.03);
  for (int ms = 1; ms <= 400; ++ms)
    scene.advance(moved(hand, 0.16 + 0.2e-3 * ms, 0.0, 0.0));
  EXPECT_NEAR(scene.X_WV().translation().x(), 0.24 - kBallRadius_m, 0.5e-3) << "a facet of the ball lies at the wall";
}

TEST(GraspSimulation, ForceFadesWhileTheHandIsLost) {
  HandAndBall scene;
  close_round_ball(scene);
  const Posture closed = bent_hand(1.2);
  for (int ms = 1; ms <= 500; ++ms)
    scene.advance(moved(closed, 0.3e-3 * ms, 0.0, 0.0));
  ASSERT_GT(scene.force(), 1.0);
  const Isometry3d X_WV = scene.X_WV();
  double last = scene.force();
  for (int ms = 0; ms < 1500; ++ms) {
    scene.lose();
    ASSERT_LE(scene.force(), last * (1.0 + 1e-9)) << ms;
    const double slowest = scene.simulation.parts().stiffness(0).translational * 0.11e-3;
    ASSERT_GE(scene.force(), last - slowest) << "it fades, and does not jump, after " << ms;
    last = scene.force();
  }
  EXPECT_EQ(scene.simulation.activity(0), HandActivity::kHolding) << "nothing is dropped";
  EXPECT_EQ(scene.simulation.held_part(0), 0U);
  EXPECT_TRUE(scene.simulation.clasp(0).contacts().empty()) << "no finger feels anything";
  EXPECT_LT(scene.force(), 1e-9);
  EXPECT_LT((scene.X_WV().translation() - X_WV.translation()).norm(), 1e-3);
  for (int ms = 0; ms < 300; ++ms)
    scene.advance(closed);
  EXPECT_EQ(scene.simulation.activity(0), HandActivity::kHolding);
}

TEST(GraspSimulation, IncrementalPartIsPushedButNeverPulledBack) {
  HandAndBall scene(1, 0.25, contact::Metaphor::kIncremental);
  const Posture hand = moved(open_hand(), -0.15, 0.0, -0.056);
  scene.advance(hand);
  for (int ms = 1; ms <= 1200; ++ms)
    scene.advance(moved(hand, 0.2e-3 * ms, 0.0, 0.0));
  const double at_wall = scene.X_WV().translation().x();
  EXPECT_GT(at_wall, 0.2);
  for (int ms = 1; ms <= 100; ++ms) {
    scene.advance(moved(hand, 0.24 - 0.1e-3 * ms, 0.0, 0.0));
    ASSERT_NEAR(scene.X_WV().translation().x(), at_wall, 0.5e-3) << "the hand draws back, " << ms;
  }
}

TEST(GraspSimulation, IncrementalPartStaysWhenItsHandIsLost) {
  HandAndBall scene(1, 0.25, contact::Metaphor::kIncremental);
  close_round_ball(scene);
  for (int ms = 1; ms <= 300; ++ms)
    scene.advance(moved(bent_hand(1.2), 0.3e-3 * ms, 0.0, 0.0));
  ASSERT_EQ(scene.simulation.held_part(0), 0U);
  const Isometry3d X_WV = scene.X_WV();
  for (int ms = 0; ms < 100; ++ms)
    scene.lose();
  EXPECT_LT((scene.X_WV().translation() - X_WV.translation()).norm(), 1e-6);
}

TEST(GraspSimulation, IsBitIdenticalToMultiPartSlidingWithoutHands) {
  const auto ball = std::make_shared<const contact::SlidingPart>(
      std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(kBallRadius_m, 500)));
  const auto wall = std::make_shared<const contact::ContactBody>(
      std::make_shared<const geometry::TriangleMesh>(geometry::make_box({0.1, 0.6, 0.6}, 200)));
  const std::vector<contact::Obstacle> obstacles{{wall, at(0.15, 0.0, 0.0), "the wall"}};
  const std::vector<contact::HeldPart> parts{{.part_V = ball}, {.part_V = ball, .X_WV_start = at(0.0, 0.1, 0.0)}};
  contact::MultiPartSliding sliding(obstacles, parts);
  GraspSimulation simulation(obstacles, parts);
  for (int ms = 0; ms < 300; ++ms) {
    const std::array X_WG{at(5e-4 * ms, 2e-4 * ms, 1e-4 * ms), at(-1e-4 * ms, 0.1 - 3e-4 * ms, 0.0)};
    if (ms == 150) {
      sliding.release(1);
      simulation.leave_part(1);
    }
    if (ms == 200) {
      sliding.grasp(1, X_WG[1]);
      simulation.take_part(1, X_WG[1]);
    }
    sliding.advance(X_WG);
    simulation.advance(X_WG, {}, 1.0);
    for (std::size_t p = 0; p < 2; ++p) {
      ASSERT_EQ(simulation.parts().result(p).X_WV.matrix(), sliding.result(p).X_WV.matrix()) << ms;
      ASSERT_EQ(simulation.parts().lag(p).v, sliding.lag(p).v) << ms;
    }
  }
  EXPECT_GT(sliding.result(0).pushing, 0) << "the test's own premise";
}

const Isometry3d kBallAtStart = at(0.095, 0.0, -0.056);

/// A call in which the test decides what the hand holds; the ball, if it is held, is to be at X_WG.
void lead(HandAndBall& scene, const std::optional<Posture>& posture, std::optional<std::size_t> part,
          const Isometry3d& X_WG = kBallAtStart) {
  scene.simulation.advance(std::array{X_WG}, std::array{HandTarget{posture, part}}, 1.0);
}

// A hand that is only carried on from where it was lost would meet the wall.
TEST(GraspSimulation, HandThatLetsGoWhileLostResumesAtAFreeTarget) {
  HandAndBall scene;
  const Posture here = moved(open_hand(), 0.0, 0.0, 0.1);
  for (int ms = 0; ms < 3; ++ms)
    lead(scene, here, ms == 0 ? std::nullopt : std::optional<std::size_t>(0));
  ASSERT_EQ(scene.simulation.held_part(0), 0U);
  lead(scene, {}, 0);
  lead(scene, {}, {});
  EXPECT_EQ(scene.simulation.activity(0), HandActivity::kLost);
  const Posture beyond = moved(open_hand(), 0.5, 0.0, 0.1);
  lead(scene, beyond, {});
  EXPECT_EQ(scene.simulation.activity(0), HandActivity::kFree);
  EXPECT_TRUE(scene.simulation.posture(0).X_WR.isApprox(beyond.X_WR));
}

TEST(GraspSimulation, DecidesNothingNewAboutAHandThatIsLost) {
  HandAndBall scene;
  lead(scene, moved(open_hand(), 0.0, 0.0, 0.1), {});
  for (int ms = 0; ms < 6; ++ms) {
    lead(scene, {}, ms % 2 == 0 ? std::optional<std::size_t>(0) : std::nullopt);
    EXPECT_EQ(scene.simulation.decision(0).number, 0) << ms;
  }
}

// A decider may follow a decision late: after the hand is lost, or after the simulation has withdrawn the decision. The
// hand then begins where its palm is away from the ball, with fingers that would be inside if they held it.
TEST(GraspSimulation, LostHandIgnoresAnExternalGraspDecision) {
  for (const bool follows_late : {false, true}) {
    HandAndBall scene;
    const HoldDecision& decision = scene.simulation.decision(0);
    const auto advance = [&](const std::optional<Posture>& posture, std::optional<std::size_t> part,
                             const Isometry3d& X_WG) {
      lead(scene, posture, part, X_WG);
      ASSERT_FALSE(is_present(scene.simulation.activity(0)) && scene.collides());
    };
    for (int ms = 0; ms < 400 && !decision.part; ++ms)
      advance(bent_hand(1.2 * std::min(1.0, ms / 150.0)), {}, scene.X_WV());
    ASSERT_EQ(decision.part, 0U);
    Posture closed = bent_hand(1.2);
    if (follows_late) advance({}, {}, scene.X_WV());
    const Isometry3d X_WV = scene.X_WV();
    scene.simulation.take_part(0, X_WV);
    closed.values[kWristFlexionValue] = -1.0;
    hand_chain()->clamp(closed.values);
    for (int ms = 0; ms < 3; ++ms) {
      if (ms == 2) scene.simulation.leave_part(0);
      advance(ms > 0 ? std::optional(closed) : std::nullopt, ms < 2 ? std::optional<std::size_t>(0) : std::nullopt,
              at(0.0, 0.0, -1e-3 * ms) * X_WV);
      EXPECT_FALSE(scene.simulation.held_part(0)) << ms;
      EXPECT_EQ(scene.simulation.activity(0), ms > 0 ? HandActivity::kFree : HandActivity::kLost) << ms;
      EXPECT_FALSE(decision.part) << "the decision is withdrawn, " << ms;
      EXPECT_EQ(decision.number, 2) << ms;
    }
  }
}

// What it has missed is no push: the ball stays.
TEST(GraspSimulation, AHandThatIsFoundAgainInsideAnObjectGoesOnFromWhereItWas) {
  HandAndBall scene;
  scene.advance(open_hand());
  scene.lose();
  const Isometry3d X_WV = scene.X_WV();
  const Posture inside = moved(open_hand(), 0.0, 0.0, -0.05);
  for (int ms = 0; ms < 50; ++ms)
    scene.advance(inside);
  EXPECT_EQ(scene.simulation.activity(0), HandActivity::kFree);
  EXPECT_GT(scene.simulation.posture(0).X_WR.translation().z(), -0.045) << "on its side of the ball";
  EXPECT_EQ(scene.X_WV().matrix(), X_WV.matrix());
  for (int ms = 0; ms < 50; ++ms)
    scene.advance(moved(open_hand(), 0.0, 0.0, 0.2));
  EXPECT_LT((scene.simulation.posture(0).X_WR.translation() - Vector3d(0.0, 0.0, 0.2)).norm(), 1e-9);
}

TEST(GraspSimulation, AHandThatTheCartCarriesLetsGoAndBeginsWhereItIsFree) {
  HandAndBall scene;
  close_round_ball(scene);
  ASSERT_EQ(scene.simulation.held_part(0), 0U);
  const Isometry3d X_WV = scene.X_WV();
  const Posture in_wall = moved(bent_hand(1.2), 0.17, 0.0, 0.0);
  scene.simulation.move_cart(0, in_wall);
  EXPECT_FALSE(scene.simulation.held_part(0));
  for (int ms = 0; ms < 10; ++ms) {
    scene.advance(in_wall);
    ASSERT_EQ(scene.simulation.activity(0), HandActivity::kWaiting);
    ASSERT_EQ(scene.simulation.grasp(0).type, GraspType::kNone);
    ASSERT_TRUE(scene.simulation.clasp(0).contacts().empty());
    ASSERT_TRUE(scene.simulation.posture(0).X_WR.isApprox(in_wall.X_WR)) << "it is where the cart is";
  }
  const Posture beyond = moved(bent_hand(1.2), 0.5, 0.0, 0.0);
  scene.advance(beyond);
  EXPECT_EQ(scene.simulation.activity(0), HandActivity::kFree) << "the wall is behind it";
  EXPECT_TRUE(scene.simulation.posture(0).X_WR.isApprox(beyond.X_WR));
  EXPECT_LT((scene.X_WV().translation() - X_WV.translation()).norm(), 1e-6) << "the ball stays";
}

TEST(GraspSimulation, HandWaitingAfterCartMotionIsNoObstacle) {
  HandAndBall scene(2, 0.6);
  close_round_ball(scene);
  ASSERT_EQ(scene.simulation.held_part(0), 0U);
  scene.target(1) = moved(open_hand(), 0.0, 0.0, 0.1);
  scene.advance();
  EXPECT_EQ(scene.simulation.activity(1), HandActivity::kFree) << "above the ball, where it would stop it";
  scene.simulation.move_cart(1, moved(open_hand(), 0.0, 0.0, -0.056));
  for (int ms = 1; ms <= 300; ++ms) {
    scene.target(0) = moved(bent_hand(1.2), 0.0, 0.0, 0.5e-3 * ms);
    scene.target(1) = moved(open_hand(), 0.0, 0.0, 0.5e-3 * ms - 0.056);  // within the ball: it waits
    scene.advance();
  }
  EXPECT_EQ(scene.simulation.activity(1), HandActivity::kWaiting);
  EXPECT_GT(scene.X_WV().translation().z(), 0.08);
}

TEST(GraspSimulation, TwoHandsHoldOnePartAndPassItOn) {
  HandAndBall scene(2, 0.6);
  Posture below = open_hand();
  const auto second = [&](double angle) {
    Posture posture = bent_hand(angle);
    posture.X_WR = below.X_WR;
    return posture;
  };
  for (int ms = 0; ms <= 200; ++ms) {
    scene.target(0) = bent_hand(0.9 * std::min(1.0, ms / 150.0));
    scene.advance();
  }
  ASSERT_EQ(scene.simulation.held_part(0), 0U);
  // The second hand comes from below with its palm up, to where it has the ball as the first one has it.
  const Vector3d ball = scene.X_WV().translation();
  below.X_WR = at(2.0 * ball.x(), 0.0, 2.0 * ball.z()) * Eigen::AngleAxisd(M_PI, Vector3d::UnitY());
  for (int ms = 0; ms <= 300; ++ms) {
    scene.target(1) = moved(below, 0.0, 0.0, -0.15 + 0.5e-3 * ms);
    scene.advance();
  }
  const Vector3d first_grip = scene.simulation.parts().p_Vref(0);
  for (int ms = 0; ms <= 300; ++ms) {
    const bool held_before = scene.simulation.held_part(1).has_value();
    scene.target(1) = second(1.2 * std::min(1.0, ms / 200.0));
    scene.advance();
    if (held_before || !scene.simulation.held_part(1)) continue;
    EXPECT_LT((scene.simulation.parts().p_Vref(0) - middle_of_contacts(scene.simulation, {0, 1})).norm(), 2e-3)
        << "the coupling of both acts between them";
  }
  EXPECT_EQ(scene.simulation.held_part(1), 0U) << reason_of(scene.simulation.grasp(1));
  EXPECT_GT((scene.simulation.parts().p_Vref(0) - first_grip).norm(), 5e-3);
  for (int ms = 0; ms <= 300; ++ms) {
    const bool held_before = scene.simulation.held_part(0).has_value();
    scene.target(0) = bent_hand(0.9 * std::max(0.0, 1.0 - ms / 150.0));
    scene.advance();
    if (!held_before || scene.simulation.held_part(0)) continue;
    const Vector3d grip = scene.simulation.parts().p_Vref(0);
    EXPECT_LT((grip - middle_of_contacts(scene.simulation, {1})).norm(), 0.5 * (grip - first_grip).norm())
        << "the part is the second hand's now";
  }
  EXPECT_FALSE(scene.simulation.held_part(0));
  EXPECT_EQ(scene.simulation.held_part(1), 0U);
  const double z = scene.X_WV().translation().z();
  for (int ms = 0; ms <= 300; ++ms) {
    scene.target(1) = moved(second(1.2), 0.0, 0.0, -0.2e-3 * ms);
    scene.advance();
  }
  EXPECT_LT(scene.X_WV().translation().z(), z - 0.05) << "the part goes with the second hand";
}

TEST(GraspSimulation, GivesTheSameBitsAgain) {
  const auto run = [] {
    HandAndBall scene;
    close_round_ball(scene);
    for (int ms = 1; ms <= 300; ++ms)
      scene.advance(moved(bent_hand(1.2), 0.3e-3 * ms, 0.0, 0.1e-3 * ms));
    return std::pair{scene.X_WV().matrix().eval(), scene.simulation.posture(0).values};
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace glissade::grasping
