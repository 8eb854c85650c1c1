// A budget of work for each call: it ends early, says so, never moves through what is not proven free, and gets there.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/contact/sliding.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/reference/brute_force.h>

#include "certificate/path_certificate.h"
#include "held_part.h"
#include "poses.h"
#include "random_numbers.h"
#include "sanitizers.h"
#include "search/candidate_pairs.h"
#include "sweeps/sweep_variants.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::pose;
using test_support::turn;

/// A ball over a finely meshed block whose upper face is z = 0.
Obstacle fine_block() {
  return test_support::obstacle_of(geometry::make_box({0.1, 0.1, 0.05}, 6000), pose({0.0, 0.0, -0.025}));
}
std::shared_ptr<const SlidingPart> fine_ball() {
  return test_support::part_of(geometry::make_sphere(0.02, 2000));
}
const Isometry3d kAboveBlock = pose({0.0, 0.0, 0.021}, turn(1.0, Vector3d::UnitX()));

Sliding ball_on_block(std::optional<std::int64_t> budget, bool has_search_thread = false) {
  return {{fine_block()},
          fine_ball(),
          kAboveBlock,
          {.rules = {.has_search_thread = has_search_thread, .work_budget = budget}}};
}

/// 2 mm deep into the block, and 10 mm along it.
const Isometry3d kGoal = pose({0.01, 0.0, 0.018}, turn(1.1, Vector3d::UnitX()));

/// Leads the ball to the goal and holds the ghost there. Returns the number of calls that ended early.
int lead_to_goal(Sliding& sliding, int most_calls) {
  int early = 0;
  for (int i = 1; i <= most_calls; ++i) {
    early += sliding.advance(test_support::between(kAboveBlock, kGoal, std::min(1.0, 1e-2 * i))).ended_early ? 1 : 0;
    if (i > 100 && early == 0 && sliding.result().state == SlidingState::kResting) break;
  }
  return early;
}

TEST(WorkBudget, WithoutOneNoCallEndsEarly) {
  Sliding sliding = ball_on_block(std::nullopt);
  EXPECT_EQ(lead_to_goal(sliding, 300), 0);
  EXPECT_EQ(sliding.call_statistics().ended_early, 0);
  EXPECT_GT(sliding.call_statistics().calls, 0);
}

