// When searches are made, and where: ahead of need, at the middle of a step, and again where a part turns back.

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/displacement.h>
#include <glissade/geometry/mesh_generators.h>

#include "candidates.h"
#include "certificate/path_certificate.h"
#include "held_part.h"
#include "poses.h"
#include "search/candidate_pairs.h"

namespace glissade::contact {
namespace {

using Eigen::Vector3d;
using test_support::pairs_to_certify_within;
using test_support::pairs_within;
using test_support::what_is_missing;

/// A cube that goes down to a plate in steps of equal length.
class CubeOverPlate : public ::testing::TestWithParam<bool> {
 protected:
  static constexpr double kGreatestRadius = 5e-3;  // metres
  static constexpr double kReach = 0.1e-3;
  static constexpr double kAhead = 1e-3;

  void move(double length) {
    z_ -= length;
    scene_.place(0, test_support::pose({0.0, 0.0, z_}));
    candidates_.moved();
  }

  /// Looks, and asks for the next search where it is time.
  bool look() {
    const bool is_other = candidates_.look(kReach, kAhead, {});
    candidates_.look_ahead(0.0, kReach, kAhead, {});
    return is_other;
  }

  double z_ = 0.015;
  ContactScene scene_{{test_support::obstacle_of(geometry::make_plate({0.1, 0.1}, 50))},
                      {test_support::part_of(geometry::make_box({0.02, 0.02, 0.02}, 48))},
                      std::vector<double>{1e-5}};
  CandidatePairs candidates_{scene_, kGreatestRadius, GetParam()};
};

// The part is 0.6 of the look-ahead before the place of a search when its answer is taken, so that serves for 1.6.
TEST_P(CubeOverPlate, SearchRequestedAheadServesFor1Point6LookAheads) {
  move(0.0);
  EXPECT_TRUE(look());
  std::vector<int> taken;
  for (int step = 1; step <= 300; ++step) {
    move(0.02 * kAhead);
    if (look()) taken.push_back(step);
    ASSERT_TRUE(candidates_.covers(kReach));
  }
  ASSERT_GE(taken.size(), 4U);
  EXPECT_NEAR(taken[0], 50, 2) << "the first one, from where the cube stood, has been used up";
  for (std::size_t i = 2; i < taken.size(); ++i)
    EXPECT_NEAR(taken[i] - taken[i - 1], 80, 3);
}

TEST_P(CubeOverPlate, AJumpBeyondWhatWasAskedForIsSearchedAfresh) {
  move(0.0);
  look();
  move(0.8 * kAhead);
  EXPECT_FALSE(look()) << "and asks for the next one";
  move(3.5 * kAhead);
  EXPECT_FALSE(candidates_.covers(kReach));
  EXPECT_TRUE(look());
  EXPECT_TRUE(candidates_.covers(kReach + 0.3 * kAhead)) << "from 0.6 of the look-ahead farther on";
  EXPECT_EQ(what_is_missing(candidates_, scene_, kReach), "");
  EXPECT_EQ(candidates_.statistics().searches, 2) << "a search that was not used does not count";
}

TEST_P(CubeOverPlate, ReversalIsCoveredByFewSearches) {
  move(0.0);
  look();
  for (const double way : {0.8, 0.3}) {
    move(way * kAhead);
    look();  // the second one takes the search ahead
  }
  ASSERT_EQ(candidates_.statistics().searches, 2);
  for (int step = 0; step < 30; ++step) {
    move(-0.1 * kAhead);
    look();
    ASSERT_TRUE(candidates_.covers(kReach));
    ASSERT_EQ(what_is_missing(candidates_, scene_, kReach), "");
  }
  EXPECT_LE(candidates_.statistics().searches, 5);
}

// When 0.8 of the look-ahead has been used up, a search is made where the cube will be after the other 0.2 and 0.6
// more: at half of it above the plate.
TEST_P(CubeOverPlate, SearchAheadReportsDistancesAtItsPredictedPose) {
  move(5e-3 - 2.1 * kAhead);
  look();
  move(0.8 * kAhead);
  look();  // asks for the next one
  move(0.3 * kAhead);
  EXPECT_TRUE(look());
  const std::vector<PairToCertify> to_certify = pairs_to_certify_within(candidates_, 1.1 * kAhead);
  ASSERT_FALSE(to_certify.empty());
  EXPECT_NEAR(to_certify.front().distance, 0.5 * kAhead, 1e-9);
  EXPECT_FALSE(pairs_within(candidates_, 1.1 * kAhead).empty());
}

// Steps much longer than the look-ahead: each search is made at the middle of the next one, with little more than half
// of it as the radius.
TEST_P(CubeOverPlate, LongStepIsCoveredByHalfItsLengthAroundItsMidpoint) {
  constexpr double kStep = 0.5e-3;
  constexpr double kLittle = 0.05e-3;
  PathCertificate certificate(scene_);
  const std::vector<geometry::Displacement> step{{{0.0, 0.0, -kStep}, Vector3d::Zero()}};
  move(0.0);
  candidates_.look(2.0 * kStep, kLittle, {});
  for (int i = 0; i < 5; ++i) {
    move(kStep);
    candidates_.look_ahead(kStep, kLittle, kLittle, {});
    if (i == 0) continue;  // the first search, at the beginning, serves for two steps
    ASSERT_TRUE(candidates_.take_ahead(kLittle, kStep)) << i;
    EXPECT_FALSE(candidates_.covers(0.5 * kStep));
    certificate.begin_step(step);
    EXPECT_GT(candidates_.covered_on_path(certificate), kLittle);
    EXPECT_LT(candidates_.covered_on_path(certificate), 0.3 * kStep);
  }
}

TEST_P(CubeOverPlate, PathIsSearchedAroundItsMidpoint) {
  constexpr double kLength = 2e-3;
  constexpr double kLeast = 0.1e-3;
  const std::vector<geometry::Displacement> way{{{0.0, 0.0, -kLength}, Vector3d::Zero()}};
  PathCertificate certificate(scene_);
  move(0.0);
  EXPECT_TRUE(candidates_.look_along(way, kLength, kLeast, {}));
  EXPECT_TRUE(candidates_.covers(kLeast));
  EXPECT_FALSE(candidates_.covers(0.5 * kLength));
  certificate.begin_step(way);
  EXPECT_GT(candidates_.covered_on_path(certificate), kLeast);
  move(kLength);
  EXPECT_TRUE(candidates_.covers(kLeast));
}

TEST_P(CubeOverPlate, LeavesOutWhatHasCertainlyComeApart) {
  move(4.9e-3);
  candidates_.look(kReach, kAhead, {});
  EXPECT_FALSE(pairs_within(candidates_, kReach).empty());
  EXPECT_FALSE(pairs_to_certify_within(candidates_, kReach).empty());
  move(-0.2 * kAhead);  // up again; by the length of the way alone all might still be near
  EXPECT_TRUE(candidates_.covers(kReach));
  EXPECT_TRUE(pairs_within(candidates_, kReach).empty());
  EXPECT_TRUE(pairs_to_certify_within(candidates_, kReach).empty());
}

// Hardly anything is known then of which way is apart.
TEST_P(CubeOverPlate, KeepsWhatWasTooNearToHaveADirection) {
  move(5e-3 - 0.9 * kSharpDistance_m);
  candidates_.look(kReach, kAhead, {});
  move(0.8 * kSharpDistance_m);
  EXPECT_FALSE(pairs_within(candidates_, 0.2 * kSharpDistance_m).empty());
  EXPECT_EQ(what_is_missing(candidates_, scene_, 0.2 * kSharpDistance_m), "");
}

TEST_P(CubeOverPlate, InvalidPoseThrowsAndTheNextSearchSucceeds) {
  move(0.0);
  candidates_.look(kReach, kAhead, {});
  scene_.place(0, test_support::pose({0.0, 0.0, std::numeric_limits<double>::quiet_NaN()}));
  candidates_.moved();
  EXPECT_THROW(candidates_.look(kReach, kAhead, {}), std::invalid_argument);
  EXPECT_FALSE(candidates_.covers(0.0)) << "what has failed is no answer";
  move(4.9e-3);
  EXPECT_TRUE(candidates_.look(kReach, kAhead, {}));
  EXPECT_EQ(what_is_missing(candidates_, scene_, kReach), "");
  EXPECT_FALSE(pairs_within(candidates_, kReach).empty());
}

/// A finely cut ball that goes past another one: each search finds very many pairs.
class BallPastBall : public ::testing::TestWithParam<bool> {
 protected:
  static constexpr double kReach = 0.1e-3;
  static constexpr double kAhead = 2e-3;