// The first search would find more pairs than its memory may hold; a call without a budget looks less far at once.
TEST(WorkBudget, WithoutOneTooManyPairsShortenTheStep) {
  if (test_support::kSanitized) GTEST_SKIP() << "millions of pairs take minutes; near_pairs_test has the limit";
  const Isometry3d X_WG = pose({1.5e-3, 0.0, 0.0});
  std::vector<Isometry3d> X_WV;
  for (const bool has_search_thread : {false, true}) {
    Sliding ball_in_socket({test_support::obstacle_of(geometry::make_sphere(0.0101, 14'000))},
                           test_support::part_of(geometry::make_sphere(0.01, 14'000)), Isometry3d::Identity(),
                           {.rules = {.max_cycles = 1, .has_search_thread = has_search_thread}});
    EXPECT_FALSE(ball_in_socket.advance(X_WG).ended_early);
    EXPECT_GT(ball_in_socket.result().X_WV.translation().x(), 10e-6);
    EXPECT_LT(ball_in_socket.result().X_WV.translation().x(), 100e-6);
    X_WV.push_back(ball_in_socket.result().X_WV);
  }
  EXPECT_EQ(X_WV[0].matrix(), X_WV[1].matrix());
}

TEST(WorkBudget, ThePartGetsToTheSamePlaceInMoreCalls) {
  Sliding unlimited = ball_on_block(std::nullopt);
  lead_to_goal(unlimited, 1000);
  for (const std::int64_t budget : {5'000, 15'000}) {
    SCOPED_TRACE(budget);
    Sliding sliding = ball_on_block(budget);
    EXPECT_GT(lead_to_goal(sliding, test_support::kSanitized ? 4000 : 20'000), 50);
    EXPECT_LT((sliding.result().X_WV.translation() - unlimited.result().X_WV.translation()).norm(), 20e-6);
  }
}

TEST(WorkBudget, CallExceedsItByAtMostOnePieceOfWork) {
  constexpr std::int64_t kBudget = 3'000;
  // A projection on the contacts of a ball on a plane, or the proof of two leaves: the greatest piece here.
  constexpr std::int64_t kPiece = 8'000;
  Sliding sliding = ball_on_block(kBudget);
  lead_to_goal(sliding, 2000);
  EXPECT_GT(sliding.call_statistics().ended_early, 100);
  EXPECT_LE(sliding.call_statistics().most_work, kBudget + kPiece);
  Sliding unlimited = ball_on_block(std::nullopt);
  lead_to_goal(unlimited, 1000);
  EXPECT_GT(unlimited.call_statistics().most_work, kBudget + kPiece) << "otherwise the bound says nothing";
}

/// A thread works on the search of the candidates while a call waits for it.
TEST(WorkBudget, SearchExceedsItByAtMostOnePieceOfWorkPerCall) {
  constexpr std::int64_t kWork = 5'000;
  constexpr std::int64_t kPiece = 16 * 500 + 100;  // the triangle pairs of two leaves
  ContactScene scene({fine_block()}, {fine_ball()}, std::vector<double>{1e-5});
  scene.place(0, pose({0.0, 0.0, 0.0201}));
  CandidatePairs all(scene, 5e-3);
  all.look(1e-3, 0.0, {});
  CandidatePairs candidates(scene, 5e-3, false, kWork);
  int calls = 1;
  std::int64_t before = 0;
  for (candidates.begin_call(); !candidates.look(1e-3, 0.0, {}); candidates.begin_call(), ++calls) {
    ASSERT_FALSE(candidates.covers(0.0)) << "before it is done";
    ASSERT_LE(candidates.work_of_search() - before, kWork + kPiece);
    before = candidates.work_of_search();
    ASSERT_LT(calls, 10'000);
  }
  EXPECT_GT(calls, 10);
  EXPECT_TRUE(candidates.covers(1e-3));
  EXPECT_EQ(candidates.pairs().size(), all.pairs().size());
}

TEST(WorkBudget, ACertificateGoesOnWhereItStopped) {
  ContactScene scene({fine_block()}, {fine_ball()}, std::vector<double>{1e-5});
  scene.place(0, pose({0.0, 0.0, 0.0201}));
  CandidatePairs candidates(scene, 5e-3);
  candidates.look(1e-3, 0.0, {});
  std::vector<PairToCertify> to_certify;
  candidates.pairs().within(1e-3, to_certify);
  const std::vector<geometry::Displacement> down{{Vector3d(0.0, 0.0, -0.5e-3), Vector3d(0.01, 0.0, 0.0)}};
  const auto failures_with = [&](std::int64_t work) {
    PathCertificate certificate(scene);
    certificate.begin_step(down);
    certificate.begin(to_certify);
    for (WorkBudget budget{work}; !certificate.go_on(budget); budget = {work}) {
    }
    std::vector<std::int32_t> failures;
    for (const UncertifiedPair& pair : certificate.failures())
      failures.insert(failures.end(), {pair.obstacle_triangle, pair.part_triangle});
    return failures;
  };
  EXPECT_FALSE(failures_with(kUnlimitedWork).empty());
  EXPECT_EQ(failures_with(1), failures_with(kUnlimitedWork));
}

/// A ball that is pushed at random into rough ground, with a random budget down to the least.
struct PushedBall {
  geometry::TriangleMesh ground = geometry::make_plate({0.06, 0.06}, 400);
  geometry::TriangleMesh ball = geometry::make_sphere(0.01, 300);
  std::int64_t budget = 0;
  Metaphor metaphor = Metaphor::kForceFeedback;
  std::array<Isometry3d, 4> X_to;

  explicit PushedBall(test_support::RandomNumbers& random) {
    for (Vector3d& x : ground.vertices)
      x.z() += random.uniform(-2e-3, 2e-3);
    budget = static_cast<std::int64_t>(2.0 * random.power_of_ten(0.0, 5.0));
    if (random.chance(0.5)) metaphor = Metaphor::kRubberBandSpring;
    for (Isometry3d& X : X_to)
      X = pose({random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), random.uniform(-5e-3, 0.01)},
               turn(random.uniform(-1.0, 1.0), random.direction()));
  }

  /// Leads the ball to all poses, and shows the result of each call. Takes hold anew at every other pose.
  void run(const std::function<void(const Sliding&)>& show) const {
    Sliding sliding({test_support::obstacle_of(ground)}, test_support::part_of(ball), pose({0.0, 0.0, 0.013}),
                    {.metaphor = metaphor, .rules = {.work_budget = budget}});
    for (std::size_t leg = 0; leg < X_to.size(); ++leg) {
      const Isometry3d X_from = sliding.result().X_WG;
      for (int i = 1; i <= 100; ++i) {
        sliding.advance(test_support::between(X_from, X_to[leg], 0.01 * i));
        show(sliding);
      }
      if (leg % 2 == 1) sliding.grasp(X_to[leg]);
    }
  }
};

TEST(WorkBudget, NothingEverCollides) {
  constexpr std::uint64_t kSeed = 81;
  RecordProperty("seed", static_cast<int>(kSeed));
  test_support::RandomNumbers random(kSeed);
  int early = 0;
  for (int trial = 0; trial < test_support::affordable(40); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const PushedBall pushed(random);
    int call = 0;
    pushed.run([&](const Sliding& sliding) {
      early += sliding.result().ended_early ? 1 : 0;
      if (++call % 10 != 0) return;
      EXPECT_FALSE(reference::brute_force_intersects(pushed.ground, pushed.ball, sliding.result().X_WV))
          << "call " << call;
    });
  }
  EXPECT_GT(early, 0);
}

/// The work is counted in pairs that the vector code looks at: with every instruction set, these are the same.
TEST(WorkBudget, ACallEndsAtTheSamePairWithEveryInstructionSet) {
  constexpr std::uint64_t kSeed = 82;
  RecordProperty("seed", static_cast<int>(kSeed));
  test_support::RandomNumbers random(kSeed);
  for (int trial = 0; trial < test_support::affordable(12); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const PushedBall pushed(random);
    std::vector<double> first;
    test_support::with_every_instruction_set([&](std::string_view name) {
      std::vector<double> answers;
      pushed.run([&](const Sliding& sliding) {
        const SlidingResult& result = sliding.result();
        answers.insert(answers.end(), result.X_WV.matrix().data(), result.X_WV.matrix().data() + 16);
        answers.push_back(result.ended_early ? 1.0 : 0.0);
      });
      if (first.empty()) first = answers;
      EXPECT_TRUE(answers == first) << name;
    });
  }
}

TEST(WorkBudget, NoBitDependsOnTheSearchThread) {
  std::int64_t early = 0;
  for (const std::int64_t budget : {20'000, 200'000, 2'000'000}) {
    Sliding without = ball_on_block(budget);
    Sliding with = ball_on_block(budget, true);
    for (int i = 1; i <= 600; ++i) {
      const Isometry3d X_WG = test_support::between(kAboveBlock, kGoal, std::min(1.0, 5e-3 * i));
      const SlidingResult& a = without.advance(X_WG);
      const SlidingResult& b = with.advance(X_WG);
      ASSERT_EQ(a.X_WV.matrix(), b.X_WV.matrix()) << budget << ", call " << i;
      ASSERT_EQ(a.ended_early, b.ended_early) << budget << ", call " << i;
      ASSERT_EQ(a.contacts.size(), b.contacts.size()) << budget << ", call " << i;
    }
    EXPECT_EQ(without.call_statistics().most_work, with.call_statistics().most_work);
    early += without.call_statistics().ended_early;
  }
  EXPECT_GT(early, 100);
}

TEST(WorkBudget, TooSmallIsRefused) {
  EXPECT_THROW(ball_on_block(1), std::invalid_argument);
}

/// The part repeats each motion of its ghost, so motion that a call lost would never come back.
TEST(WorkBudget, TheMotionOfOnePartIsKeptWhileAnotherIsGraspedAndLetGo) {
  constexpr double kWay_m = 2e-3;
  constexpr int kMoving = 100;
  const Isometry3d X_WV_start = pose({0.0, 0.0, 0.0202});
  const Isometry3d X_aside = pose({0.5, 0.0, 0.0});
  MultiPartSliding sliding({fine_block()},
                           {{.part_V = fine_ball(), .X_WV_start = X_WV_start, .metaphor = Metaphor::kIncremental},
                            {.part_V = test_support::cube(0.04), .X_WV_start = X_aside}},
                           {.work_budget = 1'000});
  int early = 0;
  bool is_held = true;
  for (int call = 1; call <= 1000; ++call) {
    if (call <= kMoving && call % 5 == 0) {
      is_held ? sliding.release(1) : sliding.grasp(1, X_aside);
      is_held = !is_held;
    }
    const double x = kWay_m * std::min(1.0, 1.0 * call / kMoving);
    const std::array<Isometry3d, 2> X_WG{pose({x, 0.0, 0.0202}), X_aside};
    sliding.advance(X_WG);
    early += call <= kMoving && sliding.result(0).ended_early ? 1 : 0;
  }
  EXPECT_GT(early, kMoving / 2) << "otherwise no call was under way at a grasp";
  EXPECT_NEAR(sliding.result(0).X_WV.translation().x(), kWay_m, 1e-9);
}

/// In how many calls a ball comes to its ghost, 2 mm away, while somebody moves a rider far from it: in every call, or
/// between cycles only. Gives up after 5,000.
int calls_beside_riders(bool between_cycles_only) {
  MultiPartSliding sliding({fine_block()}, {{.part_V = fine_ball(), .X_WV_start = pose({0.0, 0.0, 0.0202})}},
                           {.work_budget = 1'000}, {{{test_support::cube(0.04)}}});
  int call = 0;
  while (call < 5'000 && sliding.result(0).X_WV.translation().x() < 2e-3 - 1e-9) {
    ++call;
    const Isometry3d X_WRider = pose({0.5, 0.0, 1e-6 * call});
    if (!between_cycles_only || !sliding.is_within_cycle()) sliding.place_riders(0, {&X_WRider, 1});
    const Isometry3d X_WG = pose({2e-3, 0.0, 0.0201});
    sliding.advance({&X_WG, 1});
  }
  return call;
}

TEST(WorkBudget, MovingRidersDoNotStallAPart) {
  EXPECT_LT(calls_beside_riders(true), 2'000);
  EXPECT_GT(calls_beside_riders(false), 1.5 * calls_beside_riders(true)) << "each cycle begins anew";
}

}  // namespace
}  // namespace glissade::contact