  void move(double length) {
    x_ += length;
    scene_.place(0, test_support::pose({x_, 0.0, 0.0402}));
    candidates_.moved();
  }

  /// Returns whether the candidates are others.
  bool look() {
    const bool is_other = candidates_.look(kReach, kAhead, {});
    candidates_.look_ahead(0.0, kReach, kAhead, {});
    return is_other;
  }

  double place_of_search() const { return candidates_.pairs().search().request.X_WB[0].translation().x(); }

  double x_ = -6e-3;
  ContactScene scene_{{test_support::obstacle_of(geometry::make_sphere(0.02, 12000))},
                      {test_support::part_of(geometry::make_sphere(0.02, 12000))},
                      std::vector<double>{1e-5}};
  CandidatePairs candidates_{scene_, 5e-3, GetParam()};
};

TEST_P(BallPastBall, SearchesRequestedEarlyServeAsLongAsLateOnes) {
  move(0.0);
  EXPECT_TRUE(look());
  std::vector<int> taken;
  for (int step = 1; step <= 120; ++step) {
    move(0.05 * kAhead);
    if (look()) taken.push_back(step);
    ASSERT_TRUE(candidates_.covers(kReach));
    ASSERT_GT(candidates_.pairs().pair_count(), 5000U);
  }
  ASSERT_GE(taken.size(), 3U);
  for (std::size_t i = 2; i < taken.size(); ++i)
    EXPECT_NEAR(taken[i] - taken[i - 1], 32, 2);
}

// A late request would be for 0.6 of the look-ahead beyond the place to which the ball jumps.
TEST_P(BallPastBall, AsksForTheNextSearchAsSoonAsTheLastOneIsTaken) {
  move(0.0);
  look();
  for (int taken = 0; taken < 2;) {
    move(0.05 * kAhead);
    taken += look() ? 1 : 0;
  }
  const double at_taking = x_;
  move(1.9 * kAhead);
  EXPECT_FALSE(candidates_.covers(kReach));
  EXPECT_TRUE(look());
  EXPECT_NEAR(place_of_search(), at_taking + 2.2 * kAhead, 0.15 * kAhead);
}

TEST_P(BallPastBall, IsSearchedForAfreshWhereItTurnsBack) {
  move(0.0);
  look();
  for (int taken = 0; taken < 2;) {
    move(0.05 * kAhead);
    taken += look() ? 1 : 0;
  }
  move(-3.0 * kAhead);  // the search that was asked for is ended, wherever it is
  EXPECT_TRUE(look());
  EXPECT_TRUE(candidates_.covers(kReach));
  EXPECT_LT(place_of_search(), x_ + 1e-9);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutAThread, BallPastBall, ::testing::Bool(),
                         [](const auto& test) { return std::string(test.param ? "WithAThread" : "WithoutAThread"); });

INSTANTIATE_TEST_SUITE_P(WithAndWithoutAThread, CubeOverPlate, ::testing::Bool(),
                         [](const auto& test) { return std::string(test.param ? "WithAThread" : "WithoutAThread"); });

}  // namespace
}  // namespace glissade::contact
